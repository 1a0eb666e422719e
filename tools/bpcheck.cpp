// bpcheck: scene and proxy in, verdict out. Manual: docs/bpcheck.1.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/files/file.h"
#include "io/scene/scene_reader.h"
#include "io/tiles/tileset_file.h"
#include "io/tiles/tileset_level.h"
#include "lib/check/check_proxy.h"
#include "lib/check/verdict_text.h"
#include "lib/core/error.h"
#include "tools/check/check_budget.h"
#include "tools/check/check_run.h"
#include "tools/check/claim.h"
#include "tools/check/hints.h"
#include "tools/check/places.h"
#include "tools/check/tileset_verdict.h"
#include "tools/check/verdict_steps.h"
#include "tools/check/watched_source.h"
#include "tools/cli/names.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/run/hiding_recipe.h"
#include "tools/run/inputs.h"
#include "tools/run/memory_shares.h"
#include "tools/run/origin.h"
#include "tools/run/scene_budget.h"

namespace {

constexpr std::uint64_t kExamples = 5;

/// Returns the point that --origin names, or else the one in the proxy's file, with a note.
bp::Vec3d origin_of(const bp::CheckRun& o, bp::Report& report) {
  if (o.origin) return *o.origin;
  const std::vector<std::string> scenes(o.files.begin(), o.files.end() - 1);
  const std::optional<bp::Vec3d> told = bp::told_origin(scenes, o.files.back());
  if (!told || *told == bp::Vec3d{}) return {};
  report.note(fmt::format("{} says that {} was subtracted from it, which is added back", bp::file_name(o.files.back()),
                          bp::origin_text(*told)),
              o.common);
  return *told;
}

void fill_report(bp::Report& report, const bp::CheckRun& o, const bp::Vec3d& origin,
                 const std::vector<bp::CheckReport>& verdicts) {
  report.bytes_in = bp::size_of_files(o.files);
  report.options = {{"inside", o.inside}, {"convex", o.convex}, {"origin", origin}};
  report.counts = bp::counts_of(verdicts[0]);
  if (verdicts.size() > 1) {
    const bp::Answer answer = answer_of(verdicts);
    report.counts = {
        {"holds", answer == bp::Answer::proven}, {"answer", to_string(answer)}, {"levels", bp::Json::array()}};
    for (const bp::CheckReport& verdict : verdicts) report.counts["levels"].push_back(bp::counts_of(verdict));
  }
  if (!verdicts[0].distance_note.empty()) report.notes.push_back(verdicts[0].distance_note);
}

/// Refuses options that ask another question: its answer would be no answer to this one.
void refuse_for_tileset(const bp::CheckRun& o) {
  for (const auto& [option, given] : {std::pair{"--inside", o.inside},
                                      {"--convex", o.convex},
                                      {"--margin", o.margin.value > 0},
                                      {"--origin", o.origin.has_value()}}) {
    if (given) bp::fail(bp::ErrorCode::bad_argument, "{}: is for meshes; leave it out for a tileset", option);
  }
}

void note_hint(bp::Report& report, const bp::CheckRun& o, const std::string& hint) {
  if (!hint.empty()) report.note(hint, o.common);
}

/// Returns the exit status (docs/exit-codes.md).
int status_of(bp::Answer answer) {
  constexpr int kProven = 0, kRefuted = 1, kUndecided = 5;
  return answer == bp::Answer::proven ? kProven : answer == bp::Answer::refuted ? kRefuted : kUndecided;
}

/// Returns a hint about the failure of a tileset. Reads the scenes once more.
std::string tileset_hint(const std::vector<std::string>& scenes, const std::string& tileset,
                         const bp::SceneOptions& options) {
  if (std::string other = bp::other_scene_hint(scenes, tileset, options); !other.empty()) return other;
  const auto contents = bp::tileset_level(bp::read_tileset(tileset), tileset, 0).contents;
  return contents.empty() ? "" : bp::fit_hint(contents.front().path);
}

std::string with_claim(const std::string& text, bp::Contract claim, bool json) {
  const bool is_of_tileset = claim == bp::Contract::tile;  // all contents together claim the rest
  if (!json) return bp::claim_line(claim) + text + (is_of_tileset ? "" : bp::unclaimed_line(claim));
  bp::Json verdict = bp::Json::parse(text);
  verdict["contract"] = name_of(claim);
  return verdict.dump(2) + "\n";
}

/// Answers for a file that claims nothing.
int tell_no_claim(const bp::CheckRun& o) {
  bp::Report report("bpcheck");
  bp::print(
      o.json ? bp::Json{{"holds", false}, {"answer", to_string(bp::Answer::undecided)}, {"contract", nullptr}}.dump(2) +
                   "\n"
             : bp::no_claim_line(o.files.back()));
  report.counts = {{"holds", false}, {"answer", to_string(bp::Answer::undecided)}};
  report.write(o.common);
  return status_of(bp::Answer::undecided);
}

/// Checks a tileset: many proxies, and the tree that holds them together.
int run_tileset(const bp::CheckRun& o) {
  refuse_for_tileset(o);
  bp::Report report("bpcheck");
  report.begin("check");
  bp::SceneOptions options{o.format, o.common.memory_bytes / 4, o.common.temp};
  options.keep_extremes = options.keep_degenerate = true;
  options.document = bp::document_budget(o.common.memory_bytes, bp::kMeshProgram, 2);
  bp::SceneOptions of_tileset = options;
  of_tileset.document = bp::part_of(bp::document_budget(o.common.memory_bytes, bp::kMeshProgram, 1), 0.5);
  std::vector<std::string> scenes(o.files.begin(), o.files.end() - 1);
  const bp::Tileset tileset = bp::read_tileset(o.files.back(), of_tileset);
  std::optional<bp::Contract> claim;
  if (o.claimed) {
    claim = bp::told_contract(tileset, o.files.back());
    if (!claim) return tell_no_claim(o);
    if (claim == bp::Contract::fit)
      scenes.clear();
    else if (scenes.empty())
      bp::fail(bp::ErrorCode::bad_argument, "{}: its contents claim that {}; name the scene before it",
               bp::file_name(o.files.back()), claim_of(*claim));
  }
  bp::check_outputs();  // the contents and the scene are read now, which may take long
  const bp::TilesetVerdict verdict =
      bp::check_tileset_file(tileset, o.files.back(), scenes, options, o.common.memory_bytes / 2, o.part);
  const std::string name = bp::file_name(o.files.back());
  const std::string text = o.json ? verdict.json(name) : verdict.text(name);
  bp::print(claim ? with_claim(text, *claim, o.json) : text);
  if (verdict.answer() == bp::Answer::refuted && verdict.scene)
    note_hint(report, o, tileset_hint(scenes, o.files.back(), options));
  if (verdict.answer() == bp::Answer::undecided && verdict.scene_counts.rounding.any())
    note_hint(report, o, bp::rounded_hint(scenes.front()));
  report.bytes_in = bp::size_of_files(o.files);
  report.counts = {{"holds", verdict.holds()}, {"answer", to_string(verdict.answer())}, {"part", verdict.part_json()},
                   {"tiles", verdict.tiles},   {"contents", verdict.contents},          {"findings", verdict.findings}};
  report.write(o.common);
  return status_of(verdict.answer());
}

/// Returns whether the answers about enclosure hold, or with --inside about lying inside.
bool answers_hold(const bp::CheckRun& o, const std::vector<bp::CheckReport>& verdicts) {
  return o.files.size() < 2 || std::all_of(verdicts.begin(), verdicts.end(), [&](const bp::CheckReport& v) {
           return o.inside ? v.inside() || v.holds() : v.encloses();
         });
}

/// Checks each level as a proxy of its own.
std::vector<bp::CheckReport> check(const bp::CheckRun& o, const std::vector<bp::IndexedMesh>& levels,
                                   bp::TriangleSource* scene, const std::optional<bp::HidingQuestion>& hidden,
                                   std::uint64_t scene_bytes) {
  bp::CheckOptions options;
  options.max_examples = kExamples;
  options.inside = o.inside;
  options.hidden = hidden;
  options.convex = o.convex;
  options.scene_memory_bytes = scene_bytes;
  bp::Progress progress("bpcheck", o.common.progress);
  std::unique_ptr<bp::WatchedSource> watched;
  if (scene != nullptr) {
    watched = std::make_unique<bp::WatchedSource>(*scene, progress);
    progress.begin("measure the scene", 0, "triangles");
    options.margin_world = bp::margin_world(o.margin, *watched);
  }
  progress.begin("check", 0, "triangles");
  std::vector<bp::CheckReport> verdicts;
  const std::string unknown = bp::unknown_axes(o.files);
  for (const bp::IndexedMesh& level : levels) {
    verdicts.push_back(bp::check_proxy(level, watched.get(), options));
    bp::CheckReport& verdict = verdicts.back();
    bp::refuse_empty_scene(verdict);
    if (watched == nullptr) continue;
    verdict.place_unknown = unknown;
    if (unknown.empty() && !o.inside && verdict.enclosure() == bp::Answer::refuted)
      verdict.place_unknown = bp::missing_axes(o.files, level, verdict.scene_bounds, watched->up());
  }
  progress.end();
  return verdicts;
}

/// Returns whether the proxy fails as one surface as convex parts do: they intersect, or share vertices or edges.
bool parts_meet(const bp::CheckRun& o, const std::vector<bp::CheckReport>& verdicts) {
  if (o.convex || o.inside) return false;
  return std::any_of(verdicts.begin(), verdicts.end(), [](const bp::CheckReport& v) {
    return v.components > 1 && (v.self_intersections.count > 0 || !v.manifold());
  });
}

/// Returns whether several convex parts are there. It serves a hint only, so only small proxies are tested: physics
/// engines take no others.
bool has_convex_parts(const std::vector<bp::IndexedMesh>& levels) {
  constexpr std::size_t kMostTriangles = 20000;
  bp::CheckOptions options;
  options.convex = true;
  options.distances = false;
  return std::all_of(levels.begin(), levels.end(), [&](const bp::IndexedMesh& level) {
    return level.triangles.size() <= kMostTriangles && bp::check_proxy(level, nullptr, options).holds();
  });
}

/// Returns the question how the proxy is hidden, if its file says how.
bp::Walls walls_of(const bp::CheckRun& o, const std::vector<std::string>& scenes, bp::SceneOptions options) {
  if (!o.inside || std::count(scenes.begin(), scenes.end(), "-") > 0) return {};  // stdin cannot be read again
  return bp::walls_of(bp::extras_of(o.files.back()), [&](bool opaque_only) {
    options.walls_only = opaque_only;
    return bp::open_scenes(scenes, options);
  });
}

/// Reads the levels of the proxy. Their memory is subtracted from the budget.
std::vector<bp::IndexedMesh> read_proxy(const std::string& proxy, const std::vector<std::string>& scenes,
                                        const bp::SceneOptions& options, bp::CheckBudget& budget) {
  try {
    std::vector<bp::IndexedMesh> levels = bp::read_levels(proxy, options);
    budget.take(levels);
    return levels;
  } catch (const bp::NeedsMemory& e) {
    budget.refuse_proxy(e, scenes, options);
  }
}

int run_mesh(const bp::CheckRun& o, const std::optional<bp::Contract>& claim = {}) {
  bp::Report report("bpcheck");
  report.begin("read the proxy");
  bp::CheckBudget budget(o.common.memory_bytes, o.files.size() - 1);
  bp::SceneOptions scene_options = budget.of_proxy();
  scene_options.format = o.format;
  scene_options.temp_dir = o.common.temp;
  const std::vector<std::string> scenes(o.files.begin(), o.files.end() - 1);
  std::vector<bp::IndexedMesh> levels = read_proxy(o.files.back(), scenes, scene_options, budget);
  scene_options.memory_bytes = budget.reader_bytes();
  scene_options.document = budget.of_scene_document();
  const bp::Vec3d origin = origin_of(o, report);
  for (const std::string& note : bp::place_notes(o.files, levels.front().up)) report.note(note, o.common);
  for (bp::IndexedMesh& level : levels) bp::add_origin(level, origin);
  std::unique_ptr<bp::TriangleSource> scene;
  scene_options.keep_degenerate = true;  // degenerate triangles have a place, and may close the scene
  if (!scenes.empty()) scene = bp::open_scenes(scenes, scene_options);
  const bp::Walls walls = walls_of(o, scenes, scene_options);

  bp::check_outputs();  // the scene is read now, which may take long
  report.begin("check");
  const std::vector<bp::CheckReport> verdicts = check(o, levels, scene.get(), walls.question, budget.of_scene().bytes);
  const std::string name = bp::file_name(o.files.back());
  std::string text = o.json ? bp::verdict_json(verdicts, name) : bp::verdict_text(verdicts, name);
  if (claim) text = with_claim(text, *claim, o.json);
  bp::print(text);
  report.bytes_out = text.size();
  fill_report(report, o, origin, verdicts);
  if (parts_meet(o, verdicts)) note_hint(report, o, bp::convex_hint(o.files.back(), has_convex_parts(levels)));
  note_hint(report, o, bp::memory_hint(verdicts, budget.of_scene()));
  std::string hint = bp::rounding_hint(o.files.front(), o.files.back(), verdicts);
  if (hint.empty() && !answers_hold(o, verdicts)) {
    if (answer_of(verdicts) == bp::Answer::refuted) hint = bp::other_scene_hint(scenes, o.files.back(), scene_options);
    if (hint.empty()) hint = bp::enclosure_hint(o.files.front(), o.files.back(), o.inside);
  }
  note_hint(report, o, hint.empty() ? bp::look_hint(o.files, o.format, origin, verdicts) : hint);
  report.write(o.common);
  return status_of(answer_of(verdicts));
}

/// Asks whether the file's own claim holds.
int run_claimed(const bp::CheckRun& o) {
  const std::optional<bp::Contract> claim = bp::told_contract(o.files.back());
  return claim ? run_mesh(bp::asking_for(*claim, o), claim) : tell_no_claim(o);
}

int run(const bp::CheckRun& o) {
  if (bp::is_tileset(o.files.back())) return run_tileset(o);
  return o.claimed ? run_claimed(o) : run_mesh(o);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpcheck", argc, argv, bp::parse_check_run, run);
}
