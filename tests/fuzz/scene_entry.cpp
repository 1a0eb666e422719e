#include <array>

#include "tests/fuzz/entries.h"
#include "tests/fuzz/hostile_scene.h"
#include "tests/fuzz/tool_runs.h"

namespace fuzz {

namespace {

using Words = std::vector<std::string>;

/// Returns low resolutions, or voxels that are far too small or too large for any scene: sizes in between are honest
/// work.
Words grid(Choices& c) {
  static const Words kVoxels{"7%", "30%", "1e300", "1e-300", "5e-324", "1e100", "1e-20%", "1e300%", "1e-310%"};
  if (c.once_in(6)) return {"--voxel", c.of(kVoxels)};
  return {"--resolution", c.of<std::string>({"8", "16", "1", "5", "24", "2"})};
}

void require(bool good, const std::string& what, const ToolResult& result) {
  if (!good) fail_fuzz(what, result.output + result.messages);
}

/// Lists, draws or judges the scene as a mesh.
void look(std::uint32_t way, Workplace& place, const std::string& scene) {
  if (way == 0) {
    (void)place.run("bpcheck", {scene});
  } else if (way == 1) {
    (void)place.run("bpcheck", {scene, scene, "--inside"});
  } else if (way == 2) {
    (void)place.run("bpinfo", {scene, "--image", place.path("x.png"), "--image-size", "48"}, {"x.png"});
  } else {
    (void)place.run("bpinfo", {scene});
  }
}

/// Closes, meshes and proves.
void finish_pipe(Choices& c, Workplace& place, const std::string& scene, bool inside) {
  Words close{"--scale", c.of<std::string>({"1vx", "2vx", "0", "3%"}), place.path("v.bpv"), "-o", place.path("c.bpv")};
  if (!place.run("bpclose", close, {"c.bpv"}).done()) return;
  const std::string proxy = place.path("p." + c.of<std::string>({"ply", "obj", "glb"}));
  Words mesh{"--faces", c.of<std::string>({"20", "8", "60"}), place.path("c.bpv"), "-o", proxy};
  if (!inside && c.once_in(3)) mesh.insert(mesh.end(), {"--enclose", scene});
  if (!place.run("bpmesh", mesh, {"p.ply", "p.obj", "p.glb"}).done()) return;
  Words check{scene, proxy};
  if (inside) check.push_back("--inside");
  const ToolResult verdict = place.run("bpcheck", check);
  // "Inside" is not decided for numbers below 1e-90, nor for open scenes, whose voxels may have an inside all the same
  // (docs/bpcheck.1.md).
  const auto says = [&](const char* text) { return verdict.output.find(text) != std::string::npos; };
  // The record of a turn that no tool of the suite wrote leaves the answer open, and so do rounding by a reader and
  // what it does not follow.
  const bool no_answer =
      verdict.status == 5 &&
      (says("asset.extras.up") || says("rounded") || says("not followed: ") ||
       (inside && (says("coordinates that are too large or too small") || says("the scene is open"))));
  require(verdict.done() || no_answer, "the proxy of a scene does not hold", verdict);
}

}  // namespace

void scene(const std::uint8_t* data, std::size_t size) {
  Choices c(data, size);
  const std::uint32_t way = roll(data, size, 64);
  Workplace place;
  const std::string fill = c.of<std::string>({"flood", "none", "winding", "inside"});
  const Words size_of_grid = grid(c);
  const auto how_to_finish = c.raw<std::array<std::uint8_t, 4>>();
  const SceneFile file = hostile_scene(c);
  const std::string scene = place.path("s." + file.extension);
  place.write("s." + file.extension, file.bytes);
  if (way > 4) return look(way - 5, place, scene);
  Words words{scene, "--fill", fill, "-o", place.path("v.bpv")};
  words.insert(words.end(), size_of_grid.begin(), size_of_grid.end());
  const ToolResult voxels = place.run("bpvox", words, {"v.bpv"});
  if (!voxels.done()) return;
  const ToolResult info = place.run("bpinfo", {place.path("v.bpv")});
  require(info.done(), "bpvox made what bpinfo refuses", info);
  Choices finish(how_to_finish.data(), how_to_finish.size());
  const bool whole = voxels.messages.find("skipped") == std::string::npos;  // else the checker may know better
  if (way == 0 && whole) finish_pipe(finish, place, scene, fill == "inside");
}

}  // namespace fuzz
