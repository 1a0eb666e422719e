#include <cstring>
#include <vector>

#include "lib/store/page_block.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("blocks of pages keep their bytes when they move", "[quick][core]") {
  const std::size_t bytes = GENERATE(as<std::size_t>{}, 1, 512, 32767, 32768, 65536, 1 << 20);
  std::vector<PageBlock> blocks;  // moves them as it grows
  for (int i = 0; i < 50; ++i) {
    const PageBlock& block = blocks.emplace_back(bytes);
    REQUIRE(block.bytes() == bytes);
    REQUIRE(reinterpret_cast<std::uintptr_t>(block.data()) % alignof(std::max_align_t) == 0);
    std::memset(block.data(), i, bytes);
  }
  blocks.erase(blocks.begin() + 10, blocks.begin() + 20);
  blocks[3] = PageBlock(64);
  CHECK(blocks[3].bytes() == 64);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (i == 3) continue;
    const auto value = std::byte(i < 10 ? i : i + 10);
    REQUIRE(blocks[i].data()[0] == value);
    REQUIRE(blocks[i].data()[bytes - 1] == value);
  }
  const PageBlock empty;
  CHECK(empty.bytes() == 0);
  CHECK(empty.data() == nullptr);
}
