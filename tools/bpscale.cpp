// bpscale: adds a scale field to a stream of voxels, for bpclose. Manual: docs/bpscale.1.md
#include <optional>

#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/measure/shape_rules.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/notes/scale_notes.h"
#include "tools/run/inputs.h"
#include "tools/run/memory_shares.h"
#include "tools/run/provenance.h"
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
  if (o.explain && args.given("--output"))
    fail(ErrorCode::bad_argument, "--explain writes no stream; leave out --output");
  bp::check_stream_name(o.out);
  bp::keep_inputs({o.rules, o.in});
  return o;
}

/// What the rules say.
struct Fields {
  bp::ScaleField scale;
  bp::OrientationField orientation;
  std::string orientation_rules;  ///< JSON; empty: none
};

bp::StreamHeader with_fields(const bp::StreamHeader& in, const Fields& fields) {
  bp::StreamHeader header = in;
  header.has_field = true;
  header.scale = fields.scale;
  header.orientation = fields.orientation;
  bp::OptionText text;
  text.add("field", bp::provenance_text(fields.scale));
  text.add("orientation", bp::provenance_text(fields.orientation_rules, "places"));
  header.provenance.push_back(bp::make_provenance("bpscale", text));
  return header;
}

/// The voxels of a stream, read as soon as a rule is measured on them.
class MeasuredVoxels {
 public:
  MeasuredVoxels(bp::BrickReader& source, const Options& o) : source_(source), progress_("bpscale", o.common.progress) {
    const bp::MemoryLimit limit{o.common.memory_bytes, bp::kVoxelProgram};
    options_.context.memory = {limit.rest_bytes() / 2, 0.5, limit};
    options_.context.make_shelf = bp::make_shelf_factory(limit.rest_bytes() / 5 * 2, o.common.temp);
    options_.context.progress = progress_.for_pass();
  }

  std::vector<bp::ScaleRule> measure(const bp::ShapeRule& rule, const bp::ScaleField& before) {
    if (source_.header().fill == bp::FillMode::inside)
      fail(ErrorCode::bad_input, "rules by shape are for closings, and a stream of bpvox --fill inside is opened");
    if (!shelf_) {
      shelf_ = options_.context.make_shelf();
      for (bp::Brick brick; source_.read(brick);) shelf_->put(brick.coord, brick.fill, brick.bits);
    }
    return bp::shape_rules(source_.header(), *shelf_, rule, before, options_);
  }

  /// The bricks of the stream, from the shelf or the stream itself. Returns their number.
  std::uint64_t copy(bp::BrickSink& sink) {
    if (!shelf_) return copy(source_, sink);
    bp::ShelfSource kept(source_.header(), *shelf_, nullptr, bp::ShelfSource::Keep::all);
    return copy(kept, sink);
  }

 private:
  static std::uint64_t copy(bp::BrickSource& source, bp::BrickSink& sink) {
    std::uint64_t bricks = 0;
    for (bp::Brick brick; source.read(brick); ++bricks) sink.write(brick);
    sink.finish();
    return bricks;
  }

  bp::BrickReader& source_;
  bp::Progress progress_;
  bp::MeasureOptions options_;
  std::unique_ptr<bp::BrickShelf> shelf_;
};

void run(const Options& o) {
  bp::Report report("bpscale");
  report.begin("open");
  const auto output = o.explain ? nullptr : bp::open_output(o.out, o.common.overwrite);
  bp::BrickReader source(o.in);
  const bp::StreamHeader& header = source.header();
  if (header.has_closing)
    fail(ErrorCode::bad_input, "{}: is closed already; bpscale comes between bpvox and bpclose", o.in);
  MeasuredVoxels voxels(source, o);
  Fields fields;
  fields.scale = bp::read_rules(
      o.rules, header,
      [&](const bp::ShapeRule& rule, const bp::ScaleField& before) { return voxels.measure(rule, before); },
      [&](const std::string& json, const bp::ScaleField& scale) {
        fields.orientation_rules = json;
        fields.orientation = bp::make_orientation(json, o.rules, header, scale);
      });
  const bp::ScaleField& field = fields.scale;
  (void)field.upper_bound(header.frame);  // refuses what is out of range
  if (o.explain) return bp::print(bp::explain_point(field, fields.orientation, header, *o.explain));
  const bool opening = header.fill == bp::FillMode::inside;
  for (const std::string& text : bp::scale_notes(field, header, opening)) report.note(text, o.common);

  report.begin("copy");
  bp::BrickWriter sink(*output, with_fields(header, fields));
  report.counts = {{"rules", field.rules.size()}, {"bricks", voxels.copy(sink)}};
  output->commit();
  report.bytes_in = source.totals().bytes;
  report.bytes_out = output->bytes();
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpscale", argc, argv, parse, run);
}
