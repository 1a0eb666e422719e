#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/grid/brick.h"

/// Bytes of a brick and their compression, shared by the brick stream and the shelf. Thread-safe: contexts are per
/// thread.
namespace bp::detail {

constexpr std::size_t kBrickBytes = kBrickWords * 8;
constexpr int kDefaultLevel = 1;  ///< level of zstd

/// Byte k * 4096 + z * 64 + y holds the voxels 8k .. 8k + 7 of the row (y, z), lowest bit first. Column after column of
/// eight voxels: neighbours in y and z are neighbours in the file, which zstd packs 5 to 23 % smaller than whole rows,
/// at the same speed (XOR with the previous row or slice only helps axis-aligned boxes).
void to_planes(const BrickBits& bits, std::byte* out);
void from_planes(const std::byte* in, BrickBits& bits);

/// Returns the largest size that `raw` bytes can compress to.
[[nodiscard]] std::size_t compress_bound(std::size_t raw);
/// Replaces `out` by one zstd frame with its content size and, if asked, a checksum of the content. Same bytes for the
/// same input and level, whatever the thread.
void compress(std::span<const std::byte> in, int level, bool checksum, std::vector<std::byte>& out);
/// Decompresses. Returns null if `in` is exactly one valid frame of out.size() bytes, now in `out`; otherwise what is
/// wrong.
[[nodiscard]] const char* decompress(std::span<const std::byte> in, std::span<std::byte> out);

}  // namespace bp::detail
