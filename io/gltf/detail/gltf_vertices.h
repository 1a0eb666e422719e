#pragma once
#include <array>
#include <optional>
#include <vector>

#include "io/gltf/gltf_document.h"
#include "io/scene/affine.h"

namespace bp::detail {

/// The vertices of an accessor in one place, which move together.
struct GltfVertices {
  Accessor position;
  std::optional<Accessor> normal, tangent;
  std::array<std::uint64_t, 3> numbers{};  ///< accessors of POSITION, NORMAL, TANGENT, plus 1; 0: none
  bool is_copy = false;                    ///< the accessors are used in other places, too; this place gets new ones
  Affine to_world, from_world;             ///< from_world: the linear part only
};

/// A primitive that gets the accessors of a copy.
struct GltfEdit {
  std::uint64_t node = 0, mesh = 0, primitive = 0;
  std::size_t vertices = 0;
  bool own_mesh = false;  ///< other nodes use the mesh, too: this node gets its own
};

struct GltfPlan {
  std::vector<GltfVertices> vertices;  ///< in the order in which nodes reach them
  std::vector<GltfEdit> edits;
  /// Memory for a place, bytes: a copy of the vertices, the record of known places, and an edit.
  static constexpr std::uint64_t kPlaceBytes = 2 * sizeof(GltfVertices) + 250 + sizeof(GltfEdit);
  /// Returns the memory in bytes, also while the plan is made and used.
  [[nodiscard]] std::uint64_t memory_bytes() const;
};

/// Returns a plan with all vertices that the nodes of the document show. Throws bad_input if some cannot move,
/// out_of_resource if the plan takes more than options.document. `name`: the file's.
[[nodiscard]] GltfPlan plan_of_vertices(GltfDocument& doc, const std::string& name, const SceneOptions& options);

}  // namespace bp::detail
