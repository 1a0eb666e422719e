#pragma once
#include <cstddef>
#include <cstdint>

/// Properties that every input of a fuzzer must have; the process is aborted otherwise. Shared by the fuzzer and the
/// quick tests.
namespace fuzz {

/// The bytes are read as a brick stream. Either that is an Error of bad_input, or the reference reader finds the same
/// bricks and checksum. True if they are a stream.
bool read_brick_stream(const std::uint8_t* data, std::size_t size);

}  // namespace fuzz
