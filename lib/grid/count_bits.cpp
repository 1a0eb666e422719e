#include "lib/grid/count_bits.h"

#include <array>
#include <cstring>

namespace bp {

namespace {

constexpr std::size_t kBlockBytes = 128;

/// Counts the bits of at most a block. The loop vectorizes.
std::uint64_t count_block(const std::byte* bytes, std::size_t n) {
  std::array<std::uint64_t, kBlockBytes / 8> words{};
  std::memcpy(words.data(), bytes, n);
  std::uint64_t counts = 0;  // eight counts of a byte each, at most 16 * 8
  for (std::uint64_t w : words) {
    w -= (w >> 1) & 0x5555555555555555;
    w = (w & 0x3333333333333333) + ((w >> 2) & 0x3333333333333333);
    counts += (w + (w >> 4)) & 0x0f0f0f0f0f0f0f0f;
  }
  counts = (counts & 0x00ff00ff00ff00ff) + ((counts >> 8) & 0x00ff00ff00ff00ff);
  return (counts * 0x0001000100010001) >> 48;
}

}  // namespace

std::uint64_t count_bits(std::span<const std::byte> bytes) {
  std::uint64_t total = 0;
  for (; bytes.size() >= kBlockBytes; bytes = bytes.subspan(kBlockBytes))
    total += count_block(bytes.data(), kBlockBytes);
  return bytes.empty() ? total : total + count_block(bytes.data(), bytes.size());
}

}  // namespace bp
