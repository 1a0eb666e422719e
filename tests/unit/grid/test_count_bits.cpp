#include <bit>
#include <random>
#include <vector>

#include "lib/grid/count_bits.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("bits are counted wherever a row of bytes begins and ends", "[quick][grid]") {
  std::mt19937 random(3);
  std::vector<std::byte> bytes(700);
  for (std::byte& b : bytes) b = std::byte(random() % 3 == 0 ? 0xff : random() % 256);
  for (std::size_t begin = 0; begin < 9; ++begin) {
    std::uint64_t count = 0;
    for (std::size_t end = begin; end < bytes.size(); ++end) {
      REQUIRE(count_bits(std::span(bytes).subspan(begin, end - begin)) == count);
      count += std::uint64_t(std::popcount(std::to_integer<unsigned>(bytes[end])));
    }
  }
  const std::vector<std::byte> ones(256, std::byte(0xff));
  CHECK(count_bits(ones) == 2048);
}
