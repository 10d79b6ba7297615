// What a scene file can be apart from a scene: none of it may hang, crash or fill the memory.
#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/engine/scene/scene_text_support.h"

namespace firn::test {
namespace {

/// A directory that goes with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "firn_scene_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

void write(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string error_of_file(const std::filesystem::path& path) {
  return error_of([&] { read_scene(path); });
}

TEST_CASE("a scene is read from its file") {
  const Folder folder;
  write(folder / "a.toml", kSmallest);
  const SceneDescription d = read_scene(folder / "a.toml");
  CHECK(d.file == folder / "a.toml");
  CHECK(d.bodies[0].mark.file == (folder / "a.toml").string());
}

TEST_CASE("a file that is no scene is an error that names it") {
  const Folder folder;
  const auto missing = folder / "none.toml";
  CHECK(error_of_file(missing) == missing.string() + ": no such file");

  const auto directory = folder / "directory.toml";
  std::filesystem::create_directory(directory);
  CHECK(error_of_file(directory) == directory.string() + ": found no regular file; allowed: a scene in TOML");
  CHECK(error_of_file(directory / "x.toml") == (directory / "x.toml").string() + ": no such file");

  const auto pipe = folder / "pipe.toml";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(error_of_file(pipe) == pipe.string() + ": found no regular file; allowed: a scene in TOML");
  CHECK(error_of_file("/dev/zero") == "/dev/zero: found no regular file; allowed: a scene in TOML");

  const auto loop = folder / "loop.toml";
  std::filesystem::create_symlink(loop, loop);
  CHECK(error_of_file(loop) == loop.string() + ": cannot be read: Too many levels of symbolic links");
}

TEST_CASE("a file of more than 16 MiB is refused, one of 16 MiB is read") {
  const Folder folder;
  const auto path = folder / "huge.toml";
  write(path, kSmallest + "#");
  std::filesystem::resize_file(path, (std::uintmax_t{16} << 20) + 1);
  CHECK(error_of_file(path) ==
        path.string() + ": found a file of more than 16 MiB; allowed: a scene in TOML");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40);
  CHECK(error_of_file(path) ==
        path.string() + ": found a file of more than 16 MiB; allowed: a scene in TOML");

  std::string text = kSmallest + "#";
  text.resize(std::size_t{16} << 20, ' ');
  write(path, text);
  CHECK(read_scene(path).bodies.size() == 1);
}

TEST_CASE("a file's name is safe to print") {
  CHECK(error_of_file("a\x1b[31m\nb.toml") == "a\\x1b[31m\\x0ab.toml: no such file");
}

TEST_CASE("keys and values a million levels deep are refused at their place") {
  const auto repeat = [](std::string_view part, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += part;
    return out;
  };
  const std::string key_error = "a.toml:1:32: found a key of more than 16 parts; allowed: at most 16";
  CHECK(error_in(repeat("a.", 1'000'000) + "a = 1") == key_error);
  CHECK(error_in("[" + repeat("a.", 1'000'000) + "a]") ==
        "a.toml:1:33: found a key of more than 16 parts; allowed: at most 16");
  CHECK(error_in(repeat("[", 1'000'000)).find("a.toml:1:3: ") == 0);
  CHECK(error_in("a = " + repeat("[", 1'000'000)).find("exceeded maximum nested value depth") !=
        std::string::npos);
  CHECK(error_in("a = " + repeat("{a=", 1'000'000)).find("exceeded maximum nested value depth") !=
        std::string::npos);
  // As deep as both limits let through: freed without running out of stack.
  const std::string deep_key = repeat("a.", 15) + "a = ";
  CHECK(error_in(deep_key + repeat("{" + deep_key, 250) + "1" + repeat("}", 250)).find("unknown key 'a'") !=
        std::string::npos);
}

TEST_CASE("dots in strings, comments and numbers are no keys") {
  std::string text = "title = \"a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t\\\".u.v.w.x.y.z\"\n";
  text += "# a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t.u.v.w.x.y.z\n";
  text += "description = '''\nIt's ...\n. . . . . . . . . . . . . . . . . . . . . . . .'''\n";
  CHECK(read(text + kSmallest).title.size() == 52);
  CHECK(error_in("a = [" + std::string(500, ' ') +
                 "1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, "
                 "1.5, 1.5, 1.5, 1.5, 1.5, 1.5]")
            .find("unknown key 'a'") != std::string::npos);
}

TEST_CASE("a scene of very many materials and bodies is answered at once") {
  std::string text = "[simulation]\ncell_size = 1\nduration = 1\n";
  for (int i = 0; i < 5'000; ++i) {
    const std::string n = std::to_string(i);
    text += "[materials.m" + n + "]\nmodel = \"snow_stomakhin_2013\"\n[[bodies]]\nname = \"b" + n +
            "\"\nmaterial = \"x" + n + "\"\npoints = \"a.csv\"\n";
  }
  CHECK(error_in(text).find("unknown material 'x0'") != std::string::npos);
}

}  // namespace
}  // namespace firn::test
