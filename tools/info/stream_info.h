#pragma once
#include <string>

#include "io/stream/brick_stream.h"
#include "tools/cli/report.h"

/// What bpinfo says of a stream of voxels.
namespace bp {

[[nodiscard]] std::string stream_text(const StreamHeader& header, const StreamTotals& totals, const std::string& name);
[[nodiscard]] Json stream_json(const StreamHeader& header, const StreamTotals& totals);

/// The stream as lines: header, one line a brick, end. Depends on the content only, not on compression.
[[nodiscard]] std::string dump_header(const StreamHeader& header);
[[nodiscard]] std::string dump_brick(const Brick& brick);
[[nodiscard]] std::string dump_end(const StreamTotals& totals);

}  // namespace bp
