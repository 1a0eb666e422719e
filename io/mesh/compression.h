#pragma once

namespace bp {

/// The storage of a GLB: with EXT_meshopt_compression, and normals and places in images rounded to integers
/// (KHR_mesh_quantization), or as plain float32, which every viewer reads without a decoder.
enum class Compression { meshopt, none };

}  // namespace bp
