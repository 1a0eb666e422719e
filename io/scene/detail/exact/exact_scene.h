#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/scene/affine.h"
#include "lib/core/coords.h"
#include "lib/core/triangle_source.h"

struct aiMesh;
struct aiNode;

/// What Assimp rounds to float32, read once more in double from text formats of everyday use. Assimp says which meshes
/// and nodes there are, and which vertices they have, in which order. A reader here gives the same lists in double.
/// A list is taken only if it has as many entries as Assimp's and none differs by more than float32 explains: whatever
/// Assimp understands in another way stays as it was, with a bound of its rounding.
namespace bp {

/// Positions of one of Assimp's meshes, a corner of a face each, before any node places them.
struct ExactMesh {
  std::string name;  ///< of the mesh; empty: the lists are in the order of the meshes
  std::vector<Vec3d> positions;
  double off = 0;  ///< along each axis, scene units of the mesh
};

struct ExactNode {
  Affine transform;
  /// Terms of the sums that its matrix is made of: of the 3 x 3 numbers, and of the translation. Float32 rounds those.
  double largest = 0, farthest = 0;
  std::vector<ExactNode> children;
};

struct ExactScene {
  std::vector<ExactMesh> meshes;
  std::optional<ExactNode> root;  ///< none: the nodes are not known
  /// The format's nodes are always understood: a node of Assimp's that differs is read in two ways.
  bool knows_nodes = false;
  Unfollowed unfollowed;
  const char* unread = nullptr;  ///< why Assimp must not read the file
};

/// A list that fits the mesh: number `i` of those without names, else one of its name. Null if there is none, or if two
/// that fit differ.
[[nodiscard]] const ExactMesh* exact_mesh(const ExactScene& scene, const aiMesh& mesh, std::size_t i);
/// The transform is that of Assimp's node.
[[nodiscard]] bool is_rounded(const ExactNode& exact, const aiNode& node);

/// Nothing if the text is not what these understand. Linear in time and memory.
[[nodiscard]] std::optional<ExactScene> exact_collada(std::string text);
[[nodiscard]] std::optional<ExactScene> exact_ac3d(const std::string& text);

/// The numbers of a text with blanks between them; ends before a word that is none.
[[nodiscard]] std::vector<double> numbers_in(std::string_view text);

}  // namespace bp
