#pragma once
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lib/check/detail/surface.h"

namespace bp {

/// Points that are known to lie inside the content of a tile. Forgets: a table of 64 KiB in which the newest point
/// stays.
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

/// The content of a tile, which must enclose the part of the scene in its cell.
class TileBody {
 public:
  enum class Side { inside, touching, outside, undecided };

  /// `number`: the tile's, for the table of known points.
  TileBody(const IndexedMesh& content, std::size_t number);

  /// Returns whether the content is a closed, oriented, embedded 2-manifold.
  [[nodiscard]] bool sound() const { return sound_; }
  /// Returns the side of the part of t in the cell; without a cell, of all of t. `bounds`: those of t.
  [[nodiscard]] Side side_of(const TriangleD& t, const Bounds3d& bounds, const std::optional<Bounds3d>& cell,
                             KnownInside& known) const;
  /// Returns whether the part of t that may lie in the cell lies inside in the file, where each of its points may be
  /// off by `scene_off`, and those of the content by as much as its reader says. `is_inside`: the part in the cell is
  /// known to lie inside as read; else t misses the cell as read.
  [[nodiscard]] bool keeps_clear(const TriangleD& t, const std::optional<Bounds3d>& cell, double scene_off,
                                 bool is_inside, KnownInside& known) const;

 private:
  [[nodiscard]] Side side_of_part(const TriangleD& t, const Bounds3d& cell, double growth, KnownInside& known) const;
  [[nodiscard]] Side side_of_corners(std::span<const Vec3d> corners, KnownInside& known) const;
  [[nodiscard]] Side side_near(const Vec3d& p, double radius) const;
  [[nodiscard]] Side side_of_point(const Vec3d& p) const;

  std::size_t number_;
  WeldedMesh mesh_;
  std::optional<Surface> surface_;
  bool closed_ = false, sound_ = false;
  double off_ = 0;  ///< error of the content's points
};

}  // namespace bp
