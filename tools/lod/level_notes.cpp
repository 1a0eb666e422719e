#include "tools/lod/level_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/check/counted.h"
#include "lib/volume/topology.h"
#include "tools/cli/shell_word.h"
#include "tools/lod/choices.h"
#include "tools/notes/face_notes.h"
#include "tools/notes/proportion.h"
#include "tools/run/enclosed_triangles_limit.h"

namespace bp {

namespace {

// Errors below this, in voxels, are due to the rounding of vertices to the lattice.
constexpr double kExactVox = 1.0 / 16;

/// Returns "level 1 (250 faces)": the number that its file has, and what the user asked for in a list.
std::string title_of(std::size_t number, const LevelFacts& level, bool is_listed) {
  const std::uint64_t faces = is_listed ? level.target.faces : 0;
  return fmt::format("level {}{}", number, faces > 0 ? fmt::format(" ({})", counted(faces, "face")) : "");
}

/// Returns whether a level is a box, a prism or a hull, for which no voxels were meshed.
bool is_convex(const LevelFacts& level) {
  return level.voxels == 0;
}

}  // namespace

std::string faces_note(const LevelFacts& level, bool asked, std::uint64_t triangles) {
  const std::uint64_t budget = level.target.faces;
  if (level.stopped_by == kFromScene)
    return asked && level.faces >= triangles && clearly_fewer(level.faces, budget)
               ? fmt::format("{} faces instead of {}: the scene has no more", level.faces, budget)
               : "";
  FaceAdvice advice;
  advice.exact = level.error_world < kExactVox * level.voxel;
  if (level.scale_world < level.voxel) advice.scale.clear();  // a smaller scale would close nothing
  if (asked && level.reached && level.faces >= triangles && clearly_fewer(level.faces, budget))
    return fmt::format(
        "{} faces instead of {}: the scene has {}{}", level.faces, budget, counted(triangles, "triangle"),
        advice.exact ? ""
                     : fmt::format(", and more faces would show steps of voxels; smaller voxels{} come nearer",
                                   advice.scale.empty() ? "" : ", or a smaller --scale,"));
  if (!level.reached && budget < kFacesOfTetrahedron)
    return fmt::format("{} faces instead of {}: a closed mesh has at least {}, as a tetrahedron", level.faces, budget,
                       kFacesOfTetrahedron);
  if (!level.reached)
    return fmt::format("{} faces instead of {}, even closed at {:.4g}: no further edge can be merged", level.faces,
                       budget, level.scale_world);
  if (!asked) return "";
  if (is_convex(level) && !advice.exact && clearly_fewer(level.faces, budget))
    return fmt::format(
        "{} faces instead of {}: a box, a prism or a hull around the scene is nearer, or holds less, than "
        "what else was found",
        level.faces, budget);
  if (level.attempts == 1) {
    return level.stopped_by == to_string(StopReason::least_volume) ? least_volume_note(level.faces, budget, advice)
                                                                   : too_few_note(level.faces, budget, advice);
  }
  return closed_note(level);
}

std::string closed_note(const LevelFacts& level) {
  if (level.attempts == 1 || !level.reached) return "";
  const std::uint64_t budget = level.target.faces;
  const std::string fewer =
      clearly_fewer(level.faces, budget) ? fmt::format("{} faces instead of {}: ", level.faces, budget) : "";
  if (level.scale_world == 0)  // only cages have no scale here
    return fewer.empty() ? "" : fewer + "one step finer makes too many";
  if (level.target.scale_world && *level.target.scale_world == 0)
    return fmt::format("{}closed at {:.4g}: as it is, parts and holes take more than {} faces", fewer,
                       level.scale_world, budget);
  return fmt::format(
      "{}closed at {:.4g}, {} times the scale that was tried first: at less, parts and holes take more than {} faces",
      fewer, level.scale_world, std::uint64_t(1) << (level.attempts - 1), budget);
}

std::string limbs_note(const LimbCounts& limbs, std::uint64_t budget) {
  constexpr std::size_t kMostPlaces = 4;
  if (limbs.joined.empty()) return "";
  std::string places;
  for (std::size_t i = 0; i < std::min(limbs.joined.size(), kMostPlaces); ++i) {
    const Vec3d& p = limbs.joined[i];
    places += fmt::format("{}{:.4g},{:.4g},{:.4g}", i > 0 ? " " : "", p[0], p[1], p[2]);
  }
  return fmt::format(
      "{} of {} grow together with others in the cage, with tips at {}{}; --faces {} or a smaller --margin may keep "
      "them "
      "apart",
      limbs.joined.size(), counted(limbs.count, "limb"), places, limbs.joined.size() > kMostPlaces ? " ..." : "",
      2 * budget);
}

std::string error_note(std::size_t level, double error_world, double asked_world) {
  return fmt::format(
      "level {}: its error is at most {:.4g} instead of {:.4g}: its voxels or its scale are too large for less; a "
      "smaller --voxel or --scale comes nearer",
      level, error_world, asked_world);
}

std::vector<std::string> level_notes(const std::vector<LevelFacts>& levels, std::size_t first, bool asked,
                                     const SceneSize& scene) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LevelFacts& level = levels[i];
    const std::string title = title_of(first + i, level, asked && first + levels.size() > 1);
    if (const std::string missed = faces_note(level, asked, scene.triangles); !missed.empty())
      notes.push_back(fmt::format("{}: {}", title, missed));
    if (const std::string joined = limbs_note(level.limbs, level.target.faces); !joined.empty())
      notes.push_back(joined);
    if (const double error = level.target.error_world; error > 0 && level.error_world > error)
      notes.push_back(error_note(first + i, level.error_world, error));
    if (level.error_world > scene.bounds.diagonal() && level.target.faces > 0 && level.target.faces < kLeastFaces)
      notes.push_back(
          fmt::format("{}: its error is {:.4g}, more than the diagonal of the scene, {:.4g}; {} faces, "
                      "as a box has, come nearer",
                      title, level.error_world, scene.bounds.diagonal(), kLeastFaces));
  }
  return notes;
}

std::string left_out_note(const LeftOut& level, double diagonal) {
  const std::string name = level.target.faces > 0 ? counted(level.target.faces, "face")
                                                  : fmt::format("an error of {:.4g}", level.target.error_world);
  std::string why;
  if (level.faces == 0) {
    why = fmt::format("the one before it has {} already", level.faces_before);
  } else if (level.faces_after > 0) {
    why = fmt::format("with an error of {:.4g} it would hardly be nearer than the next one, which has {} faces",
                      level.error_world, level.faces_after);
  } else if (level.volume_ratio > 0) {
    why = fmt::format("it would hold {:.1f} times the volume of the one before; --levels asks for them all the same",
                      level.volume_ratio);
  } else if (level.faces >= level.faces_before) {
    why = fmt::format("it would have {} faces, and the one before it has {}", level.faces, level.faces_before);
  } else {
    why = fmt::format("its error would be {:.4g}, more than the diagonal of the scene, {:.4g}", level.error_world,
                      diagonal);
  }
  return fmt::format("the level of {}{} left out: {}", name, level.volume_ratio > 0 ? ", and all after it, are" : " is",
                     why);
}

std::string origin_note(const BuildOptions& o, const StreamHeader& header) {
  return o.is_tileset() ? "" : origin_note(o.proxy.origin, header.frame, header.bounds);
}

std::string voxel_note(const BuildOptions& o, const SceneSize& scene) {
  if (o.shows_scene() || !is_by_scene(o) || scene.triangles <= kTilesetFaces) return "";
  const double voxel = voxel_size(o, scene);
  return fmt::format(
      "the scene has {} triangles, and its voxels of {:.4g} suit {}; --voxel {:.2g} shows more and takes about 4 times "
      "as long",
      scene.triangles, voxel, kTilesetFaces, voxel / 2);
}

std::string enclose_note(const BuildOptions& o, std::uint64_t triangles) {
  if (o.proxy.enclose.what() || !may_enclose_scene(o) || enclosed_by(o, triangles) == Enclose::scene) return "";
  const bool file = can_read_again(o);
  return fmt::format("{}: levels enclose the scene's voxels, not its triangles, and are less tight; {}",
                     file ? fmt::format("the scene has {} triangles, more than {}", triangles, kMostEnclosedTriangles)
                          : "the scene comes from a pipe and cannot be read again",
                     file ? "--enclose scene takes them all the same" : "give it as a file");
}

std::vector<std::string> option_notes(const BuildOptions& o, const SceneSize& scene, const StreamHeader& header) {
  return {scale_share_note(o.closing.scale, scene.bounds), voxel_note(o, scene), origin_note(o, header),
          enclose_note(o, scene.triangles)};
}

std::string heavier_note(const LevelFacts& finest, bool asked, std::uint64_t triangles) {
  if (finest.faces <= std::max(triangles, kLeastFaces)) return "";
  if (asked && clearly_fewer(finest.faces, finest.target.faces)) return "";  // faces_note() tells it
  return fmt::format("level 0 has {} faces, more than the scene's {}{}", finest.faces, counted(triangles, "triangle"),
                     asked ? "; --faces 50% asks for half of those" : "");
}

SceneParts parts_of(const VoxelizedScene& scene, const BuildOptions& o, std::uint64_t memory_bytes) {
  // faces_note() tells about the level then.
  const bool told = o.profile != LodProfile::collision && asks_for_faces(request_of(o));
  const bool by_faces = o.levels.errors.empty() && o.proxy.mode == MeshMode::bounding;
  if (told || !by_faces || o.is_cage() || topology_bytes(*scene.solid) > memory_bytes) return {};
  const double voxel = scene.header.frame.voxel;
  return {topology_of(*scene.solid).parts, double(scene.counts.solid_voxels) * std::pow(voxel, 3),
          o.closing.scale ? o.closing.scale->in_world(scene.header.bounds.diagonal(), voxel) : 0};
}

std::string joined_note(const LevelFacts& finest, std::uint64_t parts, const SceneParts& scene) {
  constexpr double kSame = 1.001;
  if (parts >= scene.count || finest.volume < kLoose * scene.volume) return "";
  if (!is_convex(finest) && finest.scale_world <= kSame * scene.named_scale) return "";  // as asked
  const std::uint64_t enough = scene.count * kFacesOfBox, faces = finest.target.faces;
  return fmt::format(
      "{} of the scene become {}: {}{}", counted(scene.count, "part"), parts,
      is_convex(finest) ? "a box, a prism or a hull lies around all"
                        : fmt::format("gaps narrower than {:.4g} are filled", 2 * finest.scale_world),
      faces < enough
          ? fmt::format(", since {} faces are too few for all; from --faces {} on they may stay apart", faces, enough)
          : "; more --faces may keep them apart");
}

std::string no_image_note(const ImageFaults& faults) {
  const std::string which = faults.images > 1 ? fmt::format("the first of {}: ", faults.images) : "";
  return fmt::format("no image of the scene's textures can be read, so levels have colours instead; {}{}", which,
                     faults.first);
}

std::string proof_command(const BuildOptions& o, const std::string& file, bool hulls, double margin) {
  if (o.proxy.mode == MeshMode::fit || !can_read_again(o) || file.ends_with(".xml")) return "";
  std::string command = o.profile == LodProfile::occluder ? "bpcheck --inside" : hulls ? "bpcheck --convex" : "bpcheck";
  if (margin > 0) command += fmt::format(" --margin {}", margin);
  if (!o.voxels.format.empty()) command += " --format " + o.voxels.format;
  for (const std::string& scene : o.voxels.scenes) command += " " + shell_word(scene);
  return command + " " + shell_word(o.out + (o.out.ends_with('/') ? "" : "/") + file);
}

}  // namespace bp
