#pragma once
#include <cstdint>
#include <type_traits>

#include "lib/core/coords.h"

namespace bp {

/// Hashes coordinates for hash tables. All 64 bits are mixed, since some of them may choose a shard.
struct CoordHash {
  template <class Space, class Int>
  std::size_t operator()(const Coord3<Space, Int>& c) const {
    using Bits = std::make_unsigned_t<Int>;
    std::uint64_t h = std::uint64_t(Bits(c.x)) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ Bits(c.y)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32) ^ Bits(c.z)) * 0x94d049bb133111ebu;
    return std::size_t(h ^ (h >> 31));
  }
};

}  // namespace bp
