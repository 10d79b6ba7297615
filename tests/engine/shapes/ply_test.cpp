#include "engine/shapes/ply.h"

#include <cstring>

#include <catch2/catch.hpp>

#include "engine/base/error.h"

using namespace firn;

namespace {

PlyFile parse(const std::string& text) {
  return read_ply({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "f.ply");
}

std::string failure(const std::string& text) {
  try {
    parse(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

const std::string kHeader =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty double y\nproperty "
    "float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kVertices = "0 0 0\n1 0 0\r\n1 1.5 0\n 0 +1e0 -2 \n";

template <class T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string binary() {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty "
      "uchar q\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_index\nend_header\n";
  for (int i = 0; i < 3; ++i) {
    append(text, static_cast<float>(i));
    append(text, 0.1 * i);
    append(text, static_cast<unsigned char>(i));
    append(text, -1.0f);
  }
  append(text, static_cast<unsigned char>(3));
  for (int i : {2, 1, 0}) append(text, i);
  append(text, static_cast<unsigned char>(2));  // a line, not a triangle
  for (int i : {0, 1}) append(text, i);
  return text;
}

}  // namespace

TEST_CASE("an ASCII PLY file is read, polygons as fans") {
  const PlyFile ply = parse(kHeader + kVertices + "4 0 1 2 3\n");
  CHECK(ply.vertex_count == 4);
  CHECK(ply.vertex.at("y") == std::vector<double>{0, 0, 1.5, 1});
  CHECK(ply.vertex.at("z") == std::vector<double>{0, 0, 0, -2});
  CHECK(ply.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("a binary PLY file is read, properties of any type skipped or kept") {
  const PlyFile ply = parse(binary());
  CHECK(ply.vertex.at("x") == std::vector<double>{0, 1, 2});
  CHECK(ply.vertex.at("y") == std::vector<double>{0, 0.1, 0.2});
  CHECK(ply.vertex.at("q") == std::vector<double>{0, 1, 2});
  CHECK(ply.triangles == std::vector<Triangle>{{2, 1, 0}});
}

TEST_CASE("a bad PLY file is refused at the place that is wrong") {
  CHECK(failure("plx\n") == "f.ply:1: is not a PLY file: its first line is not 'ply'");
  CHECK(failure("ply\nformat binary_big_endian 1.0\n") ==
        "f.ply:2: format 'binary_big_endian' is not read; known: ascii, binary_little_endian");
  CHECK(failure("ply\nformat ascii 1.0\nelement vertex many\n") ==
        "f.ply:3: expected 'element <name> <count>'");
  CHECK(failure("ply\nformat ascii 1.0\nelement vertex 1\nproperty foo x\n") ==
        "f.ply:4: unknown type 'foo'");
  CHECK(failure("ply\nformat ascii 1.0\n") == "f.ply:2: the file ends in the middle");
  CHECK(failure(kHeader + "0 0 0\n1 0\n") == "f.ply:12: fewer values than the header announces");
  CHECK(failure(kHeader + "0 0 0\n1 0 0 0\n") == "f.ply:12: more values than the header announces");
  CHECK(failure(kHeader + "0 0 zero\n1 0 0 0\n") == "f.ply:11: 'zero' is not a number");
  CHECK(failure(kHeader + "0 0 0\n") == "f.ply:12: the file ends at vertex 2 of 4");
  CHECK(failure(kHeader + kVertices + "4 0 1 2 -3\n") ==
        "f.ply:15: vertex index -3 of a face is out of range");
  CHECK(failure(kHeader + kVertices + "1e9 0\n") == "f.ply:15: a list with an impossible length");
  CHECK(failure(binary().substr(0, binary().size() - 5)) == "f.ply: the file ends at face 2 of 2");
}

TEST_CASE("a header that announces billions of vertices costs nothing") {
  CHECK(failure("ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\nend_header\n0\n") ==
        "f.ply:5: the header announces 2000000000 of 'vertex', but the file has only 2 bytes left");
  CHECK(failure("ply\nformat ascii 1.0\nelement vertex 2\nend_header\n0\n") ==
        "f.ply:4: the header announces 2 of 'vertex', but the file has only 2 bytes left");
}

TEST_CASE("no cut and no changed byte of a PLY file does worse than an error") {
  for (const std::string& whole : {kHeader + kVertices + "4 0 1 2 3\n", binary()}) {
    for (std::size_t n = 0; n < whole.size(); ++n) {
      const std::string cut = whole.substr(0, n);
      REQUIRE_NOTHROW(failure(cut));
      for (char c : {'\0', '9', '\n', '-', '\xff'}) {
        std::string changed = whole;
        changed[n] = c;
        REQUIRE_NOTHROW(failure(changed));
      }
    }
  }
}
