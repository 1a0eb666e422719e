#include "tools/notes/scene_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/files/paths.h"
#include "io/scene/part_names.h"
#include "lib/core/error.h"
#include "lib/levels/voxel_choice.h"
#include "lib/pass/voxelize/stray_part.h"
#include "tools/cli/names.h"
#include "tools/notes/leak_words.h"
#include "tools/notes/proportion.h"

namespace bp {

namespace {

std::string point_text(const Vec3d& p) {
  return fmt::format("{:.6g},{:.6g},{:.6g}", p[0], p[1], p[2]);
}

/// Returns the voxel size that suits the rest of the scene, if the grid of the whole scene can have it.
std::string voxel_for_the_rest(const StrayPart& stray, const Bounds3d& scene) {
  const double voxel = stray.rest.longest_side() / double(kDefaultResolution);
  if (scene.longest_side() > kMostVoxels * voxel) return "";
  return fmt::format(", or say --voxel {:.3g} for {} voxels along the rest", voxel, kDefaultResolution);
}

/// Returns the names of the scene's parts that hold a triangle of `stray`. None if files cannot be read again, or name
/// no parts: then the note tells the place only.
std::set<std::string> names_of(const StrayPart& stray, const SceneAgain& scene) {
  if (std::count(scene.files.begin(), scene.files.end(), "-") > 0) return {};
  SceneOptions options = scene.options;
  options.part_names = std::make_shared<PartNames>();
  options.part_names->of_triangle = [&](const std::string&, const TriangleD& t) { return stray.holds(t); };
  try {
    const auto source = open_scenes(scene.files, options);
    for (std::vector<TriangleD> chunk; source->read(chunk);) {
    }
  } catch (const Error&) {
    return {};
  }
  return options.part_names->names;
}

std::string stray_note(const VoxelizeCounts& counts, const StreamHeader& header, const SceneAgain& scene) {
  if (!counts.stray) return "";
  const StrayPart& stray = *counts.stray;
  return fmt::format(
      "{:.2g} % of the surface{}, from {} to {}, makes the scene {:.4g} long, and the rest is {:.4g} long: its voxels "
      "are as large as for that ({:.4g}); take it out of the file if it was left there by mistake{}",
      100 * stray.share, parts_text("of", names_of(stray, scene)), point_text(stray.part.min),
      point_text(stray.part.max), header.bounds.longest_side(), stray.rest.longest_side(), header.frame.voxel,
      voxel_for_the_rest(stray, header.bounds));
}

/// Returns a note if the surface has an opening through which the flood enters, so that next to no inside was found.
/// Scenes that are mostly surface voxels, as of parts thinner than two voxels, get none.
std::string leak_note(const VoxelizeCounts& counts, const StreamHeader& header) {
  constexpr double kFilled = 0.02, kSolid = 0.5;  // shares of the volume that the triangles go around
  if (header.fill != FillMode::flood) return "";
  const double voxel_volume = std::pow(header.frame.voxel, 3), around = std::abs(counts.signed_volume);
  const double solid = double(counts.solid_voxels) * voxel_volume;
  const double filled = double(counts.solid_voxels - counts.surface_voxels) * voxel_volume;
  if (filled >= kFilled * around || solid >= kSolid * around) return "";
  return fmt::format(
      "the flood found next to no inside ({:.2g}), and the surface goes around about {:.2g}: it is open, and "
      "bpinfo --leaks tells where; --fill winding fills it all the same, and larger voxels close narrow openings",
      filled, around);
}

/// Returns the note about a scene that is a tileset of this suite with a place on the globe. Such a file begins with
/// its asset, which tells the place.
std::string placed_note(const std::vector<std::string>& files) {
  for (const std::string& path : files) {
    if (!path.ends_with(".json")) continue;
    const std::string head = head_of(path);
    const std::size_t place = head.find("\"placement\"");
    if (place < head.find("\"root\""))
      return fmt::format(
          "{}: stands on the globe, and is read in its own coordinates: its place is not kept, and bplod --place or "
          "--crs tells it again",
          path);
  }
  return "";
}

}  // namespace

std::vector<std::string> scene_notes(const VoxelizeCounts& counts, const StreamHeader& header,
                                     const SceneAgain& scene) {
  std::vector<std::string> notes;
  for (std::string text : {reading_note(counts.scene, header.frame.voxel), stray_note(counts, header, scene),
                           leak_note(counts, header), placed_note(scene.files)}) {
    if (!text.empty()) notes.push_back(std::move(text));
  }
  return notes;
}

}  // namespace bp
