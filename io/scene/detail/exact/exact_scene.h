#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/scene/affine.h"
#include "lib/core/coords.h"
#include "lib/core/triangle_source.h"

struct aiMesh;
struct aiNode;

/// Numbers that Assimp rounds to float32, read once more in double from common text formats. Assimp tells which meshes
/// and nodes there are, and which vertices they have, in which order. A reader here gives the same lists in double. A
/// list is used only if it has as many entries as Assimp's and none differs by more than float32 explains: parts that
/// Assimp reads in another way stay as they were, with a bound on their rounding.
namespace bp {

/// The positions of one of Assimp's meshes, one for each corner of a face, before nodes place them.
struct ExactMesh {
  std::string name;  ///< name of the mesh; empty: the lists are in the order of the meshes
  std::vector<Vec3d> positions;
  double off = 0;  ///< bound on the error along each axis, scene units of the mesh
};

struct ExactNode {
  Affine transform;
  /// The largest terms of the sums that its matrix is made of: those of the 3 x 3 numbers, and of the translation.
  /// Float32 rounds them.
  double largest = 0, farthest = 0;
  std::vector<ExactNode> children;
};

struct ExactScene {
  std::vector<ExactMesh> meshes;
  std::optional<ExactNode> root;  ///< none: the nodes are not known
  /// The whole file is understood: a mesh or a node of Assimp's that differs is read in two ways.
  bool is_known = false;
  Unfollowed unfollowed;
  const char* unread = nullptr;  ///< why Assimp must not read the file
};

/// Returns a list that fits the mesh: number `i` if lists have no names, else one of its name. Null if none fits, or if
/// two that fit differ.
[[nodiscard]] const ExactMesh* exact_mesh(const ExactScene& scene, const aiMesh& mesh, std::size_t i);
/// Returns whether Assimp's node has this transform, apart from rounding.
[[nodiscard]] bool is_rounded(const ExactNode& exact, const aiNode& node);

/// These read a text. Parts that they do not understand are counted in `unfollowed`. Linear in time and memory.
[[nodiscard]] ExactScene exact_collada(std::string text);
[[nodiscard]] ExactScene exact_ac3d(const std::string& text);

/// Counts what Assimp does not follow in a DXF, and gives no lists.
[[nodiscard]] ExactScene exact_dxf(std::string_view text);

/// Returns the numbers of a text with blanks between them. Nothing if the text holds anything else.
[[nodiscard]] std::optional<std::vector<double>> only_numbers_in(std::string_view text);

}  // namespace bp
