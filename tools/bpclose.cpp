// bpclose: solid bricks in, solid and closing out. Manual: docs/bpclose.1.md
#include <optional>

#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/mesh/complement.h"
#include "tools/cli/names.h"
#include "tools/cli/options/closing.h"
#include "tools/cli/output_name.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/notes/estimate.h"
#include "tools/notes/proportion.h"
#include "tools/notes/scale_notes.h"
#include "tools/run/make_backend.h"
#include "tools/run/memory_shares.h"
#include "tools/run/provenance.h"
#include "tools/run/scale_rules.h"

namespace {

using bp::ErrorCode;
using bp::fail;

constexpr bp::Length kDefaultScale{2, bp::Length::Unit::percent};

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
  if (!o.field.empty()) return source.read_rules(o.field);
  bp::ScalePlan plan;
  if (header.has_field) {
    plan.field = header.scale;
    plan.entries.resize(plan.field.rules.size());
  } else {
    plan.field.base = o.closing.scale->in_world(header.bounds.diagonal(), header.frame.voxel);
  }
  return plan;
}

/// Returns whether the stream is opened: narrow parts are removed from the inside of a scene.
bool opens(const bp::StreamHeader& header) {
  return header.fill == bp::FillMode::inside;
}

bp::OptionText option_text(const Options& o, const bp::StreamHeader& header, const bp::ScalePlan& plan) {
  bp::OptionText text;
  if (o.closing.scale) {
    text.add("scale", *o.closing.scale);
  } else if (!header.has_field) {  // else bpscale has told it
    text.add("field", bp::provenance_text(plan));
  }
  text.add("element", name_of(o.closing.element));
  text.add("keep-cavities", o.keep_cavities);
  if (opens(header)) text.add("inner", true);
  return text;
}

/// Shares out --memory: the program, the stream's batches and `pinned` memory, the shelves, the tiles at work.
bp::CloseOptions pass_options(const Options& o, bool opening, std::uint64_t pinned, bp::Progress& progress) {
  const bp::MemoryLimit limit{o.common.memory_bytes, bp::kVoxelProgram + pinned};
  const std::uint64_t usable = limit.rest_bytes();
  bp::CloseOptions options;
  options.keep_cavities = o.keep_cavities || opening;  // the cavities of the complement are the solid
  options.context.memory = {usable / 2, 0.5, limit};
  options.context.make_shelf = bp::make_shelf_factory(usable / 5 * 2, o.common.temp);
  options.context.progress = progress.for_pass();
  return options;
}

/// Returns the parameters, with the cubes as bpscale turned them.
bp::ClosingParams closing_params(const Options& o, const bp::StreamHeader& header) {
  bp::ClosingParams params{o.closing.element};
  if (header.has_field && !header.orientation.empty() && params.element == bp::StructuringElement::cube)
    params.orientation = &header.orientation;
  return params;
}

bp::StreamHeader closed_header(const bp::ClosingParams& params, const Options& o, const bp::StreamHeader& in,
                               const bp::ScalePlan& plan) {
  bp::StreamHeader header = in;
  if (!opens(in)) header.bricks = bp::closing_bricks(in, plan.field, params);
  if (!params.turned()) header.orientation = {};
  header.slab_axis = in.slab_axis;
  header.has_closing = true;
  header.has_field = false;
  header.scale = plan.field;
  header.element = o.closing.element;
  header.provenance.push_back(bp::make_provenance("bpclose", option_text(o, in, plan)));
  return header;
}

/// The opening is the complement of the closing of the complement.
bp::CloseCounts open_stream(bp::BrickSource& source, bp::BrickSink& sink, bp::Backends& backends,
                            const bp::ScaleField& field, const bp::ClosingParams& params,
                            const bp::CloseOptions& options) {
  bp::ComplementSource complement(source);
  bp::ComplementSink opened(sink, source.header());
  const bp::CloseCounts counts = bp::close_stream(complement, opened, backends, field, params, options);
  opened.finish();
  return counts;
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
  if (opens(in) && o.keep_cavities)
    fail(ErrorCode::bad_argument, "--keep-cavities means nothing for a stream of bpvox --fill inside; leave it out");
  if (o.closing.scale) bp::question_scale("--scale", *o.closing.scale, in.bounds, in.frame.voxel);
}

void run(Options o) {
  bp::Report report("bpclose");
  bp::Progress progress("bpclose", o.common.progress);
  report.begin("open");
  const auto output = bp::open_output(o.out, o.common.overwrite);
  bp::BrickReader reader(o.in);
  if (!o.closing.scale && o.field.empty() && !reader.header().has_field) o.closing.scale = kDefaultScale;
  const bool opening = opens(reader.header());
  question(o, reader.header());
  bp::CloseOptions options = pass_options(o, opening, 0, progress);
  bp::RuledSource source(reader, options.context, o.common.memory_bytes, o.common.temp);
  const bp::ScalePlan plan = scale_plan(o, source);
  const bp::ScaleField& field = plan.field;
  for (const std::string& text : bp::scale_notes(plan, source.header())) report.note(text, o.common);
  if (const std::string text = bp::scale_share_note(o.closing.scale, source.header().bounds); !text.empty())
    report.note(text, o.common);
  const bp::ClosingParams params = closing_params(o, source.header());
  if (source.header().has_field && !source.header().orientation.empty() && !params.turned())
    report.note("balls cannot be turned; the orientation of the stream changes nothing", o.common);
  const bp::Estimate estimate = bp::estimate_close(source.header(), field);
  // A GPU leaves turned cubes to the CPU.
  bp::Backends backends = bp::make_backends(o.common, params.turned() ? 0 : estimate.core_seconds, &report);
  if (const std::uint64_t pinned = bp::pinned_bytes(backends); pinned > 0)
    options = pass_options(o, opening, pinned, progress);
  bp::note_estimate(estimate, o.common, progress, report, bp::names_of(backends));
  bp::BrickWriter sink(*output, closed_header(params, o, source.header(), plan));

  report.begin("close");
  const auto close = opening ? open_stream : bp::close_stream;
  const bp::CloseCounts counts = close(source, sink, backends, field, params, options);
  sink.finish();
  output->commit();

  report.options["options"] = option_text(o, source.header(), plan).text();
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
