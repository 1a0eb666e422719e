#include "tools/info/mesh_info.h"

#include <algorithm>

#include "io/files/file.h"
#include "lib/check/counted.h"
#include "lib/check/scene_words.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

std::uint64_t count_positions(const std::vector<TriangleD>& triangles) {
  std::vector<Vec3d> points;
  points.reserve(triangles.size() * 3);
  for (const TriangleD& t : triangles) points.insert(points.end(), t.begin(), t.end());
  std::sort(points.begin(), points.end());
  return std::uint64_t(std::unique(points.begin(), points.end()) - points.begin());
}

}  // namespace

MeshInfo measure(TriangleSource& source) {
  MeshInfo info;
  std::vector<TriangleD> batch;
  std::vector<TriangleColors> colors;
  std::vector<std::uint8_t> inner_edges;
  while (source.read_faces(batch, colors, inner_edges)) {
    info.totals.add(batch);
    info.faces.add(inner_edges);
    if (info.totals.triangles <= MeshInfo::kMaxKept) {
      info.triangles.insert(info.triangles.end(), batch.begin(), batch.end());
      info.colors.insert(info.colors.end(), colors.begin(), colors.end());
      info.inner_edges.insert(info.inner_edges.end(), inner_edges.begin(), inner_edges.end());
    } else {
      info.triangles = {};
      info.colors = {};
      info.inner_edges = {};
    }
  }
  if (!source.has_colors()) info.colors = {};
  info.counts = source.counts();
  if (info.triangles.size() == info.totals.triangles) info.vertices = count_positions(info.triangles);
  return info;
}

/// Returns a text that tells how polygons were counted as triangles; empty if there are triangles only.
std::string cut_text(const FaceCounts& faces) {
  if (faces.quads + faces.polygons == 0) return "";
  return faces.triangles == 0 ? " after cutting" : fmt::format(" after cutting, {} before", faces.triangles);
}

std::string level_text(std::size_t level, std::size_t levels) {
  if (levels == 1) return "";
  return level == 0 ? fmt::format("finest of {} levels", levels)
                    : fmt::format("level {} of 0 to {}", level, levels - 1);
}

/// Returns the first names; --json has all.
std::string names_text(const PartNames& all) {
  constexpr std::size_t kMost = 8;
  if (all.names.empty()) return "";
  std::string text = fmt::format("names       {}{}", all.names.size(), all.complete ? ": " : " and more: ");
  std::size_t n = 0;
  for (const std::string& name : all.names) {
    if (++n > kMost) return text + ", ...\n";
    text += (n > 1 ? ", " : "") + name;
    std::replace_if(
        text.begin(), text.end(), [](char c) { return std::uint8_t(c) < ' ' || c == 0x7f; }, '?');
  }
  return text + "\n";
}

std::string moves_text(const MeshExtras& extras) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (extras.animations > 0) add(counted(extras.animations, "animation"));
  if (extras.morph_targets > 0) add(counted(extras.morph_targets, "morph target"));
  if (extras.skins > 0)
    add(counted(extras.skins, "skin") + (extras.skins > 1 ? " of up to " : " of ") + counted(extras.joints, "joint"));
  return text.empty() ? "" : "moves       " + text + "; this is the scene before it moves\n";
}

std::string mesh_text(const MeshInfo& info, const std::string& name) {
  const TriangleTotals& t = info.totals;
  const auto point = [](const Vec3d& p) { return fmt::format("{} {} {}", p[0], p[1], p[2]); };
  std::string s = fmt::format("{}: mesh\n", name);
  if (info.faces.quads > 0) s += fmt::format("quads       {}\n", info.faces.quads);
  if (info.faces.polygons > 0) s += fmt::format("polygons    {} of more than four corners\n", info.faces.polygons);
  s += fmt::format("triangles   {}{}\n", t.triangles, cut_text(info.faces));
  if (info.vertices) s += fmt::format("vertices    {}\n", *info.vertices);
  const SceneCounts& c = info.counts;
  if (c.instances > 1) s += fmt::format("instances   {}\n", c.instances);
  if (c.degenerate + c.non_finite + c.bad_faces > 0) {
    s += fmt::format("skipped     {} degenerate, {} not finite, {} broken\n", c.degenerate, c.non_finite, c.bad_faces);
  }
  if (c.unfollowed.any()) s += fmt::format("unread      {}\n", not_followed(c.unfollowed));
  if (c.rounding.share > 0x1p-30)  // rounding of single precision
    s += fmt::format("read        to within {:.2g} of the file's coordinates\n", c.rounding.most);
  if (!t.bounds.empty()) {
    s += fmt::format("bounds      {} to {}, diagonal {:.6g}\n", point(t.bounds.min), point(t.bounds.max),
                     t.bounds.diagonal());
    s += fmt::format("area        {:.6g}\nvolume      {}\n", t.area, volume_text(t.volume));
  }
  s += names_text(info.names);
  if (info.extras.levels > 1)
    s += fmt::format("levels      {}, of which this is {}\n", info.extras.levels,
                     info.level == 0 ? "the finest" : fmt::format("level {}", info.level));
  s += moves_text(info.extras);
  if (info.extras.origin)
    s += fmt::format("origin      {} was subtracted from all coordinates\n", point(*info.extras.origin));
  for (const std::string& step : info.extras.provenance)
    s += fmt::format("made by     {}{}\n", step, info.level > 0 ? "; level 0" : "");
  return s + fmt::format("checksum    {}\n", t.checksum());
}

Json mesh_json(const MeshInfo& info) {
  const TriangleTotals& t = info.totals;
  const SceneCounts& c = info.counts;
  Json j{{"kind", "mesh"}, {"checksum", t.checksum()}, {"triangles", t.triangles}};
  j["faces"] = {{"triangles", info.faces.triangles}, {"quads", info.faces.quads}, {"polygons", info.faces.polygons}};
  if (info.vertices) j["vertices"] = *info.vertices;
  j["instances"] = c.instances;
  j["skipped"] = {{"degenerate", c.degenerate}, {"non_finite", c.non_finite}, {"bad_faces", c.bad_faces}};
  if (c.unfollowed.any()) j["not_followed"] = not_followed(c.unfollowed);
  if (c.rounding.any()) j["rounding"] = c.rounding.most;
  if (!t.bounds.empty()) {
    j["bounds"] = {{"min", t.bounds.min}, {"max", t.bounds.max}};
    j["area"] = t.area;
    j["volume"] = t.volume ? Json(*t.volume) : Json(nullptr);
  }
  j["levels"] = info.extras.levels;
  j["level"] = info.level;
  j["animations"] = info.extras.animations;
  j["morph_targets"] = info.extras.morph_targets;
  j["skins"] = info.extras.skins;
  j["joints"] = info.extras.joints;
  j["origin"] = info.extras.origin ? Json(*info.extras.origin) : Json(nullptr);
  j["provenance"] = info.extras.provenance;
  j["provenance_level"] = 0;
  j["names"] = info.names.names;
  return j;
}

}  // namespace bp
