#pragma once
#include <string>

#include "io/stream/brick_stream.h"
#include "tools/cli/report.h"

/// The facts that bpinfo prints about a stream of voxels.
namespace bp {

[[nodiscard]] std::string stream_text(const StreamHeader& header, const StreamTotals& totals, const std::string& name);
[[nodiscard]] Json stream_json(const StreamHeader& header, const StreamTotals& totals);

/// Returns the stream as lines: header, one line a brick, end. They depend on the content only, not on compression.
[[nodiscard]] std::string dump_header(const StreamHeader& header);
[[nodiscard]] std::string dump_brick(const Brick& brick);
[[nodiscard]] std::string dump_end(const StreamTotals& totals);

}  // namespace bp
