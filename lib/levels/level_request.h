#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/levels/lod_level.h"

/// Which levels of detail are wanted, in numbers and scene units, and the target of each.
namespace bp {

/// A level has no use for more faces than so many times the scene's triangles: they would show the steps of voxels.
constexpr std::uint64_t kFacesPerTriangle = 4;
constexpr std::uint64_t kLeastFirstFaces = 200;  ///< of a finest level that is not asked for

constexpr std::uint64_t kDensePerFace = 100;  ///< triangles of the dense surface for one of a finest level
constexpr std::uint64_t kMostLevels = 32;
constexpr std::uint64_t kLeastFaces = kFacesOfBox;  ///< of a level whose faces are chosen
/// The most faces that are chosen: for a finest level, for time; a collision mesh, for physics; a cage, for hands.
constexpr std::uint64_t kMostDefaultFaces = 10000, kMostCollisionFaces = 5000, kMostCageFaces = 1000;

/// At most one of faces, shares and errors is given: as a list, or as the finest level's number. The numbers of the
/// other levels follow from that one.
struct LevelRequest {
  std::optional<std::uint64_t> levels;    ///< how many; empty: as many as are listed, or 4
  std::vector<std::uint64_t> faces;       ///< finest first
  std::vector<double> shares;             ///< the same, in percent of the scene's triangles
  std::vector<double> errors_world;       ///< largest distance between scene and level; finest first
  std::optional<double> scale_world;      ///< closing radius of the finest level
  std::uint64_t most_faces = UINT64_MAX;  ///< of a finest level without a number of faces
  bool is_chosen = false;  ///< nobody asked for these levels: those that are not worth having are left out
};

[[nodiscard]] std::size_t level_count(const LevelRequest& request);
[[nodiscard]] bool is_explicit(
    const LevelRequest& request);  ///< the number of levels is given, or the levels are listed
[[nodiscard]] bool asks_for_faces(const LevelRequest& request);    ///< as numbers or percentages
[[nodiscard]] bool asks_for_nothing(const LevelRequest& request);  ///< neither faces nor errors

/// How many faces are chosen where the request has none; of levels in one mesh.
struct LevelDefaults {
  double triangles_per_face = 2;  ///< of the scene, for a face of the finest level
  std::uint64_t most_faces = kMostDefaultFaces;
  bool by_voxels = false;  ///< the voxels decide the faces, which are fewer than the scene's triangles
};
/// The request for a scene of `triangles`. Shares become faces. A request for nothing becomes faces: the finest level
/// has one face for `triangles_per_face` triangles (at least 200, or one for each triangle). There are at most 4
/// levels, each with a quarter of the faces before, down to kLeastFaces.
[[nodiscard]] LevelRequest with_defaults(LevelRequest request, std::uint64_t triangles, const LevelDefaults& defaults);

/// The target of level `i`. Level `since` is the first in one mesh: 0, or the first level of a tileset that is not cut.
///   faces   as listed, or F / 4^(i - since). F without a list: a hundredth of `dense_faces`, from 200 to most_faces
///   errors  as listed, or E * 2^i
///   scale   scale_world * 2^i, if given
[[nodiscard]] LodTarget level_target(const LevelRequest& request, std::size_t i, std::size_t since,
                                     std::uint64_t dense_faces);

/// The target of each tile of level `i`, which is cut. Faces as listed, or F; without a list there are none.
[[nodiscard]] LodTarget tile_target(const LevelRequest& request, std::size_t i);

/// Whether a mesh has clearly fewer faces than its budget.
[[nodiscard]] bool clearly_fewer(std::uint64_t faces, std::uint64_t asked);

}  // namespace bp
