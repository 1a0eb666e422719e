#pragma once
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/scene/detail/ply/ply_header.h"

/// Values of a binary PLY; `swap`: of the other byte order.
namespace bp {

template <class Bits>
Bits load_bits(const std::byte* from, bool swap) {
  Bits bits;
  std::memcpy(&bits, from, sizeof bits);
  if constexpr (sizeof(Bits) == 2) return swap ? Bits(__builtin_bswap16(bits)) : bits;
  if constexpr (sizeof(Bits) == 4) return swap ? Bits(__builtin_bswap32(bits)) : bits;
  if constexpr (sizeof(Bits) == 8) return swap ? Bits(__builtin_bswap64(bits)) : bits;
  return bits;
}

/// Returns an index from a list of floats; negative if the value is no index.
inline std::int64_t to_integer(double x) {
  return std::abs(x) < 9e15 && x == std::floor(x) ? std::int64_t(x) : std::numeric_limits<std::int64_t>::min();
}

inline double decode_real(const std::byte* from, PlyType type, bool swap) {
  switch (type) {
    case PlyType::i8:
      return double(std::int8_t(*from));
    case PlyType::u8:
      return double(std::uint8_t(*from));
    case PlyType::i16:
      return double(std::int16_t(load_bits<std::uint16_t>(from, swap)));
    case PlyType::u16:
      return double(load_bits<std::uint16_t>(from, swap));
    case PlyType::i32:
      return double(std::int32_t(load_bits<std::uint32_t>(from, swap)));
    case PlyType::u32:
      return double(load_bits<std::uint32_t>(from, swap));
    case PlyType::i64:
      return double(std::int64_t(load_bits<std::uint64_t>(from, swap)));
    case PlyType::u64:
      return double(load_bits<std::uint64_t>(from, swap));
    case PlyType::f32:
      return double(std::bit_cast<float>(load_bits<std::uint32_t>(from, swap)));
    case PlyType::f64:
      return std::bit_cast<double>(load_bits<std::uint64_t>(from, swap));
  }
  return 0;
}

inline std::int64_t decode_integer(const std::byte* from, PlyType type, bool swap) {
  switch (type) {
    case PlyType::i32:
      return std::int32_t(load_bits<std::uint32_t>(from, swap));
    case PlyType::u32:
      return load_bits<std::uint32_t>(from, swap);
    case PlyType::i64:
    case PlyType::u64:  // beyond 2^63: negative, which is no index either
      return std::int64_t(load_bits<std::uint64_t>(from, swap));
    default:
      return to_integer(decode_real(from, type, swap));
  }
}

}  // namespace bp
