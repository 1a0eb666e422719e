#include "tools/mesh/shortfalls.h"

#include <fmt/ranges.h>

#include <cmath>

#include "tools/notes/face_notes.h"

namespace bp {

namespace {

std::string level_text(const MeshCounts& c, std::size_t level) {
  return c.levels.size() > 1 ? fmt::format("level {}: ", level) : "";
}

/// Returns whether --error and the measures are distances to the closing: they are if nobody asked for the scene or its
/// voxels.
bool counts_from_closing(const MeshOptions& o) {
  using Enclose = EncloseOption::Kind;
  return o.proxy.enclose.kind == Enclose::closing || (o.error() && o.proxy.enclose.kind == Enclose::automatic);
}

/// Returns the name, for messages, of the set that distances of the proxy are measured to.
std::string measured_to(const MeshOptions& o) {
  if (o.proxy.mode == MeshMode::inside) return "what it lies in";
  if (o.proxy.mode == MeshMode::fit) return "what it is drawn to";
  return counts_from_closing(o) ? "what is meshed" : "what it encloses";
}

/// Adds a note for a level that exceeds --error or --volume. Steps keep these bounds, so such a level exceeded them at
/// its beginning.
void note_bounds(Report& report, const MeshOptions& o, const MeshCounts& c, std::size_t i,
                 const ShortfallFacts& facts) {
  const double error_world = facts.error_world;
  const LevelCounts& level = c.levels[i];
  const std::string which = level_text(c, i);
  const auto& distance = level.measures.proxy_to_enclosed;
  if (error_world > 0 && distance && distance->at_least > error_world * (1 + 1e-9)) {
    const std::string why =
        i > 0 && o.proxy.mode != MeshMode::fit
            ? "the voxels at the level before are as far; use smaller voxels, fewer levels or a larger --error"
            : fmt::format(
                  "the voxels {} as far; use {}smaller voxels{}",
                  o.proxy.mode == MeshMode::inside ? "themselves are" : "around it are",
                  facts.has_scale ? "a smaller bpclose --scale or " : "",
                  counts_from_closing(o) ? "" : ", or leave --enclose out: distances then count from the closing");
    report.note(fmt::format("{}the proxy is up to {:.4g} from {} instead of {:.4g}: {}", which, distance->at_least,
                            measured_to(o), error_world, why),
                o.common);
  }
  const double share = level.measures.volume / c.solid_volume_world;
  const bool beyond = o.proxy.mode == MeshMode::inside ? share < o.volume * (1 - 1e-9) : share > o.volume * (1 + 1e-9);
  if (o.volume > 0 && beyond) {
    report.note(
        fmt::format(
            "{}the volume is {:.4g} times that of the voxels that are meshed instead of {:.4g}, as it is of the "
            "voxels {}; use smaller voxels, {}or another --volume",
            which, share, o.volume, i > 0 ? "at the level before" : "to begin with", i > 0 ? "fewer levels " : ""),
        o.common);
  }
}

/// Returns the reasons why the remaining edges were not merged: "3 by topology, 1 by --volume".
std::string refusals_text(const MeshOptions& o, const SimplifyCounts& s) {
  const char* const limits = !o.error() ? "--volume" : o.volume == 0 ? "--error" : "--error or --volume";
  const std::pair<std::uint64_t, const char*> all[] = {
      {s.refused[Refusal::limits], limits},
      {s.refused[Refusal::link], "topology"},
      {s.refused[Refusal::constraints] + s.refused[Refusal::enclosed], "enclosure"},
      {s.refused[Refusal::shape], "shape"},
      {s.refused[Refusal::growth], "growth"},
      {s.refused[Refusal::guard], "intersection"}};
  std::vector<std::string> parts;
  for (const auto& [count, what] : all) {
    if (count > 0) parts.push_back(fmt::format("{} by {}", count, what));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Returns whether the finest proxy equals the scene, apart from rounding. Only a scene that is a solid can be reached.
bool is_exact(const MeshOptions& o, const MeshCounts& c, std::size_t i, const ShortfallFacts& facts) {
  constexpr double kRounding = 1e-3;
  if (i > 0 || o.proxy.mode != MeshMode::bounding || !facts.scene_volume) return false;
  const double solid = std::abs(*facts.scene_volume);
  return std::abs(c.levels[i].measures.volume - solid) < kRounding * solid;
}

FaceAdvice advice_of(const MeshOptions& o, const ShortfallFacts& facts) {
  return {o.proxy.mode, facts.has_scale ? "bpclose --scale" : ""};
}

/// Returns the reason why a level does not have the faces asked for.
std::string obstacle_text(const MeshOptions& o, const MeshCounts& c, std::size_t i, const ShortfallFacts& facts) {
  const LevelCounts& level = c.levels[i];
  const std::string& by = level.stopped_by;
  if (by == "error" && o.error()) return fmt::format("--error {} was reached first", o.error()->text());
  if (by == "edge-length" && o.edge_factor)
    return fmt::format("--edge-factor {:.4g} was reached first", *o.edge_factor);
  if (by == "volume") return fmt::format("--volume {} was reached first", o.volume);
  return merged_note(level.simplify.faces_out, level.measures.shells, level.measures.handles, advice_of(o, facts));
}

/// Adds a note for a level that does not have the faces asked for.
void note_faces(Report& report, const MeshOptions& o, const MeshCounts& c, std::size_t i, const ShortfallFacts& facts) {
  const LevelCounts& level = c.levels[i];
  const std::uint64_t faces = level.simplify.faces_out;
  if (i >= o.levels.faces.size()) return;
  FaceAdvice advice = advice_of(o, facts);
  advice.exact = is_exact(o, c, i, facts);
  const std::string few = level.simplify.stop == StopReason::least_volume
                              ? least_volume_note(faces, o.levels.faces[i], advice)
                              : too_few_note(faces, o.levels.faces[i], advice);
  if (!few.empty()) report.note(level_text(c, i) + few, o.common);
  if (faces <= o.levels.faces[i]) return;
  const bool coarser = i == 0 || faces < c.levels[i - 1].simplify.faces_out;
  const std::string refusals = refusals_text(o, level.simplify);
  report.note(fmt::format("{}{} faces instead of {}{}: {}{}", level_text(c, i), faces, o.levels.faces[i],
                          coarser ? "" : fmt::format(", no fewer than level {} has", i - 1),
                          obstacle_text(o, c, i, facts), refusals.empty() ? "" : " (tries refused: " + refusals + ")"),
              o.common);
}

/// Adds a note for a level whose volume is large because it has so few faces.
void note_volume(Report& report, const MeshOptions& o, const MeshCounts& c, std::size_t i,
                 const ShortfallFacts& facts) {
  if (i >= o.levels.faces.size() || o.volume > 0) return;
  const LevelCounts& level = c.levels[i];
  const std::string loose = loose_note(level.simplify.faces_out, level.measures.volume / c.solid_volume_world,
                                       level.measures.shells, level.measures.handles, advice_of(o, facts));
  if (!loose.empty()) report.note(level_text(c, i) + loose, o.common);
}

}  // namespace

void note_shortfalls(Report& report, const MeshOptions& o, const MeshCounts& c, const ShortfallFacts& facts) {
  if (c.dropped_parts > 0) {
    report.note(
        fmt::format("small parts left out: {}, with {} of {} voxels", c.dropped_parts, c.dropped_voxels, c.voxels),
        o.common);
  }
  for (std::size_t i = 0; i < c.levels.size(); ++i) {
    note_faces(report, o, c, i, facts);
    note_bounds(report, o, c, i, facts);
    note_volume(report, o, c, i, facts);
  }
}

}  // namespace bp
