// bpcheck: scene and proxy in, verdict out. Manual: docs/bpcheck.1.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/image/label_font.h"
#include "io/image/png_writer.h"
#include "io/scene/scene_reader.h"
#include "io/tiles/tileset_file.h"
#include "io/tiles/tileset_level.h"
#include "lib/check/check_proxy.h"
#include "lib/check/verdict_text.h"
#include "lib/core/error.h"
#include "tools/check/check_budget.h"
#include "tools/check/check_picture.h"
#include "tools/check/hiding_recipe.h"
#include "tools/check/hints.h"
#include "tools/check/tileset_verdict.h"
#include "tools/cli/names.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/notes/panel_label.h"
#include "tools/run/grounded_source.h"
#include "tools/run/inputs.h"
#include "tools/run/origin.h"
#include "tools/run/scene_budget.h"

namespace {

constexpr std::uint64_t kExamples = 5, kSamples = 5000;

struct Options {
  bp::CommonOptions common;
  std::vector<std::string> files;  // scenes, then the proxy
  std::string format;
  bool json = false, no_distances = false, inside = false, convex = false;
  std::optional<std::uint64_t> examples, samples;
  bp::ImageOptions image;
  std::optional<bp::Vec3d> origin;
};

Options parse(bp::Args& args) {
  Options o;
  args.about(
      "Proves that a proxy is closed, oriented, 2-manifold, free of self-intersections and strictly encloses its "
      "scenes, or says where not. Exact for the coordinates as read. Exit status: 0 all holds, 1 something does not, 5 "
      "not decided.");
  args.positional("[SCENE...] PROXY", o.files, "scenes and their proxy; PROXY alone is checked as a mesh");
  args.option("--format", "NAME", o.format, "format of a file that is -, or whose name does not tell");
  args.option(
      "--origin", "X,Y,Z", o.origin,
      "add this point to every vertex of the proxy, exactly: what --origin of bpmesh or bplod subtracted (default: "
      "what the proxy says)");
  args.flag("--inside", o.inside, "prove that the proxy lies strictly inside the scenes, not around them");
  args.flag("--convex", o.convex,
            "PROXY is of convex parts that may overlap: prove that they are, and that together they cover the scene");
  args.flag("--json", o.json, "print the verdict as JSON");
  args.option("--examples", "N", o.examples, "places named per kind of failure (default: 5)");
  args.flag("--no-distances", o.no_distances, "leave the sampled distances out");
  args.option("--samples", "N", o.samples, "triangles sampled for distances, on either side (default: 5000)");
  o.image.add_to(args, "draw scene and proxy side by side as PNG",
                 "axis that points up in the image (default: y, or what the proxy or scene tells)");
  o.common.add_to(args, bp::CommonOptions::all_parts & ~unsigned(bp::CommonOptions::device_part));
  args.example("bpcheck scene.glb proxy.glb --image both.png");
  args.parse();
  o.image.check(args);
  args.excludes("--samples", "--no-distances");
  args.excludes("--samples", "--inside");  // measures none
  args.excludes("--samples", "--convex");
  args.excludes("--convex", "--inside");
  bp::check_scene_format(o.format, o.files);
  bp::check_stdin_once(o.files);
  bp::keep_inputs(o.files);
  bp::check_panel_size(o.image.panel_size, o.files.size() > 1 ? 2 : 1);
  if (o.samples && o.files.size() < 2)
    bp::fail(bp::ErrorCode::bad_argument, "--samples means nothing without a scene; leave it out");
  if (o.inside && o.files.size() < 2)
    bp::fail(bp::ErrorCode::bad_argument, "--inside asks for a scene around the proxy; name it before the proxy");
  return o;
}

/// Undoes --origin of bpmesh and bplod. An answer for rounded vertices would be one for another proxy, so rounding is
/// refused.
void move(bp::IndexedMesh& mesh, const bp::Vec3d& by) {
  if (by == bp::Vec3d{}) return;
  for (bp::Vec3d& p : mesh.vertices) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double sum = p[i] + by[i], part = sum - by[i];
      if (std::isfinite(sum) && (sum - part != by[i] || part != p[i])) {
        bp::fail(bp::ErrorCode::bad_argument,
                 "--origin: {} + {} is no exact double; give the origin that bpmesh or bplod was given", p[i], by[i]);
      }
      p[i] = sum;
    }
  }
}

/// Counts what passes through, and bounds it.
class WatchedSource : public bp::TriangleSource {
 public:
  WatchedSource(bp::TriangleSource& source, bp::Progress& progress) : source_(source), progress_(progress) {}
  bool read(std::vector<bp::TriangleD>& out) override {
    const bool more = source_.read(out);
    progress_.add(out.size());
    for (const bp::TriangleD& t : out) {
      for (const bp::Vec3d& p : t) bounds_.add(p);
    }
    return more;
  }
  [[nodiscard]] const bp::Bounds3d& bounds() const { return bounds_; }  ///< of all that was read
  void rewind() override { source_.rewind(); }
  [[nodiscard]] const bp::SceneCounts& counts() const override { return source_.counts(); }
  [[nodiscard]] std::string name() const override { return source_.name(); }

 private:
  bp::TriangleSource& source_;
  bp::Progress& progress_;
  bp::Bounds3d bounds_;
};

bp::Json counts_of(const bp::CheckReport& verdict) {
  return {{"holds", verdict.holds()},
          {"answer", to_string(verdict.answer())},
          {"proxy_triangles", verdict.triangles},
          {"scene_triangles", verdict.scene_triangles},
          {"self_intersections", verdict.self_intersections.count},
          {"touching", verdict.touching.count},
          {"outside", verdict.outside.count}};
}

/// What --origin says, or else the proxy, which is noted.
bp::Vec3d origin_of(const Options& o, bp::Report& report) {
  if (o.origin) return *o.origin;
  const std::vector<std::string> scenes(o.files.begin(), o.files.end() - 1);
  const std::optional<bp::Vec3d> told = bp::told_origin(scenes, o.files.back());
  if (!told || *told == bp::Vec3d{}) return {};
  report.note(fmt::format("{} says that {} was subtracted from it, which is added back", bp::file_name(o.files.back()),
                          bp::origin_text(*told)),
              o.common);
  return *told;
}

void fill_report(bp::Report& report, const Options& o, const bp::Vec3d& origin,
                 const std::vector<bp::CheckReport>& verdicts) {
  report.options = {{"inside", o.inside},
                    {"convex", o.convex},
                    {"origin", origin},
                    {"distances", !o.no_distances},
                    {"samples", o.samples.value_or(kSamples)},
                    {"examples", o.examples.value_or(kExamples)}};
  report.counts = counts_of(verdicts[0]);
  if (verdicts.size() > 1) {
    const bp::Answer answer = answer_of(verdicts);
    report.counts = {
        {"holds", answer == bp::Answer::proven}, {"answer", to_string(answer)}, {"levels", bp::Json::array()}};
    for (const bp::CheckReport& verdict : verdicts) report.counts["levels"].push_back(counts_of(verdict));
  }
  if (!verdicts[0].distance_note.empty()) report.notes.push_back(verdicts[0].distance_note);
}

/// An answer to another question than was asked would be none.
void refuse_for_tileset(const Options& o) {
  const std::pair<const char*, bool> refused[] = {{"--inside", o.inside},
                                                  {"--convex", o.convex},
                                                  {"--origin", o.origin.has_value()},
                                                  {"--image", !o.image.file.empty()},
                                                  {"--no-distances", o.no_distances},
                                                  {"--samples", o.samples.has_value()},
                                                  {"--examples", o.examples.has_value()}};
  for (const auto& [option, given] : refused) {
    if (given) bp::fail(bp::ErrorCode::bad_argument, "{}: is for meshes; leave it out for a tileset", option);
  }
}

void note_hint(bp::Report& report, const Options& o, const std::string& hint) {
  if (!hint.empty()) report.note(hint, o.common);
}

/// Exit status (docs/exit-codes.md).
int status_of(bp::Answer answer) {
  constexpr int kProven = 0, kRefuted = 1, kUndecided = 5;
  return answer == bp::Answer::proven ? kProven : answer == bp::Answer::refuted ? kRefuted : kUndecided;
}

/// A tileset is many proxies and what holds them together.
int run_tileset(const Options& o) {
  refuse_for_tileset(o);
  bp::Report report("bpcheck");
  report.stage("check");
  bp::SceneOptions options{o.format, o.common.memory_bytes / 4, o.common.temp};
  options.keep_extremes = true;
  options.document = bp::document_budget(o.common.memory_bytes, std::uint64_t(48) << 20, 2);
  const std::vector<std::string> scenes(o.files.begin(), o.files.end() - 1);
  const bp::TilesetVerdict verdict = bp::check_tileset_file(o.files.back(), scenes, options, o.common.memory_bytes / 2);
  const std::string name = bp::file_name(o.files.back());
  bp::print(o.json ? verdict.json(name) : verdict.text(name));
  const auto contents = bp::tileset_level(bp::read_tileset(o.files.back()), o.files.back(), 0).contents;
  if (!verdict.holds() && verdict.scene && !contents.empty()) note_hint(report, o, bp::fit_hint(contents.front().path));
  report.counts = {{"holds", verdict.holds()},
                   {"answer", to_string(verdict.answer())},
                   {"tiles", verdict.tiles},
                   {"findings", verdict.findings}};
  report.write(o.common);
  return status_of(verdict.answer());
}

/// Whatever is asked of no triangle holds: an export that went wrong must not prove a proxy.
void refuse_empty_scene(const bp::CheckReport& verdict) {
  const bp::SceneCounts& c = verdict.scene_counts;
  if (verdict.scene_name.empty() || verdict.scene_triangles > 0) return;
  bp::fail(
      bp::ErrorCode::bad_input,
      "{}: no triangles ({} degenerate, {} non-finite, {} bad faces skipped); a scene needs at least one with an area",
      verdict.scene_name, c.degenerate, c.non_finite, c.bad_faces);
}

/// Of enclosure, or with --inside of its opposite.
bool answers_hold(const Options& o, const std::vector<bp::CheckReport>& verdicts) {
  return o.files.size() < 2 || std::all_of(verdicts.begin(), verdicts.end(), [&](const bp::CheckReport& v) {
           return o.inside ? v.inside() || v.holds() : v.encloses();
         });
}

/// Each level as a proxy of its own. scene_bounds: out.
std::vector<bp::CheckReport> check(const Options& o, const std::vector<bp::IndexedMesh>& levels,
                                   bp::TriangleSource* scene, const std::optional<bp::HidingQuestion>& hidden,
                                   std::uint64_t scene_bytes, bp::Bounds3d& scene_bounds) {
  bp::CheckOptions options;
  options.max_examples = o.examples.value_or(kExamples);
  options.inside = o.inside;
  options.hidden = hidden;
  options.convex = o.convex;
  options.distances = !o.no_distances;
  options.distance_samples = o.samples.value_or(kSamples);
  options.scene_memory_bytes = scene_bytes;
  bp::Progress progress("bpcheck", o.common.progress);
  progress.begin("check", 0, "triangles");
  std::unique_ptr<WatchedSource> watched;
  if (scene != nullptr) watched = std::make_unique<WatchedSource>(*scene, progress);
  std::vector<bp::CheckReport> verdicts;
  for (const bp::IndexedMesh& level : levels) {
    verdicts.push_back(bp::check_proxy(level, watched.get(), options));
    refuse_empty_scene(verdicts.back());
  }
  progress.end();
  if (watched) scene_bounds = watched->bounds();
  return verdicts;
}

/// What the proxy's file says that it is hidden by, if it says so; `walls` opens the scene for it.
std::optional<bp::HidingQuestion> hiding_question(const Options& o, const std::vector<std::string>& scenes,
                                                  bp::SceneOptions options,
                                                  std::unique_ptr<bp::TriangleSource>& walls) {
  if (!o.inside || std::count(scenes.begin(), scenes.end(), "-") > 0) return {};  // stdin cannot be read again
  const std::optional<bp::OccluderRecipe> recipe = bp::hiding_recipe(o.files.back());
  if (!recipe) return {};
  options.walls_only = true;
  options.keep_degenerate = false;
  walls = bp::open_scenes(scenes, options);
  if (recipe->ground) walls = std::make_unique<bp::GroundedSource>(std::move(walls), recipe->up);
  return bp::HidingQuestion{recipe->hiding, walls.get()};
}

int run(const Options& o) {
  if (bp::is_tileset(o.files.back())) return run_tileset(o);
  bp::Report report("bpcheck");
  report.stage("read the proxy");
  std::unique_ptr<bp::OutputFile> picture;  // opened first: a name that cannot be written fails before the work
  if (!o.image.file.empty()) picture = bp::open_output(o.image.file, o.common.overwrite);
  bp::CheckBudget budget(o.common.memory_bytes, o.files.size() > 1);
  bp::SceneOptions scene_options = budget.of_proxy();
  scene_options.format = o.format;
  scene_options.temp_dir = o.common.temp;
  std::vector<bp::IndexedMesh> levels = bp::read_levels(o.files.back(), scene_options);
  budget.take(levels);
  scene_options.memory_bytes = budget.reader_bytes();
  if (picture) bp::check_panel_size(o.image.panel_size, levels.size() + (o.files.size() > 1 ? 1 : 0));
  const bp::Vec3d origin = origin_of(o, report);
  for (bp::IndexedMesh& level : levels) move(level, origin);
  std::unique_ptr<bp::TriangleSource> scene;
  scene_options.keep_degenerate = o.inside;  // they may be what closes the scene
  const std::vector<std::string> scenes(o.files.begin(), o.files.end() - 1);
  if (!scenes.empty()) scene = bp::open_scenes(scenes, scene_options);
  std::unique_ptr<bp::TriangleSource> walls;
  const std::optional<bp::HidingQuestion> hidden = hiding_question(o, scenes, scene_options, walls);

  report.stage("check");
  bp::Bounds3d scene_bounds;
  const std::vector<bp::CheckReport> verdicts =
      check(o, levels, scene.get(), hidden, budget.scene_bytes(), scene_bounds);
  if (picture) {
    report.stage("draw");
    const auto typeface = bp::open_label_font();
    if (const std::string note = bp::note_on_font(typeface.get()); !note.empty()) report.note(note, o.common);
    const bp::CheckedFiles checked{o.files, levels, verdicts, scene.get(), scene_bounds};
    picture->write(bp::encode_png(bp::draw_checked(checked, o.image, typeface.get())));
    picture->commit();
  }
  const std::string name = bp::file_name(o.files.back());
  const std::string text = o.json ? bp::verdict_json(verdicts, name) : bp::verdict_text(verdicts, name);
  bp::print(text);
  report.bytes_out = text.size();
  fill_report(report, o, origin, verdicts);
  if (!answers_hold(o, verdicts)) note_hint(report, o, bp::enclosure_hint(o.files.front(), o.files.back(), o.inside));
  report.write(o.common);
  return status_of(answer_of(verdicts));
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpcheck", argc, argv, parse, run);
}
