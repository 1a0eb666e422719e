#include "io/store/brick_codec.h"

#include <zstd.h>

#include <array>
#include <bit>
#include <cstring>
#include <memory>

#include "lib/core/error.h"

namespace bp::detail {

static_assert(std::endian::native == std::endian::little, "words are stored as they lie in memory");

namespace {

/// Transposes 8 x 8 bytes; it is its own inverse.
void transpose_bytes(std::array<std::uint64_t, 8>& w) {
  const auto swap = [&w](std::size_t i, std::size_t distance, int shift, std::uint64_t mask) {
    const std::uint64_t t = ((w[i] >> shift) ^ w[i + distance]) & mask;
    w[i + distance] ^= t;
    w[i] ^= t << shift;
  };
  for (const std::size_t i : {0, 1, 2, 3}) swap(i, 4, 32, 0x00000000ffffffff);
  for (const std::size_t i : {0, 1, 4, 5}) swap(i, 2, 16, 0x0000ffff0000ffff);
  for (const std::size_t i : {0, 2, 4, 6}) swap(i, 1, 8, 0x00ff00ff00ff00ff);
}

struct FreeCompressor {
  void operator()(ZSTD_CCtx* c) const { ZSTD_freeCCtx(c); }
};
struct FreeDecompressor {
  void operator()(ZSTD_DCtx* d) const { ZSTD_freeDCtx(d); }
};

template <class Context>
Context* require(Context* context) {
  if (context == nullptr) fail(ErrorCode::out_of_resource, "no memory for a zstd context");
  return context;
}

}  // namespace

void to_planes(const BrickBits& bits, std::byte* out) {
  std::array<std::uint64_t, 8> w;
  for (std::size_t i = 0; i < kBrickWords; i += 8) {
    std::memcpy(w.data(), &bits[i], 64);
    transpose_bytes(w);
    for (std::size_t k = 0; k < 8; ++k) std::memcpy(out + k * kBrickWords + i, &w[k], 8);
  }
}

void from_planes(const std::byte* in, BrickBits& bits) {
  std::array<std::uint64_t, 8> w;
  for (std::size_t i = 0; i < kBrickWords; i += 8) {
    for (std::size_t k = 0; k < 8; ++k) std::memcpy(&w[k], in + k * kBrickWords + i, 8);
    transpose_bytes(w);
    std::memcpy(&bits[i], w.data(), 64);
  }
}

std::size_t compress_bound(std::size_t raw) {
  return ZSTD_compressBound(raw);
}

void compress(std::span<const std::byte> in, int level, bool checksum, std::vector<std::byte>& out) {
  thread_local const std::unique_ptr<ZSTD_CCtx, FreeCompressor> context(require(ZSTD_createCCtx()));
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, checksum ? 1 : 0);
  out.resize(ZSTD_compressBound(in.size()));
  const std::size_t n = ZSTD_compress2(context.get(), out.data(), out.size(), in.data(), in.size());
  if (ZSTD_isError(n)) fail(ErrorCode::out_of_resource, "zstd cannot compress: {}", ZSTD_getErrorName(n));
  out.resize(n);
}

const char* decompress(std::span<const std::byte> in, std::span<std::byte> out) {
  thread_local const std::unique_ptr<ZSTD_DCtx, FreeDecompressor> context(require(ZSTD_createDCtx()));
  if (ZSTD_findFrameCompressedSize(in.data(), in.size()) != in.size()) return "is not one whole zstd frame";
  if (ZSTD_getFrameContentSize(in.data(), in.size()) != out.size())
    return "holds another number of bytes than declared";
  const std::size_t n = ZSTD_decompressDCtx(context.get(), out.data(), out.size(), in.data(), in.size());
  if (ZSTD_isError(n)) return "cannot be decompressed";
  return n == out.size() ? nullptr : "holds another number of bytes than declared";
}

}  // namespace bp::detail
