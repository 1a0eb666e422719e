// libFuzzer target. Most mutations die at a checksum, so the hashes of the header, the index and the end record are
// made to fit in half of the runs.
#include <xxhash.h>

#include <cstring>
#include <vector>

#include "tests/fuzz/brick_stream_entry.h"

namespace {

void seal(std::vector<std::uint8_t>& b, std::size_t begin, std::size_t end) {
  const std::uint64_t hash = XXH3_64bits(b.data() + begin, end - begin);
  std::memcpy(b.data() + end, &hash, 8);
}

std::uint32_t u32(const std::vector<std::uint8_t>& b, std::size_t at) {
  std::uint32_t value;
  std::memcpy(&value, b.data() + at, 4);
  return value;
}

void seal_all(std::vector<std::uint8_t>& b) {
  for (std::size_t at = 0; at + 12 <= b.size();) {
    const std::size_t size = u32(b, at + 4);
    if (size > b.size() - at - 8) return;
    const bool index = std::memcmp(&b[at + 8], "INDX", 4) == 0, batch = std::memcmp(&b[at + 8], "BTCH", 4) == 0;
    const bool sealed = at == 0 || index || std::memcmp(&b[at + 8], "TAIL", 4) == 0;
    if (sealed && size >= 16) seal(b, at + 8 + (index ? 8 : 0), at + size);
    at += 8 + size;
    if (batch && size >= 16) {
      const std::size_t packed = u32(b, at - size + 12);
      if (packed > b.size() - at) return;
      at += packed;
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)fuzz::read_brick_stream(data, size);
  std::vector<std::uint8_t> sealed(data, data + size);
  seal_all(sealed);
  (void)fuzz::read_brick_stream(sealed.data(), sealed.size());
  return 0;
}
