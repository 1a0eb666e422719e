#pragma once
#include "io/stream/stream_format.h"

/// The orientation field in the header of a stream (docs/brick-stream.md, section 4).
namespace bp::detail {

/// The field, and then the number of its bytes.
void put_orientation(ByteSink& sink, const OrientationField& field);

/// Into `header`, whose other fields are there but for the scene: the orientation that `rest` ends with; `rest` keeps
/// what comes before it. Throws bad_input, naming what is wrong.
void take_orientation(std::span<const std::byte>& rest, StreamHeader& header, const std::string& name);

}  // namespace bp::detail
