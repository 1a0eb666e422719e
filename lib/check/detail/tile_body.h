#pragma once
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lib/check/detail/surface.h"

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

/// The content of a tile that encloses what of the scene lies in its cell.
class TileBody {
 public:
  enum class Side { inside, touching, outside, undecided };

  /// `number`: of the tile, for what is known of it.
  TileBody(const IndexedMesh& content, std::size_t number);

  /// A closed, oriented, embedded 2-manifold.
  [[nodiscard]] bool sound() const { return sound_; }
  /// Where t lies, of which only what is in the cell counts; in no cell: all of t. `bounds`: of t.
  [[nodiscard]] Side side_of(const TriangleD& t, const Bounds3d& bounds, const std::optional<Bounds3d>& cell,
                             KnownInside& known) const;
  /// Of a triangle that lies inside: what is in the cell does so, too, in the file, where each of its points may be off
  /// by `scene_off`, and the content's by as much as its reader says.
  [[nodiscard]] bool keeps_clear(const TriangleD& t, const std::optional<Bounds3d>& cell, double scene_off) const;

 private:
  [[nodiscard]] Side side_of_part(const TriangleD& t, const Bounds3d& cell, double growth, KnownInside& known) const;
  [[nodiscard]] Side side_of_corners(std::span<const Vec3d> corners, KnownInside& known) const;
  [[nodiscard]] Side side_near(const Vec3d& p, double radius) const;
  [[nodiscard]] Side side_of_point(const Vec3d& p) const;

  std::size_t number_;
  WeldedMesh mesh_;
  std::optional<Surface> surface_;
  bool closed_ = false, sound_ = false;
  double off_ = 0;  ///< of the content
};

}  // namespace bp
