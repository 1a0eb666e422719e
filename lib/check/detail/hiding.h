#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/triangle_source.h"

/// Can a point be seen from far away, past the triangles of a scene?
namespace bp {

enum class Hiding {
  seen,      ///< along an axis, or infinitely near to that direction, nothing lies before it
  enclosed,  ///< a closed shell of the scene winds around it: every path to it crosses the scene
  unknown,   ///< neither is known
};

/// Of points that lie on no triangle. A shell is a set of triangles that edges connect. Reads the scene once from its
/// start; where its triangles take more than memory_bytes, shells are not looked at. Exact; parallel.
[[nodiscard]] std::vector<Hiding> hiding_of(const std::vector<Vec3d>& points, TriangleSource& scene,
                                            std::uint64_t memory_bytes);

}  // namespace bp
