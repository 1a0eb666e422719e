#pragma once
#include <array>
#include <optional>
#include <vector>

#include "io/gltf/gltf_document.h"
#include "io/scene/affine.h"

namespace bp::detail {

/// Vertices that move together: those of an accessor, in one place.
struct GltfVertices {
  Accessor position;
  std::optional<Accessor> normal, tangent;
  std::array<std::uint64_t, 3> numbers{};  ///< of these accessors, plus 1; 0: none
  bool is_copy = false;                    ///< the accessors also stand elsewhere, and those of this place are new ones
  Affine to_world, from_world;             ///< the latter: the linear part alone
};

/// A primitive that gets the accessors of a copy.
struct GltfEdit {
  std::uint64_t node = 0, mesh = 0, primitive = 0;
  std::size_t vertices = 0;
  bool own_mesh = false;  ///< the mesh stands in other nodes, too: this node gets its own
};

struct GltfPlan {
  std::vector<GltfVertices> vertices;  ///< in the order in which nodes reach them
  std::vector<GltfEdit> edits;
  /// Bytes of memory for a place: a copy of the vertices, what tells known places, and an edit.
  static constexpr std::uint64_t kPlaceBytes = 2 * sizeof(GltfVertices) + 250 + sizeof(GltfEdit);
  /// Of memory, also while it is made and used.
  [[nodiscard]] std::uint64_t memory_bytes() const;
};

/// All vertices that the nodes of the document show. Throws bad_input if some cannot move, out_of_resource if the plan
/// takes more than options.document. `name`: of the file.
[[nodiscard]] GltfPlan plan_of_vertices(GltfDocument& doc, const std::string& name, const SceneOptions& options);

}  // namespace bp::detail
