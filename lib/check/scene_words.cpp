#include "lib/check/scene_words.h"

#include <fmt/format.h>

#include "lib/check/counted.h"

namespace bp {

std::string held_twice(std::uint64_t differing) {
  return counted(differing, "mesh part") + " twice, plain and compressed, and not alike: programs may read either";
}

std::string not_followed(const Unfollowed& u) {
  std::string all;
  const auto add = [&](std::uint64_t n, const char* one, const char* rest) {
    if (n > 0) all += (all.empty() ? "" : ", ") + counted(n, one) + rest;
  };
  add(u.skins, "mesh part", " in a pose of joints");
  add(u.morphs, "mesh part", " with a morph target");
  add(u.transforms, "node",
      " whose transform programs read in different ways (lookat, rotate, rotations that are no turns, sheared "
      "matrices, instances, ids, X_UP)");
  add(u.vertices, "mesh part", " whose vertices programs read in different ways");
  add(u.missing, "shape",
      " left out (in another file or scene, a solid, a NURBS surface, a DXF face with a hidden edge)");
  add(u.lines, "line", " that programs read in different ways (where it ends, words that others pass over)");
  add(u.placed, "placement", " by the importer, in single precision");
  add(u.foreign, "file", " of a format that only Assimp reads, which leaves out parts of it");
  add(u.culled, "mesh part", " beyond its min and max in the file, by which viewers cull");
  add(u.hidden, "mesh part", " that viewers may hide");
  add(u.variants, "document", " that shows more than one pose or scene (animations, no default scene)");
  return all;
}

std::string drawn_elsewhere(const char* whose, const Unfollowed& u) {
  const bool elsewhere = u.draws_elsewhere();
  return fmt::format("programs may {} the {} {}: {}", elsewhere ? "draw" : "hide", whose,
                     elsewhere ? "elsewhere than it was read" : "or parts of it", not_followed(u));
}

std::string left_out_lines(const SceneCounts& c, const std::string& indent) {
  std::string text, all;
  const auto add = [&](std::uint64_t n, const std::string& what) {
    if (n > 0) all += (all.empty() ? "" : ", ") + what;
  };
  add(c.degenerate - c.kept_degenerate, counted(c.degenerate - c.kept_degenerate, "triangle") + " without area");
  add(c.non_finite, counted(c.non_finite, "triangle") + " with a coordinate that is not finite");
  add(c.bad_faces, counted(c.bad_faces, "face") + " that cannot be read");
  if (!all.empty()) text = indent + "left out: " + all + "\n";
  if (c.differing > 0) text += indent + "its files hold " + held_twice(c.differing) + "\n";
  if (c.unfollowed.any()) text += indent + "not followed: " + not_followed(c.unfollowed) + "\n";
  return text;
}

std::string partial_scene(const SceneCounts& c) {
  if (c.non_finite + c.bad_faces > 0) return "surfaces of the scene were left out, and nothing is proven of them";
  if (c.differing > 0) return "the scene's files hold " + held_twice(c.differing);
  return drawn_elsewhere("scene", c.unfollowed);
}

}  // namespace bp
