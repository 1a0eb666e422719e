#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "lib/core/box.h"
#include "tools/cli/length.h"

/// Questions a length or a grid that is out of proportion to the scene before the work begins: most often it is a slip,
/// as 2 for 2%, which would run for hours. A percentage and a number of voxels are not questioned, up to the scene's
/// diagonal.
namespace bp {

constexpr double kLargestShare = 0.25;  ///< share of the scene's diagonal from which a length is refused
constexpr double kNotedShare = 0.1;     ///< share of the scene's diagonal from which a scale is noted
constexpr double kFewestVoxels = 8, kMostVoxels = 16384;  ///< along the scene's longest side

/// Throws bad_argument if `length` is a plain number beyond kLargestShare. The message says what is probably meant, and
/// how to insist. `voxel`: edge in scene units; 0: not known. Does nothing for a scene without a diagonal.
void question_length(const char* option, const Length& length, const Bounds3d& scene, double voxel = 0);

/// As question_length(), for a closing radius. A percentage and a number of voxels are also refused beyond the
/// diagonal: the closing would be a box around the scene, and the work grows with the cube of the radius.
void question_scale(const char* option, const Length& scale, const Bounds3d& scene, double voxel = 0);

/// Returns a note for a plain number between kNotedShare and kLargestShare: which share it is, and what the same number
/// of percent would be; else nothing.
[[nodiscard]] std::string scale_share_note(const std::optional<Length>& scale, const Bounds3d& scene);

/// Throws bad_argument if the resolution is above kMostVoxels.
void question_resolution(std::int64_t resolution, const Bounds3d& scene);

/// Throws bad_argument if `voxel`, a plain number, makes a grid of fewer than kFewestVoxels or more than kMostVoxels.
void question_voxel(const char* option, const Length& voxel, const Bounds3d& scene);

/// Throws bad_argument if voxels of this edge, in scene units, make a grid of more than kMostVoxels. `what`: where the
/// edge comes from: "--error 0.001".
void question_grid(const std::string& what, double voxel, const Bounds3d& scene,
                   const char* likely = "is the scene in other units?");

}  // namespace bp
