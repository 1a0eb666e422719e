#pragma once
#include <map>
#include <optional>
#include <string>

#include "io/scene/affine.h"

struct aiMesh;
struct aiNode;

/// Meshes that bones or morph targets move. They are delivered as their nodes place them, so nothing may be proven of
/// one that is drawn elsewhere.
namespace bp {

/// Where the nodes of a scene stand that may be bones.
class BonePlaces {
 public:
  /// `place`: of the node in the scene. A name that several nodes have stands for none.
  void add(const aiNode& node, const Affine& place);
  /// True if a mesh that its node places with `mesh_place` is drawn there: no bone moves it by more than a 4096th.
  /// Widens the bounds of `mesh_place` by what the bones do, and by weights whose sum is not quite 1.
  [[nodiscard]] bool hold(const aiMesh& mesh, Affine& mesh_place) const;

 private:
  std::map<std::string, std::optional<Affine>> places_;
};

/// True if a morph target of the mesh has other positions, and a weight. Some importers know no weights, and say 1.
[[nodiscard]] bool is_morphed(const aiMesh& mesh);

/// As Assimp has rounded it. A matrix that only swaps and turns axes is exact. The zeros of others may be sines and
/// cosines that were rounded.
[[nodiscard]] Affine rounded_affine(const aiNode& node);

/// Assimp keeps coordinates and matrices as float32, and its importers compute in it: sixteen roundings are allowed for
/// each number. None of them is known to take more.
inline constexpr double kImporterShare = 16 * 0x1p-24;

}  // namespace bp
