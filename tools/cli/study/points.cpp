#include "tools/cli/study/points.h"

#include <cstdint>
#include <fstream>

#include "engine/base/error.h"
#include "engine/shapes/file_bytes.h"

namespace firn {
namespace {

/// Calls f(data, bytes) for each column.
template <class Body, class F>
void for_columns(Body& body, F&& f) {
  const std::size_t n = body.size();
  f(body.start.data(), n * sizeof(Vec3));
  f(body.displacement.data(), n * sizeof(Vec3));
  f(body.velocity.data(), n * sizeof(Vec3));
  f(body.stress.data(), n * sizeof(Eigen::Matrix3d));
  f(body.mass.data(), n * sizeof(double));
}

}  // namespace

void write_points(const std::filesystem::path& file, const std::vector<BodyPoints>& bodies) {
  std::ofstream out(file, std::ios::binary);
  const auto put = [&](const void* data, std::size_t bytes) {
    out.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
  };
  const std::uint64_t count = bodies.size();
  put(&count, sizeof(count));
  for (const BodyPoints& body : bodies) {
    const std::uint64_t n = body.size();
    put(&n, sizeof(n));
    for_columns(body, put);
  }
  out.close();
  if (!out) throw Error(ExitCode::io, quoted(file) + ": could not be written");
}

std::vector<BodyPoints> read_points(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const auto get = [&](void* data, std::size_t bytes) {
    in.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes));
    if (!in) throw Error(ExitCode::io, quoted(file) + ": could not be read");
  };
  std::uint64_t count = 0;
  get(&count, sizeof(count));
  std::vector<BodyPoints> out;
  for (std::uint64_t b = 0; b < count; ++b) {
    std::uint64_t n = 0;
    get(&n, sizeof(n));
    for_columns(out.emplace_back(n), get);
  }
  return out;
}

}  // namespace firn
