#include "tools/check/hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "io/scene/scene_format.h"
#include "lib/check/verdict_text.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/store/content_hash.h"
#include "lib/store/hex.h"
#include "tools/cli/shell_word.h"
#include "tools/run/grounded_source.h"
#include "tools/run/hiding_recipe.h"

namespace bp {

namespace {

bool is_file(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(path, unknown);
}

/// Returns the VoxelizeCounts::input_hash of these scenes, read as the tool that made a proxy read them. Empty if they
/// cannot be read.
std::string hash_of(const std::vector<std::string>& scenes, SceneOptions options,
                    const std::optional<HidingRecipe>& recipe) {
  options.walls_only = recipe && recipe->opaque_only;
  options.keep_degenerate = true;
  options.keep_extremes = false;
  ContentHash hash;
  try {
    std::unique_ptr<TriangleSource> scene = open_scenes(scenes, options);
    if (recipe && recipe->ground) scene = std::make_unique<GroundedSource>(std::move(scene), recipe->frame.up);
    for (std::vector<TriangleD> chunk; scene->read(chunk);) hash.add(std::as_bytes(std::span(chunk)));
  } catch (const Error&) {
    return "";
  }
  const auto [high, low] = hash.value().words;
  return hex_of(high, low);
}

/// Returns whether only the rounding of coordinates keeps a question open: it was asked, and answered as read.
bool is_doubt_of_rounding(const CheckReport& r) {
  if (!(r.scene_counts.rounding.any() || r.proxy_off > 0) || !r.place_unknown.empty() || r.is_partial()) return false;
  return r.within_rounding.count + r.perhaps_near.count + r.touching.count + r.outside.count + r.swallowed.count +
             r.not_held.count + r.too_near.count + r.outside_parts.count >
         0;
}

std::string written_anew_hint(const std::string& proxy) {
  return fmt::format("{} was rounded when it was read: write the proxy as GLB, PLY or OBJ, which are read in double",
                     proxy);
}

}  // namespace

bool is_gltf(const std::string& path) {
  const std::string format = scene_format_of(path);
  return format == "gltf" || format == "glb";
}

MeshExtras extras_of(const std::string& path) {
  if (!is_file(path)) return {};
  try {
    return mesh_extras(path);
  } catch (const Error&) {
    return {};
  }
}

std::optional<Vec3d> told_origin(const std::vector<std::string>& scenes, const std::string& proxy) {
  const MeshExtras extras = extras_of(proxy);
  const std::optional<Vec3d> origin = extras.recorded ? extras.origin : std::nullopt;
  if (scenes.empty() || !origin || !is_finite(*origin)) return {};
  for (const std::string& scene : scenes) {
    if (extras_of(scene).origin == origin) return {};
  }
  return origin;
}

std::string other_scene_hint(const std::vector<std::string>& scenes, const std::string& proxy,
                             const SceneOptions& options) {
  const MeshExtras extras = extras_of(proxy);
  const std::string told = hash_of_scene(extras);
  if (told.empty() || !std::all_of(scenes.begin(), scenes.end(), is_file)) return "";
  for (const std::string& scene : scenes) {
    // The scene is itself a level, and the proxy is within or around it.
    if (hash_of_scene(extras_of(scene)) == told) return "";
  }
  const std::string found = hash_of(scenes, options, hiding_recipe(extras));
  if (found.empty() || found == told) return "";
  return fmt::format("{} was made from another scene than {}, or from an earlier version of it", proxy,
                     scenes.size() == 1 ? scenes[0] : "these");
}

std::string enclosure_hint(const std::string& scene, const std::string& proxy, bool inside) {
  const MeshExtras extras = extras_of(proxy);
  const std::string maker = made_by(extras_of(scene));
  if (!maker.empty() && extras.provenance.empty())
    return fmt::format("{} was made by {}, and {} was not: if they are swapped, name the proxy last", scene, maker,
                       proxy);
  if (extras.tile)
    return fmt::format("{} is the content of a tile, and lies elsewhere than its scene: check its tileset.json", proxy);
  const std::string mode = mode_of(extras);
  if (mode == "fit" || mode == "visual") return fit_hint(proxy);
  if (mode == "inside" && !inside)
    return fmt::format("{} was made with --mode inside, to lie within its scene: prove that with --inside", proxy);
  if (mode == "bounding" && inside)
    return fmt::format("{} was made with --mode bounding, to enclose its scene: prove that without --inside", proxy);
  return "";
}

std::string convex_hint(const std::string& proxy, bool convex_parts) {
  const bool named = extras_of(proxy).hulls;
  if (!named && !convex_parts) return "";
  return fmt::format(
      "{} {}, and was checked as one surface: check it with --convex, which asks whether each is convex and whether "
      "together they cover the scene",
      proxy, named ? "holds convex hulls, by the names of its nodes (UCX_)" : "consists of convex parts that meet");
}

std::string look_hint(const std::vector<std::string>& files, const std::string& format, const Vec3d& origin,
                      const std::vector<CheckReport>& verdicts) {
  std::optional<Vec3d> place;
  for (const CheckReport& verdict : verdicts) {
    if (!place && verdict.answer() == Answer::refuted) place = first_place(verdict);
  }
  const std::size_t drawn = files.size() - (origin == Vec3d{} ? 0 : 1);
  if (!place || drawn == 0 || std::count(files.begin(), files.end(), "-") > 0) return "";
  std::string command = "bpinfo";
  for (std::size_t i = 0; i < drawn; ++i) command += " " + shell_word(files[i]);
  if (!format.empty()) command += " --format " + shell_word(format);
  return fmt::format("to see the first place: {} --image place.png --zoom 8 --look-at={:.9g},{:.9g},{:.9g}", command,
                     (*place)[0], (*place)[1], (*place)[2]);
}

std::string memory_hint(const std::vector<CheckReport>& verdicts, const MemoryShare& memory) {
  std::uint64_t bytes = 0;
  for (const CheckReport& verdict : verdicts) bytes = std::max(bytes, verdict.hidden_bytes);
  if (bytes <= memory.bytes) return "";
  return fmt::format("to decide whether the proxy is hidden, raise --memory to at least {} MiB",
                     (memory.limit_with(bytes - memory.bytes) >> 20) + 1);
}

std::string rounding_hint(const std::string& scene, const std::string& proxy,
                          const std::vector<CheckReport>& verdicts) {
  const auto undecided = [&](const auto& unfollowed) {
    return std::any_of(verdicts.begin(), verdicts.end(),
                       [&](const CheckReport& r) { return r.answer() == Answer::undecided && unfollowed(r).any(); });
  };
  const bool of_scene = undecided([](const CheckReport& r) { return r.scene_counts.unfollowed; });
  if (of_scene || undecided([](const CheckReport& r) { return r.unfollowed; })) {
    const std::string& file = of_scene ? scene : proxy;
    if (is_gltf(file))
      return fmt::format(
          "{}: give rotations the length 1, weights of a skin the sum 1, POSITION its min and max; show its nodes in a "
          "scene",
          file);
    const std::string format = scene_format_of(file);
    if (format == "obj" || format == "ply" || format == "off" || format == "stl")
      return fmt::format(
          "{}: write it anew, each vertex and each face on a line of its own that ends with LF, with the words that "
          "the "
          "format has and nothing behind them",
          file);
    return fmt::format("write {} as glTF, whose nodes, skins and morph targets are followed", file);
  }
  for (const CheckReport& r : verdicts) {
    if (r.answer() == Answer::undecided && is_doubt_of_rounding(r))
      return r.scene_counts.rounding.any() ? rounded_hint(scene) : written_anew_hint(proxy);
  }
  return "";
}

std::string rounded_hint(const std::string& scene) {
  return fmt::format(
      "{} may stick out by what reading has rounded: write the scene as PLY or OBJ with all transforms applied, which "
      "is read in double as it is, and make a proxy of that; or make one that keeps a distance (bplod --profile cage "
      "--margin)",
      scene);
}

std::string fit_hint(const std::string& content) {
  const std::string mode = mode_of(extras_of(content));
  if (mode == "visual")
    return content + " was made with --mode visual, to be looked at, and does not claim to enclose its scene";
  if (mode != "fit") return "";
  return fmt::format(
      "{} was made with --mode fit, which draws it close to the scene and need not enclose it: check it alone, or make "
      "it without",
      content);
}

}  // namespace bp
