// bpdeform: binds a scene to a cage, and moves it as the cage is moved. Manual: docs/bpdeform.1.md
#include <set>

#include "io/files/file.h"
#include "io/files/lower.h"
#include "io/scene/scene_format.h"
#include "lib/core/error.h"
#include "tools/cli/output_name.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/deform/apply.h"
#include "tools/deform/bind.h"
#include "tools/deform/least_limit.h"
#include "tools/run/make_backend.h"
#include "tools/run/scene_budget.h"

namespace {

using bp::CoordinateKind;
using bp::ErrorCode;
using bp::fail;

constexpr double kMostPerSecond = 1000;

enum class Outside { refuse, near };

struct Options {
  bp::CommonOptions common;
  std::string command, out;
  std::vector<std::string> files;
  Outside outside = Outside::refuse;
  CoordinateKind kind = CoordinateKind::mean_value;
  double per_second = 0;  // 0: a scene for each cage
};

void check(const Options& o, bp::Args& args) {
  if (o.command != "bind" && o.command != "apply") fail(ErrorCode::bad_argument, "begin with a command: bind or apply");
  if (o.command == "bind" && o.files.size() != 2)
    fail(ErrorCode::bad_argument, "bind takes two files: the scene and the cage");
  if (o.command == "apply" && o.files.size() < 2)
    fail(ErrorCode::bad_argument, "apply takes the weights and one moved cage or more");
  if (args.given("--animate") && (o.command == "bind" || !(o.per_second > 0 && o.per_second <= kMostPerSecond)))
    fail(ErrorCode::bad_argument, "--animate belongs to apply, and takes a number above 0, up to {}", kMostPerSecond);
  if (o.out.empty()) fail(ErrorCode::bad_argument, "name the output with --output");
  if (o.command == "bind") bp::check_weights_name(o.out);
  for (const char* option : {"--outside", "--coordinates", "--device"}) {
    if (o.command == "apply" && args.given(option)) fail(ErrorCode::bad_argument, "{} belongs to bind", option);
  }
  if (std::find(o.files.begin(), o.files.end(), "-") != o.files.end())
    fail(ErrorCode::bad_argument, "bpdeform reads files, not stdin: apply reads the scene again");
}

Options parse(bp::Args& args) {
  Options o;
  args.about(
      "Moves a scene by a cage. `bind SCENE CAGE` finds out how each vertex of the scene depends on the cage. `apply "
      "WEIGHTS CAGE2` writes the scene again, as the moved cage carries it.");
  args.example(
      "bpdeform bind figure.obj cage.obj -o figure.bpw && bpdeform apply figure.bpw posed.obj -o posed_figure.obj");
  args.positional("COMMAND", o.command, "bind or apply");
  args.positional("[FILE...]", o.files,
                  "a scene (OBJ, PLY, glTF) and its cage, to bind; or weights and moved cages, to apply");
  args.group("Files");
  args.option("-o,--output", "FILE", o.out, "the weights, or the moved scene in the format of the scene");
  args.needed("--output");
  args.group("Binding");
  args.option(
      "--coordinates",
      {{"mean-value", CoordinateKind::mean_value, "smooth, and exact for stretch and shear"},
       {"green", CoordinateKind::green, "keep shapes: angles hardly change; the scene may leave the cage"},
       {"maximum-likelihood", CoordinateKind::maximum_likelihood, "as mean-value, and nothing moves against the cage"}},
      o.kind, "how vertices follow the cage");
  args.option("--outside",
              {{"refuse", Outside::refuse, "an error that tells their number"},
               {"near", Outside::near, "they follow the nearest face"}},
              o.outside, "vertices outside the cage");
  args.group("Applying");
  args.option("--animate", "NUMBER", o.per_second,
              "one glTF that moves from each cage to the next, so many cages a second");
  o.common.add_to(args, bp::CommonOptions::threads_part | bp::CommonOptions::memory_part |
                            bp::CommonOptions::device_part | bp::CommonOptions::progress_part |
                            bp::CommonOptions::report_part | bp::CommonOptions::overwrite_part);
  args.often({"--output", "--coordinates", "--outside", "--animate", "--overwrite"});
  args.parse();
  check(o, args);
  bp::keep_inputs(o.files);
  return o;
}

bp::SceneOptions scene_options(const Options& o) {
  constexpr std::uint64_t kBytesPerFace = 32, kBytesPerVertex = 128;  // of a cage while it is read
  bp::SceneOptions options;
  options.temp_dir = o.common.temp;
  options.memory_bytes = o.common.memory_bytes / 4;
  options.keep_extremes = true;
  options.fans = true;  // a cage and its moved copy must have the same triangles
  options.document = bp::document_budget(o.common.memory_bytes, bp::least_memory(o.common.threads), 1);
  bp::MemoryShare cage = options.document;
  cage.bytes /= 2, cage.share /= 2;
  options.mesh = {cage, kBytesPerFace, kBytesPerVertex, "reading the cage"};
  return options;
}

/// Makes a note that is told once, however many poses the same cage is read in.
bp::NoteOfCage note_once(const Options& o, bp::Report& report) {
  return [&, told = std::set<std::string>()](const std::string& text) mutable {
    if (told.insert(text).second) report.note(text, o.common);
  };
}

void bind(const Options& o, bp::Report& report, bp::Progress& progress) {
  const auto output = bp::open_output(o.out, o.common.overwrite);
  bp::Backends backends;
  const auto make_backends = [&](double core_seconds) -> const bp::Backends& {
    return backends = bp::make_backends(o.common, core_seconds, &report);
  };
  const bp::BindRequest request{o.files[0],
                                o.files[1],
                                o.out,
                                o.kind,
                                o.outside == Outside::near,
                                o.common.memory_bytes,
                                scene_options(o),
                                make_backends,
                                note_once(o, report)};
  const bp::WeightTotals totals = bp::naming_limit(
      [&] {
        bp::check_outputs();
        return bp::bind_scene(request, *output, progress);
      },
      [&] { return bp::least_limit(request); });
  report.counts = {{"backends", bp::names_of(backends)}, {"vertices", totals.points}, {"outside", totals.outside}};
  if (totals.outside > 0)
    report.note(fmt::format("vertices outside the cage, which follow its nearest faces: {} of {}", totals.outside,
                            totals.points),
                o.common);
  output->commit();
  report.bytes_in = bp::size_of_files({o.files[0]});
  report.bytes_out = output->bytes();
}

/// Returns the name of scene number i of n. Its number stands before the extension, with as many digits as the last one
/// has.
std::string numbered(const std::string& name, std::size_t i, std::size_t n) {
  if (n == 1) return name;
  const std::size_t dot = name.find_last_of('.');
  return fmt::format("{}.{:0{}}{}", name.substr(0, dot), i, std::to_string(n - 1).size(), name.substr(dot));
}

/// Each scene appears when it is complete; returns how many there are.
std::size_t apply_cages(const Options& o, const bp::ApplyRequest& request, std::span<const bp::MovedCage> cages,
                        bp::Applied& applied, bp::Report& report, bp::Progress& progress) {
  const bool animate = o.per_second > 0;
  const std::size_t scenes = animate ? 1 : cages.size();
  for (std::size_t i = 0; i < scenes; ++i) {
    const auto output = bp::open_output(numbered(o.out, i, scenes), o.common.overwrite);
    applied = animate ? bp::animate_cages(request, cages, o.per_second, *output, progress)
                      : bp::apply_cage(request, cages[i], *output, progress);
    output->commit();
    report.bytes_out += output->bytes();
  }
  return scenes;
}

void apply(const Options& o, bp::Report& report, bp::Progress& progress) {
  const std::string scene = bp::scene_of(bp::WeightReader(o.files[0]), o.files[0]);
  bp::keep_inputs({scene});
  const std::string format = bp::scene_format_of(scene);
  if (o.per_second > 0 && format != "gltf" && format != "glb")
    fail(ErrorCode::bad_argument,
         "{}: only a glTF holds an animation: bind the scene as a glTF, or leave out --animate for a file of each cage",
         scene);
  if (bp::scene_format_of(o.out) != format)
    fail(ErrorCode::bad_argument, "{}: the scene is written in its own format: name it .{}", o.out, format);
  const bool animate = o.per_second > 0;
  const std::span<const std::string> files = std::span(o.files).subspan(1);
  const bp::ApplyRequest request{o.files[0], scene, o.common.memory_bytes, scene_options(o), note_once(o, report)};
  std::vector<bp::MovedCage> cages;
  bp::Applied applied;
  const std::size_t scenes = bp::naming_limit(
      [&] {
        bp::check_outputs();
        cages = bp::moved_cages(files, request.scene_options, animate ? std::optional(o.per_second) : std::nullopt);
        return apply_cages(o, request, cages, applied, report, progress);
      },
      [&] { return bp::least_limit(request, files, animate ? std::max(cages.size(), files.size()) : 0); });
  report.counts = {{"vertices", applied.points}, {"scenes", scenes}};
  std::string written = numbered(o.out, 0, scenes);
  if (scenes > 1) {
    written += " to " + numbered(o.out, scenes - 1, scenes);
    report.note(fmt::format("{} scenes are written: {}", scenes, written), o.common);
  }
  if (!applied.left_behind.empty()) report.note(fmt::format("{}: {}", written, applied.left_behind), o.common);
  if (const std::string text = bp::files_left(scene, numbered(o.out, 0, scenes)); !text.empty())
    report.note(written + ": " + text, o.common);
  report.bytes_in = bp::size_of_files({scene});
}

void run(const Options& o) {
  bp::Report report("bpdeform");
  bp::Progress progress("bpdeform", o.common.progress);
  report.begin(o.command);
  if (o.command == "bind") {
    bind(o, report, progress);
  } else {
    apply(o, report, progress);
  }
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpdeform", argc, argv, parse, run);
}
