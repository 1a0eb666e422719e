// bpclose: solid bricks in, solid and closing out. Manual: docs/bpclose.1.md
#include <optional>

#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/pass/close/close_pass.h"
#include "tools/cli/names.h"
#include "tools/cli/options/closing.h"
#include "tools/cli/output_name.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/notes/estimate.h"
#include "tools/notes/proportion.h"
#include "tools/pipe/close_step.h"
#include "tools/run/make_backend.h"
#include "tools/run/scale_rules.h"

namespace {

using bp::ErrorCode;
using bp::fail;

struct Options {
  bp::CommonOptions common;
  std::string in = "-", out = "-", field;
  bp::ClosingOptions closing;
  bool keep_cavities = false;
};

Options parse(bp::Args& args) {
  Options o;
  args.about(
      "Closes a stream of voxels: gaps, holes and grooves narrower than the scale are filled. A stream of bpvox --fill "
      "inside is opened instead: parts narrower than the scale are removed, nothing is added.");
  args.example("bpvox scene.glb --resolution 256 | bpclose --scale 2% | bpmesh --faces 1000 -o proxy.glb");
  args.positional("INPUT", o.in, "stream of voxels; - is stdin");
  args.group("Files");
  args.option("-o,--output", "FILE", o.out, "stream of voxels, with the closing; - is stdout");
  o.closing.add_to(args, "", " (default: that of bpscale, else 2%)");
  o.closing.add_element(args);
  args.option("--field", "FILE", o.field,
              "rules for scales that differ from place to place (bpscale(1)), instead of --scale");
  args.removed("--tile", "bpclose chooses the tiles by --memory");
  args.flag("--keep-cavities", o.keep_cavities, "leave hollows empty that the closing cuts off from the outside");
  args.removed("--inner", "a stream of bpvox --fill inside is opened without it");
  o.common.add_to(args);
  args.often({"--output", "--scale", "--element", "--overwrite"});
  args.parse();
  bp::check_stream_name(o.out);
  bp::keep_inputs({o.in});
  if (!o.field.empty()) bp::keep_inputs({o.field});
  if (o.closing.scale && !o.field.empty()) fail(ErrorCode::bad_argument, "--scale and --field exclude each other");
  return o;
}

/// Returns the plan of the options, or the field that bpscale gave the stream.
bp::ScalePlan scale_plan(const Options& o, bp::RuledSource& source) {
  const bp::StreamHeader& header = source.header();
  if (header.has_field && (o.closing.scale || !o.field.empty()))
    fail(ErrorCode::bad_argument,
         "{0}: bpscale gave the stream a field, which says the scales; leave out {0}, or close the stream that bpscale "
         "read",
         o.closing.scale ? "--scale" : "--field");
  if (!o.field.empty()) return source.read_rules(bp::read_rules_text(o.field));
  return bp::plan_without_rules({o.closing, o.keep_cavities}, header);
}

void fill_report(bp::Report& report, const bp::Backends& backends, const bp::CloseCounts& counts) {
  report.counts = {{"backends", bp::names_of(backends)},
                   {"tile_vox", counts.tile_vox},
                   {"tiles", counts.tiles},
                   {"tiles_closed", counts.tiles_closed},
                   {"halo_vox", counts.halo_vox},
                   {"solid_bricks", counts.solid_bricks},
                   {"closing_bricks", counts.closing_bricks},
                   {"cavity_voxels", counts.cavity_voxels}};
  const bp::CloseTimes& t = counts.seconds;
  report.counts["thread_seconds"] = {{"reading", t.reading},     {"waiting", t.waiting},   {"closing", t.closing},
                                     {"labelling", t.labelling}, {"shelving", t.shelving}, {"filling", t.filling},
                                     {"writing", t.writing}};
  if (counts.ignored_bricks > 0) report.notes.push_back("the input's closing layer was made anew from its solid layer");
}

/// Refuses options that make no sense for this stream.
void question(const Options& o, const bp::StreamHeader& in) {
  if (bp::opens(in) && o.keep_cavities)
    fail(ErrorCode::bad_argument, "--keep-cavities means nothing for a stream of bpvox --fill inside; leave it out");
  if (o.closing.scale) bp::question_scale("--scale", *o.closing.scale, in.bounds, in.frame.voxel);
}

void run(Options o) {
  bp::Report report("bpclose");
  bp::Progress progress("bpclose", o.common.progress);
  report.begin("open");
  const auto output = bp::open_output(o.out, o.common.overwrite);
  bp::BrickReader reader(o.in);
  if (!o.closing.scale && o.field.empty() && !reader.header().has_field) o.closing.scale = bp::kDefaultScale;
  const bool opening = bp::opens(reader.header());
  question(o, reader.header());
  const bp::PassProgress shown = progress.for_pass();
  bp::CloseOptions options = bp::close_options(o.common, o.keep_cavities, opening, 0, shown);
  bp::RuledSource source(reader, options.context, o.common.memory_bytes, o.common.temp);
  const bp::ScalePlan plan = scale_plan(o, source);
  const bp::ScaleField& field = plan.field;
  const bp::CloseStep step{o.closing, o.keep_cavities};
  bp::note_scales(report, o.common, step, source.header(), plan);
  const bp::ClosingParams params = bp::closing_params(o.closing.element, source.header());
  const bp::Estimate estimate = bp::estimate_close(source.header(), field);
  // A GPU leaves turned cubes to the CPU.
  bp::Backends backends = bp::make_backends(o.common, params.turned() ? 0 : estimate.core_seconds, &report);
  options = bp::close_options(o.common, o.keep_cavities, opening, bp::pinned_bytes(backends),
                              bp::refused_with_outputs(shown));
  bp::note_estimate(estimate, o.common, progress, report, bp::names_of(backends));
  bp::BrickWriter sink(*output, closed_header(params, step, source.header(), plan));

  report.begin("close");
  const auto close = opening ? bp::open_stream : bp::close_stream;
  const bp::CloseCounts counts = close(source, sink, backends, field, params, options);
  sink.finish();
  output->commit();

  report.options["options"] = bp::close_text(step, source.header(), plan).text();
  report.options["memory"] = o.common.memory_bytes;
  report.bytes_in = reader.totals().bytes;
  report.bytes_out = output->bytes();
  fill_report(report, backends, counts);
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpclose", argc, argv, parse, run);
}
