#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/triangle_source.h"

/// Decides whether points can be seen from far away past the triangles of a scene.
namespace bp {

enum class Hiding {
  seen,      ///< along an axis, or infinitely near to that direction, nothing lies in front of it
  enclosed,  ///< a closed shell of the scene winds around it: every path to it crosses the scene
  unknown,   ///< neither is known
};

/// Returns the hiding of points that lie on no triangle. A shell is a set of triangles connected by edges. Reads the
/// scene once from its start; shells are not tested if its triangles take more than memory_bytes. Exact; parallel.
[[nodiscard]] std::vector<Hiding> hiding_of(const std::vector<Vec3d>& points, TriangleSource& scene,
                                            std::uint64_t memory_bytes);

}  // namespace bp
