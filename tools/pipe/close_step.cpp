#include "tools/pipe/close_step.h"

#include "io/stream/brick_shelf.h"
#include "lib/pass/mesh/complement.h"
#include "tools/cli/names.h"
#include "tools/notes/proportion.h"
#include "tools/notes/scale_notes.h"
#include "tools/run/memory_shares.h"

namespace bp {

bool opens(const StreamHeader& header) {
  return header.fill == FillMode::inside;
}

OptionText close_text(const CloseStep& step, const StreamHeader& header, const ScalePlan& plan) {
  OptionText text;
  if (step.closing.scale) {
    text.add("scale", *step.closing.scale);
  } else if (!header.has_field) {  // else bpscale has told it
    text.add("field", provenance_text(plan));
  }
  text.add("element", name_of(step.closing.element));
  text.add("keep-cavities", step.keep_cavities);
  if (opens(header)) text.add("inner", true);
  return text;
}

CloseOptions close_options(const CommonOptions& common, bool keep_cavities, bool opening, std::uint64_t pinned,
                           const PassProgress& progress) {
  const MemoryLimit limit{common.memory_bytes, kVoxelProgram + pinned};
  const std::uint64_t usable = limit.rest_bytes();
  CloseOptions options;
  options.keep_cavities = keep_cavities || opening;  // the cavities of the complement are the solid
  options.context.memory = {usable / 2, 0.5, limit};
  options.context.make_shelf = make_shelf_factory(usable / 5 * 2, common.temp);
  options.context.progress = progress;
  return options;
}

ScalePlan plan_without_rules(const CloseStep& step, const StreamHeader& header) {
  ScalePlan plan;
  if (header.has_field) {
    plan.field = header.scale;
    plan.entries.resize(plan.field.rules.size());
  } else {
    plan.field.base = step.closing.scale->in_world(header.bounds.diagonal(), header.frame.voxel);
  }
  return plan;
}

void note_scales(Report& report, const CommonOptions& common, const CloseStep& step, const StreamHeader& header,
                 const ScalePlan& plan) {
  for (const std::string& text : scale_notes(plan, header)) report.note(text, common);
  if (const std::string text = scale_share_note(step.closing.scale, header.bounds); !text.empty())
    report.note(text, common);
  const ClosingParams params = closing_params(step.closing.element, header);
  if (header.has_field && !header.orientation.empty() && !params.turned())
    report.note("balls cannot be turned; the orientation of the stream changes nothing", common);
}

ClosingParams closing_params(StructuringElement element, const StreamHeader& header) {
  ClosingParams params{element};
  if (header.has_field && !header.orientation.empty() && element == StructuringElement::cube)
    params.orientation = &header.orientation;
  return params;
}

StreamHeader closed_header(const ClosingParams& params, const CloseStep& step, const StreamHeader& in,
                           const ScalePlan& plan) {
  StreamHeader header = in;
  if (!opens(in)) header.bricks = closing_bricks(in, plan.field, params);
  if (!params.turned()) header.orientation = {};
  header.slab_axis = in.slab_axis;
  header.has_closing = true;
  header.has_field = false;
  header.scale = plan.field;
  header.element = step.closing.element;
  header.provenance.push_back(make_provenance("bpclose", close_text(step, in, plan)));
  return header;
}

CloseCounts open_stream(BrickSource& source, BrickSink& sink, Backends& backends, const ScaleField& field,
                        const ClosingParams& params, const CloseOptions& options) {
  ComplementSource complement(source);
  ComplementSink opened(sink, source.header());
  const CloseCounts counts = close_stream(complement, opened, backends, field, params, options);
  opened.finish();
  return counts;
}

}  // namespace bp
