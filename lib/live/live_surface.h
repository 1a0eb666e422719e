#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

#include "lib/live/surface_piece.h"

/// The surface of voxels that change, to look at. Its pieces are made when they are asked for, and never kept: so a
/// surface takes no memory but that of its voxels, which wait on a shelf.
namespace bp {

class LiveSurface {
 public:
  /// The number of faces up to which voxels are drawn as they are. A page draws twice as many triangles.
  static constexpr std::uint64_t kMostFaces = 3'000'000;

  /// The pieces that changed. It holds their voxels while it lives, also if others are shown meanwhile.
  struct Change {
    std::uint64_t generation = 0;
    bool whole = false;  ///< these are all pieces; those from before are gone
    GridFrame frame;     ///< of the voxels that are drawn
    std::shared_ptr<const BrickShelf> voxels;
    std::shared_ptr<const ScaleField> scale;
    std::vector<BrickCoord> bricks;  ///< whose pieces changed, sorted; pieces that became empty are among them
    [[nodiscard]] SurfacePiece piece(BrickCoord brick) const;
  };

  /// `most_faces`: of more faces than about that, coarser voxels are drawn, which hold these ones.
  LiveSurface(ShelfFactory make_shelf, std::uint64_t most_faces);

  /// Shows other voxels. Returns their number. One call at a time.
  std::uint64_t show(const GridFrame& frame, std::shared_ptr<const BrickShelf> voxels, const ScaleField& scale);
  /// Returns a number that rises when pieces change; 0: nothing is shown.
  [[nodiscard]] std::uint64_t generation() const;
  /// Returns the edge of the voxels that are drawn, scene units; 0: nothing is shown.
  [[nodiscard]] double drawn_voxel() const;
  /// Returns the pieces that changed after a generation.
  [[nodiscard]] Change since(std::uint64_t generation) const;

 private:
  struct Shown {
    GridFrame frame;
    std::shared_ptr<const BrickShelf> voxels;  ///< null: nothing is shown
    std::shared_ptr<const ScaleField> scale;
  };
  /// Replaces voxels with more than so many faces by coarser ones. Returns the number of voxels before.
  std::uint64_t make_drawable(Shown& next) const;
  [[nodiscard]] std::set<BrickCoord> changed_voxels(const Shown& next) const;
  void add_changed_scales(const Shown& next, std::set<BrickCoord>& changed) const;

  const ShelfFactory make_shelf_;
  const std::uint64_t most_faces_;
  mutable std::mutex mutex_;
  Shown shown_;
  std::uint64_t generation_ = 0;
  std::uint64_t whole_since_ = 1;  ///< generation of the first surface in the present frame
  /// Generation in which a piece changed last, for bricks that have a piece, or had one.
  std::map<BrickCoord, std::uint64_t> changed_in_;
};

}  // namespace bp
