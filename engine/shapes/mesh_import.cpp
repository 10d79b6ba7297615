#include "engine/shapes/mesh_import.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>

#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/shapes/child_process.h"
#include "engine/shapes/file_bytes.h"
#include "engine/shapes/ply.h"

namespace firn {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The one file the importer may see. Requests for others are refused and remembered for the message.
class OneFileSystem final : public Assimp::IOSystem {
 public:
  OneFileSystem(std::string name, const Bytes& bytes, std::string& refused)
      : name_(std::move(name)), bytes_(bytes), refused_(refused) {}

  bool Exists(const char* file) const override { return file == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (file != name_ || std::strchr(mode, 'r') == nullptr) {
      refused_ = file;
      return nullptr;
    }
    return new Assimp::MemoryIOStream(bytes_.data(), bytes_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  const Bytes& bytes_;
  std::string& refused_;
};

/// Triangles of all parts of the file, with their node transforms applied. Runs in the child.
class Flattened {
 public:
  explicit Flattened(const aiScene& scene) {
    for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
      check_room(vertices_.size() / 3 + mesh->mNumVertices, triangles_.size() / 3 + mesh->mNumFaces);
      const auto base = static_cast<std::uint32_t>(vertices_.size() / 3);
      for (const aiVector3D& v : std::span(mesh->mVertices, mesh->mNumVertices)) {
        vertices_.insert(vertices_.end(), {v.x, v.y, v.z});
      }
      for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
        if (face.mNumIndices != 3) continue;
        for (unsigned index : std::span(face.mIndices, 3)) {
          if (index >= mesh->mNumVertices) {
            throw Error(ExitCode::input,
                        fmt::format("a face uses vertex {} of {}", index, mesh->mNumVertices));
          }
          triangles_.push_back(base + index);
        }
      }
    }
  }

  Bytes serialized() const {
    const std::uint64_t counts[2] = {vertices_.size() / 3, triangles_.size() / 3};
    Bytes bytes(sizeof counts + 4 * vertices_.size() + 4 * triangles_.size());
    std::memcpy(bytes.data(), counts, sizeof counts);
    if (!vertices_.empty()) std::memcpy(bytes.data() + sizeof counts, vertices_.data(), 4 * vertices_.size());
    if (!triangles_.empty()) {
      std::memcpy(bytes.data() + sizeof counts + 4 * vertices_.size(), triangles_.data(),
                  4 * triangles_.size());
    }
    return bytes;
  }

 private:
  static void check_room(std::size_t vertices, std::size_t triangles) {
    if (triangles <= kMostTriangles && vertices <= 3 * kMostTriangles) return;
    throw Error(ExitCode::input,
                fmt::format("has {} triangles, more than {}; simplify it: detail finer than a cell is "
                            "lost anyway",
                            triangles, kMostTriangles));
  }

  std::vector<float> vertices_;
  std::vector<std::uint32_t> triangles_;
};

Bytes import_in_child(const std::string& name, const Bytes& file) {
  std::string refused;
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFileSystem(name, file, refused));
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene =
      importer.ReadFile(name, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices |
                                  aiProcess_ValidateDataStructure);
  if (scene != nullptr) return Flattened(*scene).serialized();
  if (!refused.empty()) {
    throw Error(ExitCode::input,
                fmt::format("refers to the file '{}', and a mesh must be one file; export it as .glb, "
                            ".obj or .stl",
                            refused));
  }
  throw Error(ExitCode::input, fmt::format("is not a mesh that can be read: {}", importer.GetErrorString()));
}

TriangleMesh deserialized(const Bytes& bytes, const std::string& subject) {
  std::uint64_t counts[2] = {0, 0};
  if (bytes.size() >= sizeof counts) std::memcpy(counts, bytes.data(), sizeof counts);
  if (counts[0] > 3 * kMostTriangles || counts[1] > kMostTriangles ||
      bytes.size() != sizeof counts + 12 * (counts[0] + counts[1])) {
    throw Error(ExitCode::input, subject + ": the importer returned a torn answer; try again");
  }
  TriangleMesh mesh;
  mesh.vertices.resize(counts[0]);
  const std::uint8_t* at = bytes.data() + sizeof counts;
  for (Vec3& v : mesh.vertices) {
    float xyz[3];
    std::memcpy(xyz, at, sizeof xyz);
    v = Vec3(xyz[0], xyz[1], xyz[2]);
    at += sizeof xyz;
  }
  mesh.triangles.resize(counts[1]);
  if (!mesh.triangles.empty()) std::memcpy(mesh.triangles.data(), at, 12 * counts[1]);
  return mesh;
}

TriangleMesh import_ply(const Bytes& bytes, const std::string& subject) {
  PlyFile ply = read_ply(bytes, subject);
  const auto &x = ply.column("x", subject), &y = ply.column("y", subject), &z = ply.column("z", subject);
  TriangleMesh mesh;
  mesh.vertices.resize(ply.vertex_count);
  for (std::size_t i = 0; i < ply.vertex_count; ++i) mesh.vertices[i] = Vec3(x[i], y[i], z[i]);
  mesh.triangles = std::move(ply.triangles);
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t highest = std::max({t[0], t[1], t[2]});
    if (highest < ply.vertex_count) continue;
    throw Error(ExitCode::input,
                fmt::format("{}: a face uses vertex {} of {}", subject, highest, ply.vertex_count));
  }
  return mesh;
}

bool has_extension(const std::filesystem::path& file, std::string_view wanted) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == wanted;
}

}  // namespace

TriangleMesh import_mesh(const std::filesystem::path& file) {
  const std::string subject = quoted(file);
  const Bytes bytes = read_regular_file(file);
  if (has_extension(file, ".ply")) return import_ply(bytes, subject);

  // An importer's working set is some twenty times the file; a small file that asks for more is an attack or
  // damage.
  const std::uint64_t memory = (std::uint64_t{512} << 20) + 24 * bytes.size();
  const ChildLimits limits{memory, static_cast<unsigned>(4 + (bytes.size() >> 20)),
                           16 + 12 * (4 * std::uint64_t{kMostTriangles})};
  const std::string name = file.filename().string();
  return deserialized(run_in_child(subject, limits, [&] { return import_in_child(name, bytes); }), subject);
}

}  // namespace firn
