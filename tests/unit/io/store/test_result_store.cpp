#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "io/store/result_store.h"
#include "lib/store/result_key.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

namespace bp::test {

namespace {

namespace fs = std::filesystem;

ResultKey key(std::int64_t n) {
  return KeyHash("test").add(n).key();
}

std::vector<fs::path> files_of(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// root may write anywhere, so it is somebody else meanwhile.
class Unprivileged {
 public:
  Unprivileged() : root_(::geteuid() == 0) {
    if (root_) REQUIRE(::setresuid(65534, 65534, 0) == 0);
  }
  ~Unprivileged() {
    if (root_) (void)!::setresuid(0, 0, 0);
  }
  Unprivileged(const Unprivileged&) = delete;
  Unprivileged& operator=(const Unprivileged&) = delete;

 private:
  bool root_;
};

/// No file may grow meanwhile, which tools take for a full disk.
class FullDisk {
 public:
  FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit none{0, before_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &none) == 0);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    (void)std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

}  // namespace

TEST_CASE("a result comes back as it was put, also for another process", "[quick][io][cache]") {
  const TempDir dir;
  const std::string folder = dir.path("a");
  const std::string bytes = GENERATE(std::string(), std::string("x"), std::string(100000, '\0') + "end");
  std::string out;
  {
    const auto store = open_result_store(folder);
    CHECK_FALSE(store->get(key(1), out));
    store->put(key(1), bytes);
  }
  const auto store = open_result_store(folder);
  REQUIRE(store->get(key(1), out));
  CHECK(out == bytes);
  CHECK_FALSE(store->get(key(2), out));
  CHECK(files_of(folder).size() == 1);
}

TEST_CASE("a store that was given nothing leaves no folder", "[quick][io][cache]") {
  const TempDir dir;
  const std::string folder = dir.path("results");
  std::string out;
  { CHECK_FALSE(open_result_store(folder)->get(key(1), out)); }
  CHECK_FALSE(fs::exists(folder));
  { open_result_store(folder)->put(key(1), "result"); }
  CHECK(fs::exists(folder));
}

TEST_CASE("a damaged, truncated or foreign result is passed over, and replaced", "[quick][io][cache]") {
  const TempDir dir;
  const std::string folder = dir.path("store"), bytes(5000, 'q');
  const auto store = open_result_store(folder);
  store->put(key(1), bytes);
  const fs::path file = files_of(folder).at(0);
  const std::string good = bytes_of(file);
  std::string out;
  const auto try_with = [&](const std::string& bad) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bad;
    CHECK_FALSE(store->get(key(1), out));
    store->put(key(1), bytes);
    REQUIRE(store->get(key(1), out));
    CHECK(out == bytes);
  };
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = char(bad[i] ^ 0x40);
    CAPTURE(i);
    try_with(bad);
  }
  try_with("");
  try_with(good.substr(0, good.size() - 1));
  try_with(good + "x");
  store->put(key(2), "another");
  for (const fs::path& other : files_of(folder))
    if (other != file) try_with(bytes_of(other));
  CHECK(files_of(folder).size() == 2);
}

TEST_CASE("what cannot be replaced is an error", "[quick][io][cache]") {
  const TempDir dir;
  const auto store = open_result_store(dir.path("store"));
  store->put(key(1), "x");
  const fs::path file = files_of(dir.path("store")).at(0);
  fs::remove(file);
  fs::create_directories(file / "in the way");
  std::string out;
  CHECK_FALSE(store->get(key(1), out));
  CHECK_THROWS_AS(store->put(key(1), "x"), Error);
}

TEST_CASE("where nothing may be written, results are read, and that is said once", "[quick][io][cache]") {
  const TempDir dir;
  const std::string folder = dir.path("store");
  open_result_store(folder)->put(key(1), "x");
  const auto allow = [&](fs::perms perms) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_directory()) fs::permissions(entry.path(), perms);
    fs::permissions(folder, perms);
  };
  allow(fs::perms::all & ~(fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write));
  for (const fs::path& file : files_of(folder)) fs::permissions(file, fs::perms::others_read, fs::perm_options::add);
  {
    const Unprivileged somebody;
    std::vector<std::string> said;
    const auto store = open_result_store(folder, [&](const std::string& why) { said.push_back(why); });
    std::string out;
    store->put(key(1), "x");
    CHECK(said.empty());  // it is kept already
    for (int i = 2; i < 5; ++i) store->put(key(i), "y");
    CHECK(store->get(key(1), out));
    CHECK_FALSE(store->get(key(2), out));
    REQUIRE(said.size() == 1);
    CHECK_THAT(said[0], Contains("Permission denied"));
    CHECK_THROWS_AS(open_result_store(folder)->put(key(2), "y"), Error);
  }
  allow(fs::perms::owner_all);
}

TEST_CASE("where a disk is full, that is said once, and nothing is kept", "[quick][io][cache]") {
  const TempDir dir;
  const std::string folder = dir.path("store");
  std::vector<std::string> said;
  const auto store = open_result_store(folder, [&](const std::string& why) { said.push_back(why); });
  {
    const FullDisk full;
    for (int i = 1; i < 4; ++i) store->put(key(i), "y");
    CHECK_THROWS_AS(open_result_store(folder)->put(key(1), "y"), Error);
  }
  REQUIRE(said.size() == 1);
  CHECK_THAT(said[0], Contains("cannot write"));
  store->put(key(1), "y");
  CHECK(files_of(folder).empty());
}

TEST_CASE("threads may put the same results at once, and none is ever missing", "[quick][io][cache]") {
  const TempDir dir;
  const auto a = open_result_store(dir.path("store")), b = open_result_store(dir.path("store"));
  const auto bytes = [](int i) { return std::string(100, char('a' + i % 10)); };
  if (GENERATE(false, true)) {  // damaged ones are replaced at once, too
    for (int i = 0; i < 10; ++i) a->put(key(i), bytes(i));
    for (const fs::path& file : files_of(dir.path("store"))) fs::resize_file(file, 10);
  }
  std::atomic<int> missing{0};
  const auto work = [&](ResultStore& store) {
    std::string out;
    for (int i = 0; i < 100; ++i) {
      store.put(key(i % 10), bytes(i));
      if (!store.get(key(i % 10), out) || out != bytes(i)) ++missing;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back([&, i] { work(i % 2 == 0 ? *a : *b); });
  for (std::thread& thread : threads) thread.join();
  CHECK(missing == 0);
  std::string out;
  for (int i = 0; i < 10; ++i) {
    REQUIRE(a->get(key(i), out));
    CHECK(out == bytes(i));
  }
  CHECK(files_of(dir.path("store")).size() == 10);
}

TEST_CASE("keys tell values, and where one ends and the next begins", "[quick][core][cache]") {
  using View = std::string_view;
  CHECK(KeyHash("a").add(View("xy")).add(View("z")).key() != KeyHash("a").add(View("x")).add(View("yz")).key());
  CHECK(KeyHash("a").add(0.0).key() != KeyHash("a").add(-0.0).key());
  CHECK(KeyHash("a").add(std::int64_t(1)).key() != KeyHash("b").add(std::int64_t(1)).key());
  CHECK(KeyHash("a").add(1.5).key() == KeyHash("a").add(1.5).key());
}

}  // namespace bp::test
