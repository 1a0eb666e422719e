#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>

#include "tests/catch.h"
#include "tests/fuzz/entries.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kHangSeconds = 10;  ///< of computing, as in fuzz_target.cpp

/// Random decisions; the entry aborts on a finding.
template <class Entry>
void run(Entry entry, int count) {
  std::mt19937 random(1);
  for (int i = 0; i < count; ++i) {
    Bytes bytes(random() % 400);
    for (std::uint8_t& b : bytes) b = std::uint8_t(random());
    entry(bytes.data(), bytes.size());
  }
}

/// The shrunken inputs of earlier findings: the files of a folder of tests/data/bugs with this ending. The entry aborts
/// if something is wrong again; Catch2 then names the file.
template <class Entry>
void run_findings(Entry entry, const std::string& folder, const std::string& ending) {
  std::set<std::filesystem::path> files;
  for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(BP_BUGS) / folder)) {
    if (file.path().extension() == ending) files.insert(file.path());
  }
  REQUIRE_FALSE(files.empty());
  for (const std::filesystem::path& file : files) {
    CAPTURE(file);
    std::ifstream in(file, std::ios::binary);
    const Bytes bytes(std::istreambuf_iterator<char>(in), {});
    REQUIRE_FALSE(bytes.empty());
    const std::clock_t begin = std::clock();
    entry(bytes.data(), bytes.size());
    CHECK(double(std::clock() - begin) / CLOCKS_PER_SEC < kHangSeconds);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

TEST_CASE("streams of hostile contents are refused or end in a sound proxy", "[quick][fuzz]") {
  run(fuzz::stream_stages, 300);
}
TEST_CASE("scenes of extreme numbers are refused or end in a proxy around them", "[quick][fuzz]") {
  run(fuzz::scene, 300);
}
TEST_CASE("streams with any orientation are refused or end in a sound proxy", "[quick][fuzz]") {
  run(fuzz::turned, 150);
}
TEST_CASE("damaged triangles of Draco are refused or read", "[quick][fuzz]") {
  run(fuzz::draco, 300);
}
TEST_CASE("damaged weights are refused or applied", "[quick][fuzz]") {
  run(fuzz::weights, 200);
}
TEST_CASE("a sound tileset with leaves is proven, one with a hole is not", "[quick][fuzz]") {
  run(fuzz::tileset, 300);
}
TEST_CASE("options of extreme values are refused or obeyed", "[quick][fuzz]") {
  run(fuzz::options, 300);
}

TEST_CASE("what the fuzzer of brick streams has found stays mended", "[quick][fuzz]") {
  run_findings(LLVMFuzzerTestOneInput, "", ".bpv");
}
TEST_CASE("what the fuzzer of streams and stages has found stays mended", "[quick][fuzz]") {
  run_findings(fuzz::stream_stages, "stream_stages", ".input");
}
TEST_CASE("what the fuzzer of scenes has found stays mended", "[quick][fuzz]") {
  run_findings(fuzz::scene, "scene", ".input");
}
TEST_CASE("what the fuzzer of options has found stays mended", "[quick][fuzz]") {
  run_findings(fuzz::options, "options", ".input");
}
