#pragma once
#include <cstdint>

namespace bp {

/// Scenes of more triangles are enclosed by their voxels, unless --enclose says otherwise. The scene alone decides:
/// memory decides only whether there is a result, never which result.
constexpr std::uint64_t kMostEnclosedTriangles = std::uint64_t(1) << 20;

}  // namespace bp
