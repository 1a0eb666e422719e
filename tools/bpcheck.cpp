// bpcheck: scene and proxy in, verdict out. Manual: docs/bpcheck.1.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/png_writer.h"
#include "io/scene_reader.h"
#include "io/tileset_file.h"
#include "io/tileset_level.h"
#include "lib/check/check_proxy.h"
#include "lib/check/verdict_text.h"
#include "lib/core/error.h"
#include "lib/image/render.h"
#include "tools/check/check_budget.h"
#include "tools/check/hints.h"
#include "tools/check/tileset_verdict.h"
#include "tools/common/inputs.h"
#include "tools/common/names.h"
#include "tools/common/report.h"
#include "tools/common/run_tool.h"

namespace {

constexpr std::uint64_t kExamples = 5, kSamples = 5000;

struct Options {
  bp::CommonOptions common;
  std::vector<std::string> files;  // scenes, then the proxy
  std::string format;
  bool json = false, no_distances = false, inside = false, convex = false;
  std::optional<std::uint64_t> examples, samples;
  std::string image;
  int image_size = 720;
  std::optional<bp::UpAxis> up;
  std::optional<bp::Vec3d> origin;
  double azimuth = 35, elevation = 22;
};

Options parse(bp::Args& args) {
  Options o;
  args.about(
      "Proves that a proxy is closed, oriented, 2-manifold, free of self-intersections and strictly encloses its "
      "scenes, or says where not. Exact for the coordinates as read. Exit status: 0 all holds, 1 not.");
  args.positional("[SCENE...] PROXY", o.files, "scenes and their proxy; PROXY alone is checked as a mesh");
  args.option("--format", "NAME", o.format, "format of a file that is -, or whose name does not tell");
  args.option("--origin", "X,Y,Z", o.origin,
              "add this point to every vertex of the proxy, exactly: what bpmesh --origin subtracted");
  args.flag("--inside", o.inside, "prove that the proxy lies strictly inside the scenes, not around them");
  args.flag("--convex", o.convex,
            "PROXY is of convex parts that may overlap: prove that they are, and that together they cover the scene");
  args.flag("--json", o.json, "print the verdict as JSON");
  args.option("--examples", "N", o.examples, "places named per kind of failure (default: 5)");
  args.flag("--no-distances", o.no_distances, "leave the sampled distances out");
  args.option("--samples", "N", o.samples, "triangles sampled for distances, on either side (default: 5000)");
  args.option("--image", "FILE", o.image, "draw scene and proxy side by side as PNG");
  args.option("--image-size", "PIXELS", o.image_size, "side of a panel of the image");
  args.option("--up", "y|z", o.up, "axis that points up in the image (default: y, or what the proxy or scene tells)");
  args.option("--azimuth", "DEGREES", o.azimuth, "where the viewer stands, from the front to the right");
  args.option("--elevation", "DEGREES", o.elevation, "how far above the horizon the viewer stands");
  o.common.add_to(args, bp::CommonOptions::all_parts & ~unsigned(bp::CommonOptions::device_part));
  args.example("bpcheck scene.glb proxy.glb --image both.png");
  args.parse();
  args.needs({"--image-size", "--up", "--azimuth", "--elevation"}, "--image");
  args.excludes("--samples", "--no-distances");
  args.excludes("--samples", "--inside");  // measures none
  args.excludes("--samples", "--convex");
  args.excludes("--convex", "--inside");
  bp::check_scene_format(o.format, o.files);
  bp::check_stdin_once(o.files);
  bp::keep_inputs(o.files);
  bp::check_panel_size(o.image_size, o.files.size() > 1 ? 2 : 1);
  if (o.samples && o.files.size() < 2)
    bp::fail(bp::ErrorCode::bad_argument, "--samples means nothing without a scene; leave it out");
  if (o.inside && o.files.size() < 2)
    bp::fail(bp::ErrorCode::bad_argument, "--inside asks for a scene around the proxy; name it before the proxy");
  return o;
}

/// Undoes bpmesh --origin. An answer for rounded vertices would be one for another proxy, so rounding is refused.
void move(bp::IndexedMesh& mesh, const bp::Vec3d& by) {
  if (by == bp::Vec3d{}) return;
  for (bp::Vec3d& p : mesh.vertices) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double sum = p[i] + by[i], part = sum - by[i];
      if (std::isfinite(sum) && (sum - part != by[i] || part != p[i])) {
        bp::fail(bp::ErrorCode::bad_argument,
                 "--origin: {} + {} is no exact double; give the origin that bpmesh was given", p[i], by[i]);
      }
      p[i] = sum;
    }
  }
}

/// Counts what passes through.
class WatchedSource : public bp::TriangleSource {
 public:
  WatchedSource(bp::TriangleSource& source, bp::Progress& progress) : source_(source), progress_(progress) {}
  bool read(std::vector<bp::TriangleD>& out) override {
    const bool more = source_.read(out);
    progress_.add(out.size());
    return more;
  }
  void rewind() override { source_.rewind(); }
  [[nodiscard]] const bp::SceneCounts& counts() const override { return source_.counts(); }
  [[nodiscard]] std::string name() const override { return source_.name(); }

 private:
  bp::TriangleSource& source_;
  bp::Progress& progress_;
};

/// The scene, then each level of the proxy.
bp::Image draw(const Options& o, const std::vector<bp::IndexedMesh>& levels, bp::TriangleSource* scene,
               const std::vector<bp::CheckReport>& verdicts) {
  std::vector<bp::View> views;
  if (scene != nullptr) {
    views.emplace_back();
    views[0].source = scene;
    views[0].label = fmt::format("{}\n{} triangles", bp::file_name(o.files[0]), verdicts[0].scene_triangles);
    if (o.files.size() > 2)
      views[0].label.insert(0, fmt::format("{} and {} more: ", bp::file_name(o.files[0]), o.files.size() - 2));
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    bp::View& view = views.emplace_back();
    view.mesh = &levels[i];
    view.edges = true;
    view.color = {238, 192, 130};
    view.label = fmt::format("{}{}\n{} triangles, {}", bp::file_name(o.files.back()),
                             levels.size() > 1 ? fmt::format(" level {}", i) : "", verdicts[i].triangles,
                             verdicts[i].holds() ? "holds" : "does not hold");
  }
  bp::RenderOptions options;
  options.panel_width = options.panel_height = o.image_size;
  options.azimuth = o.azimuth, options.elevation = o.elevation;
  options.up = bp::UpAxis::y;
  if (scene != nullptr && scene->up()) options.up = *scene->up();
  if (levels[0].up) options.up = *levels[0].up;
  if (o.up) options.up = *o.up;
  return bp::render(views, options);
}

bp::Json counts_of(const bp::CheckReport& verdict) {
  return {{"holds", verdict.holds()},
          {"proxy_triangles", verdict.triangles},
          {"scene_triangles", verdict.scene_triangles},
          {"self_intersections", verdict.self_intersections.count},
          {"touching", verdict.touching.count},
          {"outside", verdict.outside.count}};
}

void fill_report(bp::Report& report, const Options& o, const std::vector<bp::CheckReport>& verdicts) {
  report.options = {{"inside", o.inside},
                    {"convex", o.convex},
                    {"origin", o.origin.value_or(bp::Vec3d{})},
                    {"distances", !o.no_distances},
                    {"samples", o.samples.value_or(kSamples)},
                    {"examples", o.examples.value_or(kExamples)}};
  report.counts = counts_of(verdicts[0]);
  if (verdicts.size() > 1) {
    report.counts = {{"holds", bp::all_hold(verdicts)}, {"levels", bp::Json::array()}};
    for (const bp::CheckReport& verdict : verdicts) report.counts["levels"].push_back(counts_of(verdict));
  }
  if (!verdicts[0].distance_note.empty()) report.notes.push_back(verdicts[0].distance_note);
}

/// An answer to another question than was asked would be none.
void refuse_for_tileset(const Options& o) {
  const std::pair<const char*, bool> refused[] = {{"--inside", o.inside},
                                                  {"--convex", o.convex},
                                                  {"--origin", o.origin.has_value()},
                                                  {"--image", !o.image.empty()},
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

/// A tileset is many proxies and what holds them together.
int run_tileset(const Options& o) {
  refuse_for_tileset(o);
  bp::Report report("bpcheck");
  report.stage("check");
  bp::SceneOptions options{o.format, o.common.memory_bytes / 4, o.common.temp};
  options.keep_extremes = true;
  const std::vector<std::string> scenes(o.files.begin(), o.files.end() - 1);
  const bp::TilesetVerdict verdict = bp::check_tileset_file(o.files.back(), scenes, options, o.common.memory_bytes / 2);
  const std::string name = bp::file_name(o.files.back());
  bp::print(o.json ? verdict.json(name) : verdict.text(name));
  const auto contents = bp::tileset_level(bp::read_tileset(o.files.back()), o.files.back(), 0).contents;
  if (!verdict.holds() && verdict.scene && !contents.empty()) note_hint(report, o, bp::fit_hint(contents.front().path));
  report.counts = {{"holds", verdict.holds()}, {"tiles", verdict.tiles}, {"findings", verdict.findings}};
  report.write(o.common);
  return verdict.holds() ? 0 : 1;
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
           return o.inside ? v.inside() : v.encloses();
         });
}

/// Each level as a proxy of its own.
std::vector<bp::CheckReport> check(const Options& o, const std::vector<bp::IndexedMesh>& levels,
                                   bp::TriangleSource* scene, std::uint64_t scene_bytes) {
  bp::CheckOptions options;
  options.max_examples = o.examples.value_or(kExamples);
  options.inside = o.inside;
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
  return verdicts;
}

int run(const Options& o) {
  bp::check_png_name(o.image);
  if (bp::is_tileset(o.files.back())) return run_tileset(o);
  bp::Report report("bpcheck");
  report.stage("read the proxy");
  std::unique_ptr<bp::OutputFile> picture;  // opened first: a name that cannot be written fails before the work
  if (!o.image.empty()) picture = bp::open_output(o.image, o.common.overwrite);
  bp::CheckBudget budget(o.common.memory_bytes, o.files.size() > 1);
  bp::SceneOptions scene_options = budget.of_proxy(o.files.back());
  scene_options.format = o.format;
  scene_options.temp_dir = o.common.temp;
  std::vector<bp::IndexedMesh> levels = bp::read_levels(o.files.back(), scene_options);
  budget.take(levels);
  scene_options.memory_bytes = budget.reader_bytes();
  if (picture) bp::check_panel_size(o.image_size, levels.size() + (o.files.size() > 1 ? 1 : 0));
  for (bp::IndexedMesh& level : levels) move(level, o.origin.value_or(bp::Vec3d{}));
  std::unique_ptr<bp::TriangleSource> scene;
  scene_options.keep_degenerate = o.inside;  // they may be what closes the scene
  if (o.files.size() > 1) scene = bp::open_scenes({o.files.begin(), o.files.end() - 1}, scene_options);

  report.stage("check");
  const std::vector<bp::CheckReport> verdicts = check(o, levels, scene.get(), budget.scene_bytes());
  if (picture) {
    report.stage("draw");
    picture->write(bp::encode_png(draw(o, levels, scene.get(), verdicts)));
    picture->commit();
  }
  const std::string name = bp::file_name(o.files.back());
  const std::string text = o.json ? bp::verdict_json(verdicts, name) : bp::verdict_text(verdicts, name);
  bp::print(text);
  report.bytes_out = text.size();
  fill_report(report, o, verdicts);
  if (!answers_hold(o, verdicts))
    note_hint(report, o, bp::enclosure_hint(o.files.front(), o.files.back(), o.inside, o.origin.has_value()));
  report.write(o.common);
  return bp::all_hold(verdicts) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpcheck", argc, argv, parse, run);
}
