// A cache is judged by other programs' readers: OpenVDB's own, and vdb_tool, which turns points into PLY.
#include "engine/output/point_cache.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <unordered_map>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/engine/output/read_cache.h"
#include "tests/engine/output/temporary_folder.h"
#include "tests/support/sample_frame.h"

namespace firn {
namespace {

using testing::read_cache;
using testing::ReadCache;
using testing::SampleFrame;
using testing::TemporaryFolder;

constexpr double kVoxel = 0.1;
const PointCacheSettings kSettings{kVoxel, 24, "firn test"};

std::unordered_map<std::int64_t, std::size_t> index_by_id(const std::vector<std::int64_t>& ids) {
  std::unordered_map<std::int64_t, std::size_t> out;
  for (std::size_t i = 0; i < ids.size(); ++i) out[ids[i]] = i;
  return out;
}

// The positions vdb_tool finds in a cache, as float triples.
std::vector<float> positions_by_vdb_tool(const std::filesystem::path& cache) {
  const std::string ply = cache.string() + ".ply";
  const std::string command =
      "vdb_tool -read '" + cache.string() + "' -vdb2points -write '" + ply + "' >/dev/null 2>&1";
  REQUIRE(std::system(command.c_str()) == 0);
  const std::string text = testing::read_file(ply);
  REQUIRE(text.find("format binary_little_endian") != std::string::npos);
  const std::string end = "end_header\n";
  const std::size_t start = text.find(end) + end.size();
  std::vector<float> out((text.size() - start) / sizeof(float));
  std::memcpy(out.data(), text.data() + start, out.size() * sizeof(float));
  return out;
}

ExitCode code_of(const std::filesystem::path& file, const FrameView& frame, std::string* message = nullptr) {
  try {
    write_point_cache(file, frame, kSettings);
  } catch (const Error& error) {
    if (message != nullptr) *message = error.what();
    return error.code();
  }
  return ExitCode::ok;
}

}  // namespace

TEST_CASE("a point cache reads back particle by particle") {
  const TemporaryFolder folder;
  const float center = GENERATE(0.0F, 1000.0F);
  const SampleFrame sample(20'000, center);
  const auto file = folder.path() / point_cache_name(12);
  const std::uint64_t bytes = write_point_cache(file, sample.view(), kSettings);
  CHECK(bytes == std::filesystem::file_size(file));
  CHECK(testing::names_in(folder.path()) == std::vector<std::string>{"particles.0012.vdb"});

  const ReadCache cache = read_cache(file);
  REQUIRE(cache.id.size() == sample.id.size());
  const auto index = index_by_id(sample.id);
  REQUIRE(index_by_id(cache.id).size() == sample.id.size());

  // Half a unit in the last place of a 32-bit offset below half a voxel, and the reader's double arithmetic.
  const double tolerance = kVoxel / (1 << 25) + 1e-15 * std::abs(center);
  for (std::size_t i = 0; i < cache.id.size(); ++i) {
    const std::size_t p = index.at(cache.id[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(std::abs(cache.P[i][k] - static_cast<double>(sample.P[3 * p + k])) <= tolerance);
      REQUIRE(cache.v[i][k] == sample.v[3 * p + k]);
    }
    REQUIRE(cache.Jp[i] == sample.Jp[p]);
    REQUIRE(static_cast<float>(cache.material[i]) == sample.material[p]);
    REQUIRE(cache.pscale[i] == 0.25F);
  }
  CHECK(cache.pscale_is_constant);
  CHECK(cache.types.at("id") == "int64");
  CHECK(cache.types.at("v") == "vec3s");
  CHECK(cache.types.at("F_E") == "mat3s");
  CHECK(cache.types.at("material") == "int32");
  CHECK(cache.metadata.at("frame") == "12");
  CHECK(cache.metadata.at("time") == "0.4375");
  CHECK(cache.metadata.at("frame_rate") == "24");
  CHECK(cache.metadata.at("creator") == "firn test");
}

TEST_CASE("a reader of the cache gets F_E and not its transpose") {
  const TemporaryFolder folder;
  const SampleFrame sample(100);
  const auto file = folder.path() / "a.vdb";
  write_point_cache(file, sample.view(), kSettings);
  const ReadCache cache = read_cache(file);
  const auto index = index_by_id(sample.id);
  REQUIRE(cache.id.size() == 100);
  for (std::size_t i = 0; i < cache.id.size(); ++i) {
    const std::size_t p = index.at(cache.id[i]);
    const float* F = &sample.F_E[9 * p];
    const float* v = &sample.v[3 * p];
    for (std::size_t k = 0; k < 9; ++k) REQUIRE(cache.F_E[i][k] == F[k]);
    for (std::size_t row = 0; row < 3; ++row) {
      const float Fv = F[3 * row] * v[0] + F[3 * row + 1] * v[1] + F[3 * row + 2] * v[2];
      // Three products of numbers below 1.5 x 0.5, rounded to float, in either order.
      REQUIRE(std::abs(cache.F_E_times_v[i][row] - Fv) <= 4 * std::numeric_limits<float>::epsilon());
    }
  }
}

TEST_CASE("vdb_tool reads the same points from a cache") {
  const TemporaryFolder folder;
  const SampleFrame sample(5000);
  const auto file = folder.path() / "particles.0012.vdb";
  write_point_cache(file, sample.view(), kSettings);
  const std::vector<float> found = positions_by_vdb_tool(file);
  REQUIRE(found.size() == sample.P.size());
  // It writes points in the order of the file and knows no ids: those come from the other reader, same order.
  const ReadCache cache = read_cache(file);
  const auto index = index_by_id(sample.id);
  for (std::size_t i = 0; i < cache.id.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float expected = sample.P[3 * index.at(cache.id[i]) + k];
      // The stored offset, and one rounding to float of a coordinate below 0.5.
      REQUIRE(std::abs(found[3 * i + k] - expected) <=
              kVoxel / (1 << 25) + 0.25 * std::numeric_limits<float>::epsilon());
    }
  }
}

TEST_CASE("a frame without particles is a valid cache") {
  const TemporaryFolder folder;
  const SampleFrame sample(0);
  const auto file = folder.path() / "particles.0001.vdb";
  write_point_cache(file, sample.view(), kSettings);
  CHECK(read_cache(file).id.empty());
  const std::string command = "vdb_print '" + file.string() + "' >/dev/null 2>&1";
  CHECK(std::system(command.c_str()) == 0);
}

TEST_CASE("cache names sort by frame") {
  CHECK(point_cache_name(1) == "particles.0001.vdb");
  CHECK(point_cache_name(12345) == "particles.12345.vdb");
}

TEST_CASE("a particle no grid can hold stops the write and leaves nothing") {
  const TemporaryFolder folder;
  SampleFrame sample(10);
  const float bad = GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                             -1e30F, kVoxel * 1.1e9F);
  sample.P[3 * 4 + 1] = bad;
  std::string message;
  CHECK(code_of(folder.path() / "a.vdb", sample.view(), &message) == ExitCode::numerics);
  CHECK(message.find("frame 12: particle " + std::to_string(sample.id[4])) == 0);
  CHECK(testing::names_in(folder.path()).empty());
}

TEST_CASE("particles thrown in all directions do not fill the memory") {
  const TemporaryFolder folder;
  SampleFrame sample(10'000);
  // Each in a region of 4096 voxels of its own would take 0.6 MB: 6 GB.
  for (float& x : sample.P) x *= 1e7F;
  std::string message;
  CHECK(code_of(folder.path() / "a.vdb", sample.view(), &message) == ExitCode::numerics);
  CHECK(message.find("10000 separate regions") != std::string::npos);
}

TEST_CASE("one particle far from the others is stored") {
  const TemporaryFolder folder;
  SampleFrame sample(1000);
  sample.P[0] = 1e7F;
  const auto file = folder.path() / "a.vdb";
  REQUIRE(code_of(file, sample.view()) == ExitCode::ok);
  const ReadCache cache = read_cache(file);
  REQUIRE(cache.id.size() == 1000);
  CHECK(cache.P[index_by_id(cache.id).at(sample.id[0])][0] == 1e7);
}

}  // namespace firn
