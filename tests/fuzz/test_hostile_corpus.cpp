#include <random>

#include "tests/catch.h"
#include "tests/fuzz/entries.h"

namespace {

/// Random decisions; the entry aborts on a finding.
template <class Entry>
void run(Entry entry, int count) {
  std::mt19937 random(1);
  for (int i = 0; i < count; ++i) {
    std::vector<std::uint8_t> bytes(random() % 400);
    for (std::uint8_t& b : bytes) b = std::uint8_t(random());
    entry(bytes.data(), bytes.size());
  }
}

}  // namespace

TEST_CASE("streams of hostile contents are refused or end in a sound proxy", "[quick][fuzz]") {
  run(fuzz::stream_stages, 300);
}
TEST_CASE("scenes of extreme numbers are refused or end in a proxy around them", "[quick][fuzz]") {
  run(fuzz::scene, 300);
}
TEST_CASE("options of extreme values are refused or obeyed", "[quick][fuzz]") {
  run(fuzz::options, 300);
}
