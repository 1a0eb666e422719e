#pragma once
#include <cstdint>

#include "lib/core/coords.h"

namespace bp {

/// Hashes grid coordinates for hash tables. All 64 bits are mixed, since some of them may choose a shard.
struct CoordHash {
  template <class Space>
  std::size_t operator()(const Coord3<Space, std::int32_t>& c) const {
    std::uint64_t h = std::uint64_t(std::uint32_t(c.x)) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ std::uint32_t(c.y)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32) ^ std::uint32_t(c.z)) * 0x94d049bb133111ebu;
    return std::size_t(h ^ (h >> 31));
  }
};

}  // namespace bp
