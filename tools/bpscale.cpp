// bpscale: adds a scale field to a stream of voxels, for bpclose. Manual: docs/bpscale.1.md
#include <optional>

#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "tools/cli/output_name.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/notes/scale_notes.h"
#include "tools/pipe/close_step.h"
#include "tools/pipe/field_step.h"
#include "tools/run/inputs.h"
#include "tools/run/scale_rules.h"
#include "tools/scale/explain.h"
#include "tools/scale/orientation_rules.h"

namespace {

using bp::ErrorCode;
using bp::fail;

struct Options {
  bp::CommonOptions common;
  std::string rules, in = "-", out = "-";
  std::optional<bp::Vec3d> explain;
};

Options parse(bp::Args& args) {
  Options o;
  args.about("Adds a scale field to a stream of voxels: rules tell bpclose where the closing is finer or coarser.");
  args.example("bpvox scene.glb --resolution 256 | bpscale rules.json | bpclose | bpmesh --faces 1000 -o proxy.glb");
  args.positional("RULES", o.rules, "JSON file of rules");
  args.positional("INPUT", o.in, "stream of voxels; - is stdin");
  args.group("Files");
  args.option("-o,--output", "FILE", o.out, "stream of voxels, with the field; - is stdout");
  args.group("Field");
  args.option("--explain", "X,Y,Z", o.explain,
              "print what scale and orientation a point gets, and what each rule does there; write no stream");
  o.common.add_to(args, bp::CommonOptions::threads_part | bp::CommonOptions::memory_part |
                            bp::CommonOptions::progress_part | bp::CommonOptions::report_part |
                            bp::CommonOptions::overwrite_part);
  args.often({"--output", "--explain", "--overwrite"});
  args.parse();
  if (o.rules.empty()) fail(ErrorCode::bad_argument, "name a file of rules");
  if (bp::begins_as_stream(o.rules))
    fail(ErrorCode::bad_argument, "{} is a stream of voxels; the rules come first: bpscale {} {}", o.rules,
         o.in == "-" ? "RULES" : o.in, o.rules);
  if (o.explain && args.given("--output"))
    fail(ErrorCode::bad_argument, "--explain writes no stream; leave out --output");
  bp::check_stream_name(o.out);
  bp::keep_inputs({o.rules, o.in});
  return o;
}

std::uint64_t copy(bp::BrickSource& source, bp::BrickSink& sink) {
  std::uint64_t bricks = 0;
  for (bp::Brick brick; source.read(brick); ++bricks) sink.write(brick);
  sink.finish();
  return bricks;
}

void run(const Options& o) {
  bp::Report report("bpscale");
  bp::Progress progress("bpscale", o.common.progress);
  report.begin("open");
  const auto output = o.explain ? nullptr : bp::open_output(o.out, o.common.overwrite);
  bp::BrickReader reader(o.in);
  const bp::StreamHeader& header = reader.header();
  if (header.has_closing)
    fail(ErrorCode::bad_input, "{}: is closed already; bpscale comes between bpvox and bpclose", o.in);
  const bp::PassProgress show = bp::refused_with_outputs(progress.for_pass());
  const bp::PassContext context = bp::close_options(o.common, false, false, 0, show).context;
  bp::RuledSource source(reader, context, o.common.memory_bytes, o.common.temp);
  const bp::ScalePlan plan = source.read_rules(bp::read_rules_text(o.rules), true);
  bp::OrientationField orientation;
  if (!plan.orientation.empty())
    orientation = bp::make_orientation(plan.orientation, o.rules, header, plan.field, source.scene_options());
  if (o.explain) return bp::print(bp::explain_point(plan, orientation, header, *o.explain));
  for (const std::string& text : bp::scale_notes(plan, header)) report.note(text, o.common);

  report.begin("copy");
  bp::BrickWriter sink(*output, bp::field_header(header, plan, orientation));
  report.counts = {{"rules", plan.entries.size()}, {"bricks", copy(source, sink)}};
  output->commit();
  report.bytes_in = reader.totals().bytes;
  report.bytes_out = output->bytes();
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpscale", argc, argv, parse, run);
}
