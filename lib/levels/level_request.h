#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/levels/lod_target.h"
#include "lib/simplify/shape_limits.h"

/// The levels of detail that are wanted, as numbers and scene units, and the target of each.
namespace bp {

/// A level has at most this many faces for each triangle of the scene: more would only show the steps of the voxels.
constexpr std::uint64_t kFacesPerTriangle = 4;
constexpr std::uint64_t kLeastFirstFaces = 200;  ///< the least faces of a finest level whose budget is not given

constexpr std::uint64_t kDefaultLevels = 4, kMostLevels = 32;
constexpr std::uint64_t kLeastFaces = kFacesOfBox;  ///< the least faces of a level whose budget is not given
/// The most faces that are chosen without a budget: of a finest level, to save time; of a collision mesh, for physics
/// engines; of a cage, since people edit it.
constexpr std::uint64_t kMostDefaultFaces = 10000, kMostCollisionFaces = 5000, kMostCageFaces = 1000;

/// The levels that the user asked for. At most one of faces, shares and errors is given. It has a number for each
/// level, or one number for the finest level; those of the other levels follow from it.
struct LevelRequest {
  std::optional<std::uint64_t> levels;    ///< number of levels; empty: the length of the list, or 4
  std::vector<std::uint64_t> faces;       ///< finest first
  std::vector<double> shares;             ///< faces in percent of the scene's triangles
  std::vector<double> errors_world;       ///< largest distance between scene and level; finest first
  std::optional<double> scale_world;      ///< closing radius of the finest level
  std::uint64_t most_faces = UINT64_MAX;  ///< the most faces of a finest level without a budget
  bool is_chosen = false;                 ///< nobody asked for these levels, so that needless ones may be left out
};

[[nodiscard]] std::size_t level_count(const LevelRequest& request);
[[nodiscard]] bool is_explicit(const LevelRequest& request);     ///< the number of levels is given, or they are listed
[[nodiscard]] bool asks_for_faces(const LevelRequest& request);  ///< as numbers or as percentages
[[nodiscard]] bool asks_for_nothing(const LevelRequest& request);  ///< neither faces nor errors

/// How the faces are chosen that a request does not give, for levels that are one mesh.
struct LevelDefaults {
  double triangles_per_face = 2;  ///< triangles of the scene for each face of the finest level
  std::uint64_t most_faces = kMostDefaultFaces;
  /// The least faces of the finest level if the scene has fewer triangles: a proxy around few triangles that overlap
  /// needs more faces than they are.
  std::uint64_t least_faces = kLeastFaces;
  bool by_voxels = false;  ///< the budget is derived from the voxels, and has fewer faces than the scene has triangles
};
/// Completes the request for a scene of `triangles`. Shares become faces. If nothing is asked for, the finest level
/// gets one face for `triangles_per_face` triangles. It gets at least 200, or in a scene of fewer triangles one face
/// for each of them, and at least `least_faces`. There are at most 4 levels, each with a quarter of the faces before,
/// down to kLeastFaces.
[[nodiscard]] LevelRequest with_defaults(LevelRequest request, std::uint64_t triangles, const LevelDefaults& defaults);

/// Returns the target of level `i`. Level `since` is the first one that is one mesh: 0, or in a tileset the first level
/// that is not cut.
///   faces   the listed number, or F / 4^(i - since). F is the finest level's number; without one, a hundredth of
///   `dense_faces`, between 200 and most_faces
///   errors  the listed number, or E * 2^i
///   scale   scale_world * 2^i, if it is given
[[nodiscard]] LodTarget level_target(const LevelRequest& request, std::size_t i, std::size_t since,
                                     std::uint64_t dense_faces);

/// Returns the target of each tile of a cut level `i`. Its faces are the listed number or F; 0 without a list.
[[nodiscard]] LodTarget tile_target(const LevelRequest& request, std::size_t i);

/// Returns whether a mesh has clearly fewer faces than its budget: at least 2 and 5 % fewer.
[[nodiscard]] bool clearly_fewer(std::uint64_t faces, std::uint64_t asked);

}  // namespace bp
