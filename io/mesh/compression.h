#pragma once

namespace bp {

/// The storage of a GLB: with EXT_meshopt_compression, normals of 8 bits (KHR_mesh_quantization) and places in images
/// rounded to a 65,536th, or as plain float32, which every viewer reads without a decoder.
enum class Compression { meshopt, none };

}  // namespace bp
