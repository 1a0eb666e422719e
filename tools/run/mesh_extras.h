#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/core/coords.h"

namespace bp {

/// What a file says beside its triangles; nothing if there is none, or if it cannot be understood.
struct MeshExtras {
  std::vector<std::string> provenance;  ///< a line each step, as bpmesh wrote: comments of PLY and OBJ, extras of glTF
  std::optional<Vec3d> origin;          ///< that --origin subtracted from its vertices
  std::string contract;                 ///< the name of what it claims (docs/contracts.md); empty: nothing
  std::optional<std::string> up;        ///< of glTF: asset.extras.up; what is no text, as JSON
  bool recorded = false;                ///< of glTF: asset.extras.provenance is there, as files of this suite have it
  /// Of glTF: how far a coordinate is off, at most, when a program applies the translations and scales of nodes in
  /// 32-bit floats; scene units. 0: not at all, or not known, since nodes turn or have children.
  double rounding = 0;
  bool tile = false;              ///< the content of a tile, which its transform puts into its place
  std::size_t levels = 1;         ///< of detail; MSFT_lod of glTF
  bool hulls = false;             ///< nodes of glTF are named UCX_*, as convex hulls for Unreal
  std::size_t animations = 0;     ///< of glTF
  std::size_t morph_targets = 0;  ///< of glTF: the most that a mesh has
  std::size_t skins = 0;          ///< of glTF
  std::size_t joints = 0;         ///< of glTF: the most that a skin has
};
[[nodiscard]] MeshExtras mesh_extras(const std::string& path);

/// The hash that its first step says of the scene's triangles, as VoxelizeCounts::input_hash; empty: it does not say.
[[nodiscard]] std::string hash_of_scene(const MeshExtras& extras);
/// The tool that made the mesh, bpmesh or bplod; empty: another, or it does not say.
[[nodiscard]] std::string made_by(const MeshExtras& extras);
/// Its --mode, as the option is written; empty: it does not say.
[[nodiscard]] std::string mode_of(const MeshExtras& extras);

}  // namespace bp
