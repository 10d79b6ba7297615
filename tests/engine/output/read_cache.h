// Reads a point cache back with OpenVDB's own reader into plain arrays, in the order the points stand in the
// file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace firn::testing {

struct ReadCache {
  std::vector<std::int64_t> id;
  std::vector<std::array<double, 3>> P;
  std::vector<std::array<float, 3>> v;
  std::vector<float> pscale, Jp;
  std::vector<std::int32_t> material;
  std::vector<std::array<float, 9>> F_E;          // element (row, column) at 3 row + column
  std::vector<std::array<float, 3>> F_E_times_v;  // what the reader's m * v gives
  std::map<std::string, std::string> types;       // of the attributes, as the file names them
  std::map<std::string, std::string> metadata;    // of the file
  bool pscale_is_constant = true;                 // stored once per leaf
};

ReadCache read_cache(const std::filesystem::path& file);

}  // namespace firn::testing
