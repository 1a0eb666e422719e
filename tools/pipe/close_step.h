#pragma once
#include "lib/grid/scale_field.h"
#include "lib/pass/close/close_pass.h"
#include "tools/cli/common_options.h"
#include "tools/cli/options/closing.h"
#include "tools/cli/report.h"
#include "tools/run/provenance.h"
#include "tools/run/scale_rules.h"

/// The second step of the pipe, as bpclose and libbp do it.
namespace bp {

/// The scale if none is given, and no field.
constexpr Length kDefaultScale{2, Length::Unit::percent};

struct CloseStep {
  ClosingOptions closing;
  bool keep_cavities = false;
};

/// Returns whether the stream is opened: narrow parts are removed from the inside of a scene.
[[nodiscard]] bool opens(const StreamHeader& header);

/// Returns the options for the provenance.
[[nodiscard]] OptionText close_text(const CloseStep& step, const StreamHeader& header, const ScalePlan& plan);

/// Shares out the limit on memory: the program, the stream's batches and `pinned` memory, the shelves, the tiles at
/// work.
[[nodiscard]] CloseOptions close_options(const CommonOptions& common, bool keep_cavities, bool opening,
                                         std::uint64_t pinned, const PassProgress& progress);

/// Returns the plan of the step's scale, or of the field that the stream has.
[[nodiscard]] ScalePlan plan_without_rules(const CloseStep& step, const StreamHeader& header);

/// Adds to the report what the user should know of the scales.
void note_scales(Report& report, const CommonOptions& common, const CloseStep& step, const StreamHeader& header,
                 const ScalePlan& plan);

/// Returns the parameters, with the cubes as bpscale turned them. The result keeps a reference to `header`.
[[nodiscard]] ClosingParams closing_params(StructuringElement element, const StreamHeader& header);

/// Returns the header of the result.
[[nodiscard]] StreamHeader closed_header(const ClosingParams& params, const CloseStep& step, const StreamHeader& in,
                                         const ScalePlan& plan);

/// Does what close_stream() does, for a stream that is opened: the opening is the complement of the closing of the
/// complement.
CloseCounts open_stream(BrickSource& source, BrickSink& sink, Backends& backends, const ScaleField& field,
                        const ClosingParams& params, const CloseOptions& options);

}  // namespace bp
