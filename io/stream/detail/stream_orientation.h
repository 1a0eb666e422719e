#pragma once
#include "io/stream/stream_layout.h"
#include "lib/grid/stream.h"

/// The orientation field in the header of a stream (docs/brick-stream.md, section 4).
namespace bp::detail {

/// Appends the field, and then the number of its bytes.
void put_orientation(ByteSink& sink, const OrientationField& field);

/// Takes the orientation off the end of `rest` and puts it into `header`, whose other fields except the scene are set.
/// Throws bad_input with the fault.
void take_orientation(std::span<const std::byte>& rest, StreamHeader& header, const std::string& name);

}  // namespace bp::detail
