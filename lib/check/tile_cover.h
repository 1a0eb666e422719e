#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/check/tile_finding.h"
#include "lib/check/tile_part.h"
#include "lib/core/box.h"
#include "lib/core/indexed_mesh.h"
#include "lib/core/triangle_source.h"

/// Do tiles that are cut along cells enclose a scene together? Whichever tiles a viewer draws, as long as each tile
/// gives way to all of its children at once: every point of every triangle then lies strictly inside a tile that is
/// drawn. What is proved, for each triangle t:
///   - t lies in the cell of the root;
///   - for each tile whose cell t meets, t ∩ cell meets no face of the tile's content and lies inside of it;
///   - the cells of a tile's children are octants of its own, or its own again; t meets no octant without a child,
///     unless all below are leaves, and t has next to nothing there: what a leaf without triangles would be, too.
/// A tile without a cell answers for all of space; one without content draws nothing, and must have children. Below a
/// tile that is added to (tiles_held_above()) there need be no children.
///
/// A leaf encloses nothing: it is the scene itself in its cell. Each of its triangles must lie within `leaf_error` of a
/// t ∩ cell and face as t does. Each t ∩ cell must be covered by such triangles, so that its points lie within 3 errors
/// of them; of what is thinner than six errors only the corners must lie within 3 errors of the leaf, or of one face of
/// the cell (CoverReport::thin, detail/leaf_proof.h). What rounding flattens may be missing: its corners lie on a line
/// once each moves by the error, or by 2^-22 of the longest edge of the scene's box if that is less
/// (CoverReport::flat). In doubles, whose rounding is added to the error. The sum must not exceed 2^-18 of that edge,
/// and the rounding of the scene's coordinates; a leaf with a larger one is refused, and not compared. Repeats are not
/// compared. Whoever fills a CoverTile answers for it that a leaf is one (leaf_fault()).
///
/// Decided exactly or on the safe side: cells are grown by 1e-9 of their edge, or 2^-46 of the largest coordinate where
/// that is more, and t is cut by them in doubles, whose errors are far smaller; where t meets a face, bounds of the
/// common segment (exact predicates say which edges meet which triangle, intervals where) must miss the grown cell. So
/// "holds" is a proof, and a tile is blamed unjustly only if a triangle and a face nearly coincide where the cell ends.
///
/// Where the scene's coordinates or those of a content were rounded when they were read (lib/core/triangle_source.h), t
/// ∩ cell keeps clear of the content's faces by as much as both may be off; else, or where that is more than half of
/// what cells are grown by, the answer is "not decided". A leaf is compared with the scene as read.
///
/// Each statement is about one tile: the scene in its cell, its content, the cells of its children, and whether
/// children have contents. That t leaves the root's cell is a statement about the root. So a check may be done in parts
/// (tile_part.h), each of which sees all tiles and the whole scene: the findings of the parts together are those of one
/// check, and no pair of tiles falls between two parts.
namespace bp {

struct CoverTile {
  std::string place, uri;                  ///< for findings
  std::optional<std::uint64_t> triangles;  ///< of its content; none: nothing is drawn
  std::optional<Bounds3d> cell;            ///< scene units
  std::vector<std::size_t> children;       ///< numbers of tiles; they follow their parents
  std::optional<double> leaf_error = {};   ///< a leaf: so far from the scene at most
  double error = 0;                        ///< geometricError, scene units
  bool adds = false;                       ///< refined by adding: its content stays beside those below
  bool is_joint = false;                   ///< no tile of the file: an octant that stands between two of them
};
/// Reads the content of a tile that has one, scene units. Called on several threads.
using CoverContents = std::function<IndexedMesh(std::size_t tile)>;

constexpr std::uint64_t kCoverBytesPerTriangle = 300;  ///< of a content, while it is looked at

struct CoverReport {
  std::vector<TileFinding> findings;
  double leaf_error = 0;   ///< the largest that leaves were compared with, rounding included; scene units
  std::uint64_t thin = 0;  ///< parts thinner than six errors of which only the corners were found
  std::uint64_t flat = 0;  ///< parts that rounding flattens and the leaf does not show
};

/// No findings if all holds; tiles[0] is the root. Of a part, the findings about its tiles; of the content of others it
/// counts only whether they have one. Besides, each content must hold as a mesh
/// (check_proxy). Contents are read once, as many at a time, in the order of their numbers, as fit memory_bytes (one at
/// least); for each such share of them the scene is read once, from its start, and once before.
/// Parallel; the result depends neither on threads nor on memory. Passes on what the contents and the scene throw.
[[nodiscard]] CoverReport check_cover(const std::vector<CoverTile>& tiles, const CoverContents& content_of,
                                      TriangleSource& scene, std::uint64_t memory_bytes = std::uint64_t(1) << 30,
                                      TilePart part = {});

}  // namespace bp
