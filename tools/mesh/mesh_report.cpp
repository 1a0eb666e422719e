#include "tools/mesh/mesh_report.h"

#include <fmt/ranges.h>

#include "tools/cli/names.h"
#include "tools/run/hiding_recipe.h"

namespace bp {

namespace {

/// Returns "1000" or "5000,1000,200"; "0" without a target.
std::string faces_text(const MeshOptions& o) {
  return o.levels.faces.empty() ? "0" : fmt::format("{}", fmt::join(o.levels.faces, ","));
}

Json json_of(const SurfaceDistance& d) {
  return {{"at_most", d.at_most}, {"at_least", d.at_least}, {"mean", d.mean}, {"where", d.where}};
}

Json json_of(const QuadMeasures& q) {
  return {{"count", q.count},
          {"share_of_triangles", q.share},
          {"bend", {{"mean", q.bend_mean}, {"max", q.bend_max}}},
          {"aspect", {{"mean", q.aspect_mean}, {"max", q.aspect_max}}},
          {"angle_degrees", {{"min", q.angle_min_degrees}, {"max", q.angle_max_degrees}}},
          {"volume_over_diagonals", {{"least", q.volume_least}, {"most", q.volume_most}}}};
}

/// `asked`: faces that were asked for; 0: none.
Json json_of(const LevelCounts& c, std::uint64_t asked) {
  const SimplifyCounts& s = c.simplify;
  const MeshMeasures& m = c.measures;
  Json refused;
  s.refused.for_each([&](Refusal, const char* name, std::uint64_t count) { refused[name] = count; });
  Json json = {{"faces", s.faces_out},
               {"faces_asked", asked > 0 ? Json(asked) : Json(nullptr)},
               {"stopped_by", c.stopped_by},
               {"error_bound", c.error_world},
               {"volume", m.volume},
               {"edge_length", {{"min", m.edge_min}, {"mean", m.edge_mean}, {"max", m.edge_max}}},
               {"angle_min_degrees", m.angle_min_degrees},
               {"shells", m.shells},
               {"handles", m.handles},
               {"faces_dense", s.faces_in},
               {"faces_flat_merged", s.faces_flat},
               {"collapses", s.collapses},
               {"refused", refused},
               {"moves", c.tighten.moves},
               {"flips", c.tighten.flips}};
  if (c.edge_factor > 0) json["edges_over_scale_at_most"] = c.edge_factor;
  if (m.quads) json["quads"] = json_of(*m.quads);
  if (m.proxy_to_enclosed) {
    json["distance"] = {{"proxy_to_enclosed", json_of(*m.proxy_to_enclosed)},
                        {"enclosed_to_proxy", json_of(*m.enclosed_to_proxy)},
                        {"hausdorff_at_most", m.hausdorff()}};
  }
  return json;
}

}  // namespace

Provenance mesh_provenance(const MeshOptions& o, const GridFrame& frame, const std::string& enclosed,
                           const std::string& input, std::size_t level) {
  OptionText text;
  text.add("mode", name_of(o.proxy.mode))
      .add("faces", faces_text(o))
      .add("error", o.error() ? o.error()->text() : "")
      .add("volume", o.volume)
      .add("enclose", enclosed)
      .add("tighten", true);
  if (o.edge_factor) text.add("edge_factor", *o.edge_factor);
  if (o.quads) text.add("quads", o.quads);
  if (o.levels.faces.size() > 1) text.add("level", level);
  if (o.proxy.mode == MeshMode::inside) add_recipe({frame}, text);
  return make_provenance("bpmesh", text, input);
}

void fill_report(Report& report, const MeshOptions& o, const MeshCounts& c) {
  report.options = {{"mode", name_of(o.proxy.mode)},
                    {"faces", o.levels.faces},
                    {"error", o.error() ? o.error()->text() : ""},
                    {"volume", o.volume},
                    {"enclose", o.proxy.enclose.text()},
                    {"origin", o.proxy.origin.text()}};
  if (o.edge_factor) report.options["edge_factor"] = *o.edge_factor;
  Json levels = Json::array();
  for (std::size_t i = 0; i < c.levels.size(); ++i) {
    Json& level = levels.emplace_back(json_of(c.levels[i], i < o.levels.faces.size() ? o.levels.faces[i] : 0));
    if (c.levels[i].edge_factor > 0 && !o.edge_factor)
      level["edges_longer_near_closing"] = o.proxy.mode == MeshMode::bounding;
  }
  report.counts = {{"voxels", c.voxels},
                   {"voxels_repaired", c.repaired},
                   {"parts_dropped", c.dropped_parts},
                   {"voxels_dropped", c.dropped_voxels},
                   {"volume_of_voxels", c.solid_volume_world},
                   {"levels", levels}};
}

}  // namespace bp
