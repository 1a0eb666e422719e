#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <vector>

#include "io/files/file.h"
#include "io/files/final_names.h"
#include "io/files/kept_files.h"
#include "io/scene/scene_parts.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

std::vector<std::string> names_in(const TempDir& dir) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(dir.path("."))) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

void write_file(const std::string& path, const std::string& text) {
  OutputFile file(path, true);
  file.write(text);
  file.commit();
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("what a killed process left is taken over, and goes", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("out.partial-1", "left by a process that was killed, and longer than what is written now");
  SECTION("when the file is complete") {
    write_file(dir.path("out"), "new");
    CHECK(bytes_of_file(dir.path("out")) == "new");
    CHECK(names_in(dir) == Names{"out"});
  }
  SECTION("when it is given up") {
    { const OutputFile given_up(dir.path("out"), true); }
    CHECK(names_in(dir).empty());
  }
}

TEST_CASE("what a living process writes is left alone", "[quick][io]") {
  const TempDir dir;
  const int other = ::open(dir.file("out.partial-1", "others").c_str(), O_WRONLY | O_CLOEXEC);
  REQUIRE(::flock(other, LOCK_EX) == 0);
  write_file(dir.path("out"), "mine");
  CHECK(bytes_of_file(dir.path("out")) == "mine");
  CHECK(bytes_of_file(dir.path("out.partial-1")) == "others");
  ::close(other);
  CHECK(names_in(dir) == Names{"out", "out.partial-1"});
}

TEST_CASE("two may write the same file: each is whole, the last one stays", "[quick][io]") {
  const TempDir dir;
  OutputFile a(dir.path("out"), true), b(dir.path("out"), true);
  a.write("first");
  b.write("second");
  a.commit();
  CHECK(bytes_of_file(dir.path("out")) == "first");
  b.commit();
  CHECK(bytes_of_file(dir.path("out")) == "second");
  CHECK(names_in(dir) == Names{"out"});
}

TEST_CASE("links and pipes in the place of an unfinished file are not followed", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("victim", "kept");
  std::filesystem::create_symlink("victim", dir.path("out.partial-1"));
  std::filesystem::create_hard_link(dir.path("victim"), dir.path("out.partial-2"));
  REQUIRE(::mkfifo(dir.path("out.partial-3").c_str(), 0600) == 0);
  write_file(dir.path("out"), "new");
  CHECK(bytes_of_file(dir.path("victim")) == "kept");
  CHECK(bytes_of_file(dir.path("out")) == "new");
}

TEST_CASE("a file that appeared during the work is not replaced unasked", "[quick][io]") {
  const TempDir dir;
  OutputFile out(dir.path("out"), false);
  out.write("mine");
  (void)dir.file("out", "another's");
  CHECK_THROWS_WITH(out.commit(), Contains("appeared"));
  CHECK(bytes_of_file(dir.path("out")) == "another's");
}

TEST_CASE("of two that write one new file, the later one fails", "[quick][io]") {
  const TempDir dir;
  {
    OutputFile a(dir.path("out"), false), b(dir.path("out"), false);
    a.write("first");
    b.write("second");
    a.commit();
    CHECK_THROWS_AS(b.commit(), Error);
  }
  CHECK(bytes_of_file(dir.path("out")) == "first");
  CHECK(names_in(dir) == Names{"out"});
}

TEST_CASE("files that appear together appear all or not at all", "[quick][io]") {
  const TempDir dir;
  {
    std::vector<std::unique_ptr<OutputFile>> files;
    for (const char* name : {"a", "b", "c"}) {
      files.push_back(std::make_unique<OutputFile>(dir.path(name), false));
      files.back()->write("mine");
    }
    (void)dir.file("c", "another's");
    CHECK_THROWS_AS(OutputFile::commit_all(files), Error);
  }
  CHECK(names_in(dir) == Names{"c"});
  CHECK(bytes_of_file(dir.path("c")) == "another's");
}

TEST_CASE("each way of naming a file leaves one that is there alone", "[quick][io]") {
  const auto place = GENERATE(detail::place_by_rename, detail::place_by_link, detail::place_by_claim);
  const TempDir dir;
  const std::string from = dir.file("from", "new"), taken = dir.file("taken", "old");
  std::filesystem::create_symlink("nowhere", dir.path("link"));
  CHECK(place(from.c_str(), taken.c_str()) == EEXIST);
  CHECK(place(from.c_str(), dir.path("link").c_str()) == EEXIST);
  CHECK(bytes_of_file(taken) == "old");
  CHECK(place(from.c_str(), dir.path("name").c_str()) == 0);
  CHECK(bytes_of_file(dir.path("name")) == "new");
  CHECK(names_in(dir) == Names{"link", "name", "taken"});
}

TEST_CASE("a file that is kept is neither replaced, removed nor written over, by whatever name", "[quick][io]") {
  const KeepsInputs scope;
  const TempDir dir;
  const std::string kept = dir.file("out.partial-1", "an input of that name");
  keep_file(kept);
  std::filesystem::create_hard_link(kept, dir.path("hard"));
  std::filesystem::create_symlink("out.partial-1", dir.path("soft"));
  write_file(dir.path("out"), "new");
  CHECK(bytes_of_file(kept) == "an input of that name");
  for (const char* name : {"out.partial-1", "hard", "soft", "./soft"}) {
    CAPTURE(name);
    CHECK(remove_file(dir.path(name)) != 0);
    CHECK_THROWS_AS(place_file(dir.path("out"), dir.path(name), true), Error);
    CHECK_THROWS_AS(OutputFile(dir.path(name), true), Error);
  }
  CHECK(names_in(dir) == Names{"hard", "out", "out.partial-1", "soft"});
  CHECK(holds_kept(dir.path(".")));
  CHECK_FALSE(holds_kept(dir.path("elsewhere")));
}

TEST_CASE("a file that was read after the output was opened is kept", "[quick][io]") {
  const KeepsInputs scope;
  const TempDir dir;
  OutputFile out(dir.path("out"), true);
  out.write("new");
  keep_file(dir.file("out", "read meanwhile"));
  CHECK_THROWS_AS(out.commit(), Error);
  CHECK(bytes_of_file(dir.path("out")) == "read meanwhile");
}

TEST_CASE("another file that has the number of one that is gone is not kept", "[quick][io]") {
  const KeepsInputs scope;
  const TempDir dir;
  const std::string first = dir.file("first", "");
  std::filesystem::create_hard_link(first, dir.path("second"));
  keep_file(first);
  CHECK(is_kept(dir.path("second")));
  std::filesystem::remove(first);
  CHECK_FALSE(is_kept(dir.path("second")));
}

TEST_CASE("files are kept until the last scope ends, and without one not at all", "[quick][io]") {
  const TempDir dir;
  const std::string file = dir.file("file", "old");
  keep_file(file);
  CHECK_FALSE(is_kept(file));
  {
    const KeepsInputs outer;
    {
      const KeepsInputs inner;
      keep_file(file);
    }
    CHECK(is_kept(file));
    CHECK_THROWS_AS(OutputFile(file, true), Error);
  }
  CHECK_FALSE(is_kept(file));
  CHECK_FALSE(holds_kept(dir.path(".")));
  OutputFile out(file, true);
  out.write("new");
  out.commit();
  CHECK(bytes_of_file(file) == "new");
}

TEST_CASE("the folder of a path is what its name stands in", "[quick][io]") {
  CHECK(folder_of("file") == ".");
  CHECK(folder_of("/file") == "/");
  CHECK(folder_of("a/b/file") == "a/b");
  CHECK(folder_of("../file") == "..");
}
TEST_CASE("the other files of a glTF are found in any amount of JSON", "[quick][io]") {
  const TempDir dir;
  const std::string data = "data:;base64," + std::string(3'000'000, 'A');
  const std::string rest = R"("nodes":[{"uri":"no.bin","buffers":[{"uri":"no.bin"}]}],"uri":"no.bin",)"
                           R"("buffers":[{"uri":")" +
                           data +
                           R"("},{"uri":"a%20b.bin","extras":{"uri":"no.bin"}},)"
                           R"({"name":"\"uri\":\\","uri":"\u00e9\/c.bin"}],"extras":[0.)" +
                           std::string(100'000, '1') + R"(,"\u00e9)" + std::string(100'000, 'x') +
                           R"(\"{["],"images":[{"uri":"d.png"},{"bufferView":1},7,{"uri":7},[{"uri":"no.bin"}]]})";
  const auto names_in = [&](const std::string& json) {
    std::vector<std::string> names = parts_of_scene(dir.file("a.gltf", json));
    const auto size = std::uint32_t(json.size());
    const std::uint32_t head[] = {2, size + 28, size, 0x4E4F534A};
    const std::string bytes(reinterpret_cast<const char*>(head), sizeof head);
    CHECK(parts_of_scene(dir.file("a.glb", "glTF" + bytes + json + R"({"buffers":[{"uri":"no.bin"}]})")) == names);
    return names;
  };
  const std::vector<std::string> all{dir.path("a b.bin"), dir.path("\u00e9/c.bin"), dir.path("d.png")};
  CHECK(names_in("{" + rest) == all);
  for (const std::size_t blanks : {65'400, 65'500, 65'535, 65'536})
    CHECK(names_in("{" + std::string(blanks, ' ') + rest) == all);
  CHECK(names_in("{" + rest.substr(0, rest.size() - 20)) == all);  // truncated: what was named before
  CHECK(names_in("").empty());
  CHECK(names_in(R"([{"buffers":[{"uri":"no.bin"}]}])").empty());
  CHECK(names_in(std::string(100'000, '[')).empty());
}

TEST_CASE("what a file names must be a regular file, and is not waited for", "[quick][io]") {
  const TempDir dir;
  const std::string pipe = dir.path("pipe"), plain = dir.path("plain"), link = dir.path("link");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);  // nobody writes: opened as a user's file, it would wait for ever
  write_file(plain, "text");
  std::filesystem::create_symlink(plain, link);
  CHECK(InputFile(plain, NamedBy::file).size() == 4);
  CHECK(read_text(link, 100, NamedBy::file) == "text");
  for (const std::string& path : {pipe, std::string("/dev/zero"), std::string("/dev/null"), dir.path(".")})
    CHECK_THROWS_AS(InputFile(path, NamedBy::file), Error);
  CHECK_THROWS_AS(InputFile("-", NamedBy::file), Error);  // the name of no file here
}

TEST_CASE("a refusal of outputs waits for their first byte, and leaves no file", "[quick][io]") {
  const TempDir dir;
  refuse_outputs(std::make_shared<const Error>(ErrorCode::out_of_resource, "no room"));
  {
    OutputFile file(dir.path("a"), true);
    file.write("a byte that waits");
    CHECK_THROWS_WITH(file.commit(), "no room");
  }
  CHECK_THROWS_WITH(check_outputs(), "no room");
  CHECK(names_in(dir).empty());
  refuse_outputs(nullptr);
  check_outputs();
  write_file(dir.path("a"), "a byte");
  CHECK(names_in(dir) == Names{"a"});
}

TEST_CASE("an output of a sink hands on all bytes in their order, and makes no file", "[quick][io]") {
  const TempDir dir;
  std::string taken;
  const auto take = [&](std::span<const std::byte> bytes) {
    taken.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const std::string small = "small", large(std::size_t(3) << 20, 'x');
  SECTION("until it is complete") {
    OutputFile out(dir.path("out"), OutputFile::Sink(take));
    for (const std::string& text : {small, large, small}) out.write(text);
    out.commit();
    CHECK(taken == small + large + small);
    CHECK(out.bytes() == taken.size());
  }
  SECTION("an error of the sink is passed on") {
    OutputFile out(dir.path("out"), OutputFile::Sink([](std::span<const std::byte>) { throw Cancelled{}; }));
    out.write(small);
    CHECK_THROWS_AS(out.commit(), Cancelled);
  }
  CHECK(names_in(dir).empty());
}
