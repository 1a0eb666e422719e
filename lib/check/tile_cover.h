#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/check/cover_tile.h"
#include "lib/check/tile_finding.h"
#include "lib/check/tile_part.h"
#include "lib/core/box.h"
#include "lib/core/indexed_mesh.h"
#include "lib/core/triangle_source.h"

/// Decides whether tiles that are cut along cells together enclose a scene: every point of every triangle lies strictly
/// inside a drawn tile, for every choice of tiles by a viewer in which each tile gives way to all of its children at
/// once. Proved, for each triangle t:
///   - t lies in the cell of the root;
///   - for each tile whose cell t meets, t ∩ cell meets no face of the tile's content and lies inside of it;
///   - the cells of a tile's children are octants of its own, or its own again; t meets no octant without a child,
///     unless all tiles below are leaves and a leaf without triangles would suffice for t there.
/// A tile without a cell answers for all of space; one without content draws nothing, and must have children. Below a
/// tile that is refined by adding (tiles_held_above()) children may be missing.
///
/// A leaf encloses nothing: it is the scene itself in its cell. Each of its triangles must lie within `leaf_error` of a
/// t ∩ cell and face as t does. Each t ∩ cell must be covered by such triangles, so that its points lie within 3 errors
/// of them; if it is thinner than six errors, only its corners must lie within 3 errors of the leaf, or of one face of
/// the cell (CoverReport::thin, detail/leaf_proof.h). A part that rounding flattens may be missing: its corners lie on
/// a line once each moves by the error, or by 2^-22 of the longest edge of the scene's box if that is less
/// (CoverReport::flat). The comparison is in doubles, whose rounding is added to the error. The sum must not exceed
/// 2^-18 of that edge, and the rounding of the scene's coordinates; a leaf with a larger one is refused, and not
/// compared. Repeated triangles are not compared. The caller that fills a CoverTile must make sure that a leaf is one
/// (leaf_fault()).
///
/// All decisions are exact or on the safe side. Cells are grown by 1e-9 of their edge, or by 2^-46 of the largest
/// coordinate if that is more, and t is cut by them in doubles, whose errors are far smaller. Where t meets a face,
/// bounds of the common segment (exact predicates tell which edges meet which triangle, intervals tell where) must miss
/// the grown cell. So "holds" is a proof, and a tile is blamed unjustly only if a triangle and a face nearly coincide
/// where the cell ends.
///
/// If the coordinates of the scene or of a content were rounded when they were read (lib/core/triangle_source.h), what
/// lies within the error of a cell may lie in it. The cell is grown by that error, and t in it must keep clear of the
/// content's faces by the sum of both errors. If it does not, the answer is "not decided". A leaf is compared with the
/// scene as read.
///
/// Each statement is about one tile: the scene in its cell, its content, the cells of its children, and whether
/// children have contents. The statement that t lies in the root's cell is about the root. So a check may be done in
/// parts (tile_part.h), each of which sees all tiles and the whole scene: the findings of the parts together are those
/// of one check, and no pair of tiles falls between two parts.
namespace bp {

/// Reads the content of a tile that has one, scene units. Called on several threads.
using CoverContents = std::function<IndexedMesh(std::size_t tile)>;

constexpr std::uint64_t kCoverBytesPerTriangle = 300;  ///< memory for a content while it is tested

struct CoverReport {
  std::vector<TileFinding> findings;
  double leaf_error = 0;   ///< the largest error that leaves were compared with, rounding included; scene units
  std::uint64_t thin = 0;  ///< parts thinner than six errors of which only the corners were compared
  std::uint64_t flat = 0;  ///< parts that rounding flattens and the leaf does not have
};

/// Checks a tileset; tiles[0] is the root. Returns no findings if all holds. With `part`, it returns the findings about
/// the tiles of that part; about other tiles it asks only whether they have a content. Each content except those of
/// leaves must also be a closed, oriented, embedded 2-manifold. Contents are loaded once, in the order of the tiles, in
/// shares that fit memory_bytes, at least one content each. The scene is read once at first, and once for each share.
/// Parallel; the result depends neither on threads nor on memory. Passes on exceptions of the contents and the scene.
[[nodiscard]] CoverReport check_cover(const std::vector<CoverTile>& tiles, const CoverContents& content_of,
                                      TriangleSource& scene, std::uint64_t memory_bytes = std::uint64_t(1) << 30,
                                      TilePart part = {});

}  // namespace bp
