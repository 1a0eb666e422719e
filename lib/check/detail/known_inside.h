#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "lib/core/vec3.h"

namespace bp {

/// Points that are known to lie inside of the content of a tile. It forgets: a table of 64 KiB in which the
/// last comer stays.
class KnownInside {
 public:
  [[nodiscard]] bool has(std::size_t tile, const Vec3d& p) const {
    const Entry& entry = entries_[place_of(tile, p)];
    return entry.tile == tile && entry.point == p;
  }
  void add(std::size_t tile, const Vec3d& p) { entries_[place_of(tile, p)] = {tile, p}; }

 private:
  static constexpr std::size_t kNone = std::size_t(-1);
  static constexpr std::size_t kEntries = 2048;
  struct Entry {
    std::size_t tile = kNone;
    Vec3d point{};
  };

  [[nodiscard]] static std::size_t place_of(std::size_t tile, const Vec3d& p) {
    std::uint64_t hash = tile;
    for (const double x : p) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
    return hash >> 53;
  }

  std::vector<Entry> entries_ = std::vector<Entry>(kEntries);
};

}  // namespace bp
