#pragma once
#include "io/stream/stream_format.h"

/// The orientation field in the header of a stream (docs/brick-stream.md, section 4).
namespace bp::detail {

/// The field, and then the number of its bytes.
void put_orientation(ByteSink& sink, const OrientationField& field);

/// The field that `rest` ends with; `rest` keeps what comes before it. Throws bad_input, naming what is wrong.
[[nodiscard]] OrientationField take_orientation(std::span<const std::byte>& rest, const std::string& name);

}  // namespace bp::detail
