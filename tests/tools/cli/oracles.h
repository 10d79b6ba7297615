// The oracles of tests/data/oracles, and `firn element` to compare with them.
#pragma once

#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tools/cli/element.h"

namespace firn::test {

using nlohmann::json;

inline json oracles(const std::string& name) {
  std::ifstream file(std::string(FIRN_TEST_DATA) + "/oracles/" + name + ".json");
  REQUIRE(file);
  return json::parse(file);
}

inline json ask(const json& request) {
  std::istringstream in(request.dump() + "\n");
  std::ostringstream out;
  REQUIRE(firn::run_element(in, out) == 0);
  return json::parse(out.str());
}

inline std::vector<double> numbers(const json& value) {
  if (value.is_number()) return {value.get<double>()};
  std::vector<double> out;
  for (const json& child : value)
    for (double x : numbers(child)) out.push_back(x);
  return out;
}

inline double largest(const json& value) {
  double out = 0;
  for (double x : numbers(value)) out = std::fmax(out, std::fabs(x));
  return out;
}

inline double largest_difference(const json& found, const json& expected) {
  const std::vector<double> a = numbers(found), b = numbers(expected);
  REQUIRE(a.size() == b.size());
  double out = 0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::fmax(out, std::fabs(a[i] - b[i]));
  return out;
}

inline void check_value(const json& found, const json& expected, const json& tolerance) {
  CHECK(largest_difference(found, expected) <= tolerance.get<double>() * std::fmax(1, largest(expected)));
}

}  // namespace firn::test
