#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/core/coords.h"

namespace bp {

/// The content of a mesh file in addition to its triangles. Fields are empty if the file does not tell, or cannot be
/// understood.
struct MeshExtras {
  /// A line for each step, as bpmesh wrote it: comments of PLY and OBJ, extras of glTF.
  std::vector<std::string> provenance;
  std::optional<Vec3d> origin;    ///< the point that --origin subtracted from its vertices
  std::string contract;           ///< name of the contract that it claims (docs/contracts.md); empty: none
  std::optional<std::string> up;  ///< glTF: asset.extras.up; as JSON if it is no text
  bool recorded = false;          ///< there is a provenance, as in files of this suite
  /// glTF: largest error of a coordinate, in scene units, in a program that applies the translations and scales of
  /// nodes in 32-bit floats. 0: none, or not known, since nodes turn or have children.
  double rounding = 0;
  bool tile = false;              ///< the file is the content of a tile, whose transform puts it into its place
  std::size_t levels = 1;         ///< levels of detail; MSFT_lod of glTF
  bool hulls = false;             ///< nodes of the glTF are named UCX_*, as convex hulls for Unreal
  std::size_t animations = 0;     ///< glTF only
  std::size_t morph_targets = 0;  ///< glTF: the largest number of a mesh
  std::size_t skins = 0;          ///< glTF only
  std::size_t joints = 0;         ///< glTF: the largest number of a skin
};
[[nodiscard]] MeshExtras mesh_extras(const std::string& path);

/// Returns the hash of the scene's triangles in the first step of the provenance, as VoxelizeCounts::input_hash; empty
/// if it is missing.
[[nodiscard]] std::string hash_of_scene(const MeshExtras& extras);
/// Returns the tool that made the mesh, bpmesh or bplod; empty if it was another, or is not known.
[[nodiscard]] std::string made_by(const MeshExtras& extras);
/// Returns its --mode, as the option is written; empty if it is not known.
[[nodiscard]] std::string mode_of(const MeshExtras& extras);

}  // namespace bp
