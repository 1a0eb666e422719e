#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "tests/catch.h"
#include "tools/cli/progress.h"

using namespace bp;

namespace {

/// Returns the text that is written to stderr while `work` runs.
template <class Work>
std::string shown(const Work& work) {
  const std::string path = std::filesystem::temp_directory_path() / ("bp_progress_" + std::to_string(::getpid()));
  const int before = ::dup(2), file = ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  REQUIRE(before >= 0);
  REQUIRE(file >= 0);
  ::dup2(file, 2);
  work();
  ::dup2(before, 2);
  ::close(before);
  ::close(file);
  std::ifstream in(path);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return text;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("of a long run each pass is shown from its first step", "[quick][tools]") {
  const std::string text = shown([] {
    Progress progress("bplod", ProgressMode::bar);
    progress.begin("closing", 11, "scales");
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    progress.set(3, 11);
    progress.begin("meshing", 7, "openings");
    progress.set(0, 7);  // and then nothing for a long while
  });
  CHECK(has(text, "closing [######..................]  27% 3 of 11 scales"));
  CHECK(has(text, "meshing [........................]   0% 0 of 7 openings\x1b"));
}
