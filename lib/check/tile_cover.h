#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/indexed_mesh.h"
#include "lib/core/triangle_source.h"

/// Do tiles that are cut along cells enclose a scene together? Whichever tiles a viewer draws, as long as each tile
/// gives way to all of its children at once: every point of every triangle then lies strictly inside a tile that is
/// drawn. What is proved, for each triangle t:
///   - t lies in the cell of the root;
///   - for each tile whose cell t meets, t ∩ cell meets no face of the tile's content and lies inside of it;
///   - the cells of a tile's children are octants of its own, or its own again; t meets no octant without a child.
/// A tile without a cell answers for all of space; one without content draws nothing, and must have children.
///
/// Decided exactly or on the safe side: cells are grown by 1e-9 of their edge, and t is cut by them in doubles, whose
/// errors are far smaller; where t meets a face, bounds of the common points (exact predicates say which edges meet
/// which triangle, intervals where) must leave the grown cell. So "holds" is a proof, and a tile is blamed unjustly
/// only if a triangle and a face nearly coincide where the cell ends.
namespace bp {

struct CoverTile {
  std::string place, uri;              ///< for findings
  std::optional<IndexedMesh> content;  ///< scene units; none: nothing is drawn
  std::optional<Bounds3d> cell;        ///< scene units
  std::vector<std::size_t> children;   ///< numbers of tiles
};

/// One finding per line, empty if all holds; tiles[0] is the root. Besides, each content must hold as a mesh
/// (check_proxy). Reads the scene once, from its start. Memory: about 300 bytes per triangle of all contents. Parallel;
/// the result does not depend on threads.
[[nodiscard]] std::vector<std::string> check_cover(const std::vector<CoverTile>& tiles, TriangleSource& scene);

}  // namespace bp
