#include "engine/shapes/mesh_import.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "engine/base/error.h"
#include "engine/shapes/mesh_check.h"
#include "tests/engine/shapes/mesh_samples.h"

using namespace firn;
using namespace firn::test;
using Catch::Matchers::Contains;

namespace {

std::string failure(const std::filesystem::path& file) {
  try {
    import_mesh(file);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::input);
    return error.what();
  }
  return "no error";
}

const std::filesystem::path kData = std::filesystem::path(FIRN_TEST_DATA) / "meshes";

}  // namespace

TEST_CASE("an OBJ, an STL and a PLY file of one mesh give one mesh") {
  const TemporaryFolder folder;
  const TriangleMesh original = placed(sphere(6), 0.5, {1, 2, 3});
  std::string stl = "solid s\n";
  for (const Triangle& t : original.triangles) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (std::uint32_t i : t) {
      const Vec3& v = original.vertices[i];
      stl += fmt::format("vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    stl += "endloop\nendfacet\n";
  }
  std::string ply = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      original.vertices.size(), original.triangles.size());
  for (const Vec3& v : original.vertices) ply += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const Triangle& t : original.triangles) ply += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);

  const double volume = inspect_mesh(original, "original").volume;
  for (const auto& file : {folder.write("a.obj", obj_text(original)),
                           folder.write("a.stl", stl + "endsolid s\n"), folder.write("a.PLY", ply)}) {
    INFO(file);
    const MeshReport report = inspect_mesh(import_mesh(file), "imported");
    CHECK(report.mesh.triangles.size() == original.triangles.size());
    CHECK(report.holes.empty());
    // Importers keep single precision: 2^-24 of coordinates of size 3, against a radius of 0.5.
    CHECK(report.volume == Approx(volume).epsilon(3e-6));
  }
}

TEST_CASE("an OBJ file's quads are cut into triangles") {
  const TemporaryFolder folder;
  const auto file = folder.write("q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  CHECK(import_mesh(file).triangles.size() == 2);
}

TEST_CASE("a file that is no mesh file is refused before an importer sees it") {
  const TemporaryFolder folder;
  const std::string at = folder.path().string();
  CHECK(failure(folder.path() / "missing.obj") == fmt::format("'{}/missing.obj': no such file", at));
  CHECK(failure(folder.path()) == fmt::format("'{}': is a folder, not a file", at));
  CHECK(failure(folder.write("empty.obj", "")) == fmt::format("'{}/empty.obj': the file is empty", at));
  REQUIRE(::mkfifo((folder.path() / "pipe.obj").c_str(), 0600) == 0);
  CHECK(failure(folder.path() / "pipe.obj") ==
        fmt::format("'{}/pipe.obj': is a device or a pipe, not a file", at));
  CHECK(failure("/dev/zero") == "'/dev/zero': is a device or a pipe, not a file");
  std::filesystem::create_symlink("loop.obj", folder.path() / "loop.obj");
  CHECK_THAT(failure(folder.path() / "loop.obj"), Contains("loop.obj': Too many levels of symbolic links"));
  const auto huge = folder.write("huge.obj", "v");
  std::filesystem::resize_file(huge, (std::uint64_t{1} << 30) + 1);
  CHECK_THAT(failure(huge),
             Contains("has 1073741825 bytes, more than the 1073741824 this kind of file may have"));
}

TEST_CASE("garbage is refused with the importer's reason") {
  const TemporaryFolder folder;
  CHECK_THAT(failure(folder.write("garbage.glb", std::string("\x01\x02\xff\x1b[2Jnothing", 14))),
             Contains("garbage.glb': is not a mesh that can be read: ") && !Contains("\x1b"));
  CHECK_THAT(failure(folder.write("unknown.xyz", "hello")), Contains("is not a mesh that can be read"));
  CHECK_THAT(failure(kData / "bad_index.obj"), Contains("bad_index.obj': is not a mesh that can be read"));
  CHECK_THAT(failure(folder.write("a\n\x1b[2Jb.obj", "")), Contains("a\\x0a\\x1b[2Jb.obj"));
}

TEST_CASE("a damaged PLY file is an error with its line, never an invented vertex") {
  CHECK_THAT(failure(kData / "truncated.ply"), Contains("truncated.ply':12: the file ends at vertex 3 of 4"));
  CHECK_THAT(failure(kData / "bad_index.ply"), Contains("bad_index.ply': a face uses vertex 99 of 3"));
}

TEST_CASE("a mesh file opens no other file") {
  // A material library is not needed for the surface and simply not read.
  CHECK(import_mesh(kData / "foreign_materials.obj").triangles.size() == 1);
  CHECK_THAT(failure(kData / "foreign_buffer.gltf"),
             Contains("foreign_buffer.gltf': refers to the file '") &&
                 Contains("a mesh must be one file; export it as .glb"));
}

TEST_CASE("no cut and no changed byte of an OBJ file does worse than an error") {
  const TemporaryFolder folder;
  const std::string whole = obj_text(cube());
  for (std::size_t n = 0; n < whole.size(); n += 13) {
    REQUIRE_NOTHROW(failure(folder.write("cut.obj", whole.substr(0, n))));
    std::string changed = whole;
    changed[n] = '9';
    REQUIRE_NOTHROW(failure(folder.write("changed.obj", changed)));
  }
}
