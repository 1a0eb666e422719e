#pragma once
#include <span>
#include <vector>

#include "lib/pass/leaf/scene_leaf.h"

namespace bp {

/// Memory of with_fewer_triangles(), but for its results, for each triangle of the leaf.
constexpr std::uint64_t kCollapseBytesPerTriangle = 700;

/// The treatment of folds: none, or planes hold those of a right angle and sharper. They hold boxes in shape, and make
/// what has many of them, such as bent pipes, coarser.
enum class LeafFolds { plain, held };

/// Returns the same surface with at most so many triangles, for each number in `most`, which fall. Edges collapse in
/// the order of their quadric errors [GH97], and each corner keeps a look of its own [Hop99]. Borders, and seams where
/// texture coordinates, colours or materials meet, keep their course. Parts and holes stay, so that more triangles may
/// be left than were wanted. The result need not be closed, and may intersect itself. It does not depend on the number
/// of threads. O(n log n); of a point with k faces, O(k)
/// at each collapse there.
[[nodiscard]] std::vector<SceneLeaf> with_fewer_triangles(const SceneLeaf& leaf, std::span<const std::uint64_t> most,
                                                          LeafFolds folds = LeafFolds::plain);

/// A tile with fewer triangles, and what it was made from.
struct FewerTriangles {
  SceneLeaf leaf;
  std::vector<TriangleD> before;  ///< the triangles of the parts that are left, as they were; scene units
  std::vector<TriangleD> gone;    ///< those of the parts that vanished
};

/// Returns a tile with at most so many triangles, as above, but: points on the faces of its box stay, since the tiles
/// beside it have them, too, so that no gap opens between them, whichever tiles are drawn side by side; and parts that
/// end within the box vanish where they are so small that this costs less than what else could go.
[[nodiscard]] FewerTriangles tile_with_fewer_triangles(const SceneLeaf& tile, const Bounds3d& box, std::uint64_t most,
                                                       LeafFolds folds = LeafFolds::held);

}  // namespace bp
