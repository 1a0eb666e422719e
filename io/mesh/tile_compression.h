#pragma once

namespace bp {

/// The storage of tiles' contents: with EXT_meshopt_compression and KHR_mesh_quantization, or as plain float32, which
/// every viewer reads without a decoder.
enum class TileCompression { meshopt, none };

}  // namespace bp
