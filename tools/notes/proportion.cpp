#include "tools/notes/proportion.h"

#include <cmath>

#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns a number with three significant digits; from 1000 to 10^15 it is rounded to a whole number, without an
/// exponent. Three digits of 999.5 would be those of 1000.
std::string number(double x) {
  return x >= 999.5 && x < 1e15 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

/// Returns "2 is 154 % of the scene's diagonal (1.3)".
std::string share_text(const Length& length, double diagonal) {
  return fmt::format("{} is {} % of the scene's diagonal ({:.4g})", length.text(),
                     number(100 * length.value / diagonal), diagonal);
}

std::string insist_text(const Length& length, double diagonal) {
  return fmt::format("to insist, write {}%", number(100 * length.value / diagonal));
}

/// Returns what a number larger than the scene probably means: the same number of percent, or of voxels; empty if
/// neither fits.
std::string likely_length(const Length& length, double diagonal, double voxel) {
  if (length.value <= 100 * kLargestShare) return fmt::format(": did you mean {}%?", length.text());
  if (voxel > 0 && length.value * voxel <= kLargestShare * diagonal)
    return fmt::format(": did you mean {}vx?", length.text());
  return ": is the scene in other units?";
}

bool is_in_proportion(double voxels) {
  return voxels >= kFewestVoxels && voxels <= kMostVoxels;
}

std::string likely_voxel(const Length& voxel, double side, double diagonal) {
  const double value = voxel.value;
  if (value > 0 && is_in_proportion(side / (value / 100 * diagonal)))
    return fmt::format("did you mean {}%?", voxel.text());
  if (value == std::floor(value) && is_in_proportion(value))
    return fmt::format("did you mean --resolution {}?", voxel.text());
  return "is the scene in other units?";
}

/// Returns "makes a grid of 75000 voxels along the scene's longest side (0.75)".
std::string grid_text(double voxels, double side) {
  return fmt::format("makes a grid of {} voxels along the scene's longest side ({:.4g})", number(voxels), side);
}

}  // namespace

void question_length(const char* option, const Length& length, const Bounds3d& scene, double voxel) {
  const double diagonal = scene.empty() ? 0 : scene.diagonal();
  if (length.unit != Length::Unit::scene || !(diagonal > 0) || length.value <= kLargestShare * diagonal) return;
  const std::string insist = length.value > diagonal ? "" : " " + insist_text(length, diagonal);
  fail(ErrorCode::bad_argument, "{} {}{}{}", option, share_text(length, diagonal),
       likely_length(length, diagonal, voxel), insist);
}

void question_scale(const char* option, const Length& scale, const Bounds3d& scene, double voxel) {
  question_length(option, scale, scene, voxel);
  if (scale.unit == Length::Unit::scene || (scale.unit == Length::Unit::voxels && !(voxel > 0))) return;
  const double diagonal = scene.empty() ? 0 : scene.diagonal();
  if (diagonal > 0 && scale.in_world(diagonal, voxel) > diagonal) {
    fail(ErrorCode::bad_argument, "{} {} is longer than the scene's diagonal ({:.4g}); 100% is the most", option,
         scale.text(), diagonal);
  }
}

std::string scale_share_note(const std::optional<Length>& scale, const Bounds3d& scene) {
  const double diagonal = scene.empty() ? 0 : scene.diagonal();
  if (!scale || scale->unit != Length::Unit::scene || !(diagonal > 0) || scale->value < kNotedShare * diagonal)
    return "";
  const double value = scale->value;
  const std::string percent =  // larger numbers are hardly meant as percentages
      value > 100 * kLargestShare ? ""
                                  : fmt::format("; --scale {}% would be {:.3g}", scale->text(), value / 100 * diagonal);
  return fmt::format("--scale {}, and gaps up to {:.3g} are closed{}", share_text(*scale, diagonal), 2 * value,
                     percent);
}

void question_resolution(std::int64_t resolution, const Bounds3d& scene) {
  const double side = scene.longest_side();
  if (side > 0) question_grid(fmt::format("--resolution {}", resolution), side / double(resolution), scene, "");
}

void question_voxel(const char* option, const Length& voxel, const Bounds3d& scene) {
  const double side = scene.longest_side(), voxels = side / voxel.value;
  if (voxel.unit != Length::Unit::scene || !(side > 0) || is_in_proportion(voxels)) return;
  if (voxels > kMostVoxels) return question_grid(fmt::format("{} {}", option, voxel.text()), voxel.value, scene);
  fail(ErrorCode::bad_argument, "{} {} {}: {} {}", option, voxel.text(), grid_text(voxels, side),
       likely_voxel(voxel, side, scene.diagonal()), insist_text(voxel, scene.diagonal()));
}

void question_grid(const std::string& what, double voxel, const Bounds3d& scene, const char* likely) {
  const double side = scene.longest_side(), voxels = side / voxel;
  if (!(voxels > kMostVoxels)) return;
  fail(ErrorCode::bad_argument, "{} {}, more than {}: {}{}to insist, say --voxel {}%", what, grid_text(voxels, side),
       number(kMostVoxels), likely, *likely == 0 ? "" : " ", number(100 * voxel / scene.diagonal()));
}

}  // namespace bp
