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

/// The colours of a scene's surface for all of its levels of detail (docs/decisions/0008-colours.md). Cells of a level
/// are four of its voxels wide; those of the finest gather the scene's triangles, coarser ones are their sums.
namespace bp {

/// Colours around a part of a level, in memory: some 100 bytes for each side that a cell has.
class NearbyColors {
 public:
  /// `cells` in [min, max); `origin`: of the cells' frame, in lattice units of the level they belong to.
  NearbyColors(std::vector<CellColor> cells, ColorCell min, const Vec3d& origin);

  [[nodiscard]] bool empty() const { return levels_.empty(); }
  /// At a point in lattice units of the level's frame: of the cell it lies in; else of the nearest of the 26 around it;
  /// else the same among cells twice as large, and so on. White if there is no cell. What looks along `normal`, of any
  /// length, counts, and cells that have it come first: at the edge of a roof the walls do not tint it. Where hardly
  /// anything looks that way, in a cell and in those around it, all of the cell counts, the more the less does; all of
  /// it alone if the normal is 0.
  [[nodiscard]] LinearColor at(const Vec3d& lattice, const Vec3d& normal) const;
  void add_to(KeyHash& hash) const;

 private:
  struct Cells {
    std::vector<CellColor> sides;  ///< of a cell together
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
  /// `frame`: whose voxels the cells of `finest` are made of.
  SceneColors(const GridFrame& frame, std::unique_ptr<ColorGrid> finest);
  ~SceneColors();

  /// Makes the cells of the level with this frame: that of the finest, reduced any number of times
  /// (lib/volume/reduce.h). Not while others are at work here.
  void prepare(const GridFrame& level);
  /// Colours of the voxels of `box` of a level that was prepared, and of those within `margin_vox` of them. On any
  /// thread.
  [[nodiscard]] NearbyColors around(const GridFrame& level, const VoxelBox& box, std::int32_t margin_vox) const;
  [[nodiscard]] NearbyColors all(const GridFrame& level) const;
  [[nodiscard]] std::uint64_t cells() const;  ///< of the finest level

 private:
  [[nodiscard]] std::size_t number_of(const GridFrame& level) const;
  [[nodiscard]] Vec3d origin_in(const GridFrame& level) const;
  GridFrame frame_;
  std::vector<std::unique_ptr<ColorGrid>> levels_;
};

/// Reads `source` once more, from its start, for the colours of what `solid`, its voxels in `frame`, shows to the
/// outside: what lies deeper than a cell inside does not count. Null if all of that is white. The result depends
/// neither on the order of the triangles nor on threads or memory. The memory is for cells at
/// work, the store for those that wait.
[[nodiscard]] std::unique_ptr<SceneColors> gather_colors(TriangleSource& source, const GridFrame& frame,
                                                         const BrickShelf& solid, const PassContext& context);

}  // namespace bp
