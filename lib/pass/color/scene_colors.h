#pragma once
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "lib/core/triangle_source.h"
#include "lib/grid/coord_hash.h"
#include "lib/grid/stream.h"
#include "lib/pass/context.h"
#include "lib/store/result_key.h"
#include "lib/voxel/color_sums.h"

/// The colours of a scene's surface for all of its levels of detail (docs/decisions/0008-colours.md). The cells of a
/// level are four of its voxels wide. The finest cells gather the scene's triangles; coarser ones are sums of finer
/// ones.
namespace bp {

/// Colours around a part of a level, in memory: some 100 bytes for each side that a cell has.
class NearbyColors {
 public:
  /// `cells` lie in [min, max). `origin` is that of the cells' frame, in lattice units of their level.
  NearbyColors(std::vector<CellColor> cells, ColorCell min, const Vec3d& origin);

  [[nodiscard]] bool empty() const { return levels_.empty(); }
  /// Returns the colour at a point in lattice units of the level's frame: that of its cell; else of the nearest of the
  /// 26 around it; else likewise among cells twice as large, and so on. White if there is no cell. Surfaces that look
  /// along `normal`, of any length, count, and cells that have some come first, so that at the edge of a roof the walls
  /// do not tint it. If hardly any surface looks that way, in the cell and in those around it, the whole cell counts
  /// for the rest. If the normal is 0, the whole cell counts alone.
  [[nodiscard]] LinearColor at(const Vec3d& lattice, const Vec3d& normal) const;
  void add_to(KeyHash& hash) const;

 private:
  struct Cells {
    std::vector<CellColor> sides;  ///< of a cell, one after the other
    std::unordered_map<ColorCell, std::uint32_t, CoordHash> first;
    explicit Cells(std::vector<CellColor> all);
    [[nodiscard]] Cells halved() const;
    [[nodiscard]] std::span<const CellColor> at(ColorCell cell) const;
  };
  using Shares = std::array<double, kColorSides.size()>;
  [[nodiscard]] static Shares shares_along(const Vec3d& normal);
  [[nodiscard]] static std::span<const CellColor> nearest(const Cells& cells, const Vec3d& p, const Shares& shares);

  ColorCell min_;
  Vec3d origin_;
  std::vector<Cells> levels_;  ///< [n]: 2^n of the level's cells wide, counted from min_
};

class ColorGrid;

class SceneColors {
 public:
  /// `frame`: the cells of `finest` are made of its voxels.
  SceneColors(const GridFrame& frame, std::unique_ptr<ColorGrid> finest);
  ~SceneColors();

  /// Makes the cells of the level with this frame: the finest frame, reduced any number of times (lib/volume/reduce.h).
  /// Must not run while others use this object.
  void prepare(const GridFrame& level);
  /// Returns the colours of the voxels of `box` of a prepared level, and of those within `margin_vox` of them. May be
  /// called on any thread.
  [[nodiscard]] NearbyColors around(const GridFrame& level, const VoxelBox& box, std::int32_t margin_vox) const;
  [[nodiscard]] NearbyColors all(const GridFrame& level) const;
  [[nodiscard]] std::uint64_t cells() const;  ///< number of cells of the finest level

 private:
  [[nodiscard]] std::size_t number_of(const GridFrame& level) const;
  [[nodiscard]] Vec3d origin_in(const GridFrame& level) const;
  GridFrame frame_;
  std::vector<std::unique_ptr<ColorGrid>> levels_;
};

/// Reads `source` once more, from its start, and gathers the colours that `solid`, its voxels in `frame`, shows to the
/// outside. Surfaces deeper than a cell inside do not count. Returns null if all colours are white. The result depends
/// neither on the order of the triangles nor on threads or memory. The memory is for cells in use, the store for cells
/// that wait.
[[nodiscard]] std::unique_ptr<SceneColors> gather_colors(TriangleSource& source, const GridFrame& frame,
                                                         const BrickShelf& solid, const PassContext& context);

}  // namespace bp
