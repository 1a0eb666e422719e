#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "lib/core/box.h"
#include "tools/cli/length.h"

/// A length or a grid out of proportion to the scene is most often a slip: 2 for 2% runs for hours. It is questioned
/// before the work. A percentage and a number of voxels are taken at their word, up to the scene's diagonal.
namespace bp {

constexpr double kLargestShare = 0.25;                    ///< of the scene's diagonal
constexpr double kNotedShare = 0.1;                       ///< of the scene's diagonal
constexpr double kFewestVoxels = 8, kMostVoxels = 16384;  ///< along the scene's longest side

/// Throws bad_argument if `length` is a plain number beyond kLargestShare. The message says what is likely meant, and
/// how to insist. `voxel`: edge in scene units; 0: none is known. Nothing of a scene without a diagonal.
void question_length(const char* option, const Length& length, const Bounds3d& scene, double voxel = 0);

/// The same of a closing radius. A percentage and a number of voxels are refused beyond the diagonal: the closing would
/// be a box around the scene, and the work grows with the cube of the radius.
void question_scale(const char* option, const Length& scale, const Bounds3d& scene, double voxel = 0);

/// A plain number beyond kNotedShare and below that: which share it is, and what the same number of percent would be;
/// else empty.
[[nodiscard]] std::string scale_share_note(const std::optional<Length>& scale, const Bounds3d& scene);

/// Throws bad_argument if there are more than kMostVoxels.
void question_resolution(std::int64_t resolution, const Bounds3d& scene);

/// Throws bad_argument if voxels of the edge `voxel`, a plain number, make a grid beyond kFewestVoxels or kMostVoxels.
void question_voxel(const char* option, const Length& voxel, const Bounds3d& scene);

/// Throws bad_argument if voxels of this edge, in scene units, make a grid of more than kMostVoxels. `what` says where
/// they come from: "--error 0.001".
void question_grid(const std::string& what, double voxel, const Bounds3d& scene,
                   const char* likely = "is the scene in other units?");

}  // namespace bp
