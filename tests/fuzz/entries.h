#pragma once
#include <cstddef>
#include <cstdint>

/// Properties that every input of a fuzzer must have; the process is aborted otherwise. Shared by the fuzzers and the
/// quick tests. The bytes are decisions of a generator (choices.h). Its output goes through the tools, which run in
/// this process and must keep to docs/exit-codes.md (tool_runs.h).
namespace fuzz {

/// A brick stream with valid hashes and hostile contents, through bpinfo, bpclose, bpmesh and bpcheck: refused, or the
/// proxy holds. All tools agree whether the stream can be read.
void stream_stages(const std::uint8_t* data, std::size_t size);

/// A scene with extreme numbers in any format that the suite reads itself, through bpinfo, or the whole pipe at a low
/// resolution: refused, or the proxy encloses the scene.
void scene(const std::uint8_t* data, std::size_t size);

/// A command line of any tool, with its own options and extreme values, on small sound inputs.
void options(const std::uint8_t* data, std::size_t size);

/// A stream of sound contents with any orientation, through bpinfo, bpclose, bpmesh and bpcheck, as stream_stages().
void turned(const std::uint8_t* data, std::size_t size);

/// glTF whose triangles are packed by Draco, with packed bytes and numbers that are damaged, through bpinfo and
/// bpcheck.
void draco(const std::uint8_t* data, std::size_t size);

/// A file of weights with damaged contents whose hashes fit, through bpdeform apply.
void weights(const std::uint8_t* data, std::size_t size);

/// A tileset with leaves, through bpcheck and bpinfo: a sound one is proven, one whose leaf lacks a part of the scene
/// is not.
void tileset(const std::uint8_t* data, std::size_t size);

}  // namespace fuzz
