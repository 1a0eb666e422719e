#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/levels/lod_stage.h"
#include "tools/cli/length.h"

/// The levels that a command line asks for.
namespace bp {

constexpr std::uint64_t kDensePerFace = 100;       ///< triangles of the dense surface for one of a finest level
constexpr std::uint64_t kDensePerFaceAsked = 190;  ///< the same where --faces chooses the voxels
constexpr std::uint64_t kMostLevels = 32;
constexpr std::uint64_t kLeastFaces = kFacesOfBox;  ///< that nobody asked for
/// Faces of a finest level, or of a collision mesh, that nobody asked for, at most: for time, and for physics.
constexpr std::uint64_t kMostDefaultFaces = 40000, kMostCollisionFaces = 5000;

/// One of faces, shares, errors and pixels may be given; each as a list, or as the finest level's number, from which
/// the others follow.
struct LodRequest {
  std::optional<std::uint64_t> levels;
  std::vector<std::uint64_t> faces;
  std::vector<double> shares;  ///< faces, as percentages of the scene's triangles
  std::vector<Length> errors;
  std::vector<double> pixels;
  std::optional<Length> scale;
  std::uint64_t most_faces = UINT64_MAX;  ///< of a finest level that nobody named faces for
};

/// Comma-separated lists. Throw bad_argument if a number is none, is zero, or if the list does not fall (errors: rise).
[[nodiscard]] std::vector<Length> parse_errors(const std::string& text);
[[nodiscard]] std::vector<double> parse_pixels(const std::string& text);

/// Throws bad_argument if the request contradicts itself.
void check(const LodRequest& request);
[[nodiscard]] std::size_t level_count(const LodRequest& request);
[[nodiscard]] bool is_explicit(const LodRequest& request);       ///< the number of levels was asked for, or listed
[[nodiscard]] bool asks_for_faces(const LodRequest& request);    ///< as numbers or percentages
[[nodiscard]] bool asks_for_nothing(const LodRequest& request);  ///< neither faces nor an error nor pixels

/// What nobody asked for of levels in one mesh.
struct LodDefaults {
  double triangles_per_face = 2;  ///< of the scene, for a face of the finest level
  std::uint64_t most_faces = kMostDefaultFaces;
  bool by_voxels = false;  ///< the voxels were named: they decide the faces, which are fewer than the scene's triangles
};
/// The request, for a scene of so many triangles. Percentages become faces; so does nothing at all: the finest level
/// has a share of the triangles, or as many where there are but 200, and there are at most 4 levels, each with a
/// quarter of the faces before, down to kLeastFaces.
[[nodiscard]] LodRequest request_for(LodRequest request, std::uint64_t triangles, const LodDefaults& defaults);

/// Error of the finest level in scene units; 0 if the request is for faces.
[[nodiscard]] double finest_error(const LodRequest& request, double diagonal);

/// Of level `i`, of which `since` (0, or where the levels of a tileset need not be cut any more) is the first in one
/// mesh:
///   faces   as listed, or F / 4^(i - since); F without any list: a hundredth of the dense surface's triangles, at
///           least 200, at most most_faces
///   errors  as listed, or E * 2^i
///   pixels  the scene's diagonal spans at most P pixels when the level is drawn, and its error at most one of them:
///           error = diagonal / P, with P as listed, or P / 2^i
///   scale   --scale * 2^i, if given
[[nodiscard]] LodTarget target_of(const LodRequest& request, std::size_t i, std::size_t since, double diagonal,
                                  double voxel, std::uint64_t dense_faces);

/// Of each tile of level `i`, which is cut: faces as listed, or F; none without any list.
[[nodiscard]] LodTarget tile_target_of(const LodRequest& request, std::size_t i, double diagonal, double voxel);

}  // namespace bp
