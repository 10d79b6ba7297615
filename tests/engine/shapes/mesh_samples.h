// Meshes for tests, good and bad, and files of them.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "engine/shapes/triangle_mesh.h"

namespace firn::test {

/// The unit cube [0, 1]^3, normals out; each face two triangles.
inline TriangleMesh cube() {
  TriangleMesh m;
  for (int i = 0; i < 8; ++i) m.vertices.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

/// A unit sphere of `n` rings and 2n meridians, its vertices on the sphere, normals out.
inline TriangleMesh sphere(int n) {
  const double pi = 3.14159265358979323846;
  TriangleMesh m;
  m.vertices.emplace_back(0, 0, 1);
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double t = pi * i / n, p = pi * j / n;
      m.vertices.emplace_back(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
    }
  m.vertices.emplace_back(0, 0, -1);
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(1 + (i - 1) * 2 * n + j % (2 * n)); };
  const auto last = static_cast<std::uint32_t>(m.vertices.size() - 1);
  for (int j = 0; j < 2 * n; ++j) {
    m.triangles.push_back({0, at(1, j), at(1, j + 1)});
    m.triangles.push_back({last, at(n - 1, j + 1), at(n - 1, j)});
    for (int i = 1; i < n - 1; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}

inline TriangleMesh placed(TriangleMesh m, double scale, const Vec3& offset) {
  for (Vec3& v : m.vertices) v = scale * v + offset;
  return m;
}

inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto base = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({base + t[0], base + t[1], base + t[2]});
  return a;
}

inline TriangleMesh flipped(TriangleMesh m) {
  for (Triangle& t : m.triangles) std::swap(t[1], t[2]);
  return m;
}

/// Every triangle with its own three vertices, as .stl files have them.
inline TriangleMesh soup(const TriangleMesh& m) {
  TriangleMesh s;
  for (const Triangle& t : m.triangles) {
    const auto base = static_cast<std::uint32_t>(s.vertices.size());
    for (std::uint32_t i : t) s.vertices.push_back(m.vertices[i]);
    s.triangles.push_back({base, base + 1, base + 2});
  }
  return s;
}

inline TriangleMesh without_triangle(TriangleMesh m, std::size_t i) {
  m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(i));
  return m;
}

inline std::string obj_text(const TriangleMesh& m) {
  std::string text;
  for (const Vec3& v : m.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const Triangle& t : m.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

/// A folder that is gone with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "firn-test-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace firn::test
