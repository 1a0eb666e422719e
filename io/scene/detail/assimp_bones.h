#pragma once
#include <map>
#include <optional>
#include <string>

#include "io/scene/affine.h"

struct aiMesh;
struct aiNode;

/// Meshes that bones or morph targets move. They are delivered where their nodes place them, so nothing may be proven
/// of a mesh that is drawn elsewhere.
namespace bp {

/// The places of a scene's nodes that may be bones.
class BonePlaces {
 public:
  /// `place`: the node's place in the scene. A name that several nodes have is not used.
  void add(const aiNode& node, const Affine& place);
  /// Returns true if a mesh that its node places with `mesh_place` is drawn there: no bone moves it by more than a
  /// 4096th. Widens the bounds of `mesh_place` by the bones' differences, and by weights whose sum is not quite 1.
  [[nodiscard]] bool hold(const aiMesh& mesh, Affine& mesh_place) const;

 private:
  std::map<std::string, std::optional<Affine>> places_;
};

/// Returns true if a morph target of the mesh has other positions, and a weight. Some importers know no weights, and
/// report 1.
[[nodiscard]] bool is_morphed(const aiMesh& mesh);

/// Returns a node's transform with bounds on Assimp's rounding. A matrix that only swaps and turns axes is exact. Zeros
/// of other matrices may be rounded sines and cosines.
[[nodiscard]] Affine rounded_affine(const aiNode& node);

/// The relative error allowed for each of Assimp's numbers. Assimp keeps coordinates and matrices as float32, and its
/// importers compute in it: sixteen roundings. No importer is known to need more.
inline constexpr double kImporterShare = 16 * 0x1p-24;

}  // namespace bp
