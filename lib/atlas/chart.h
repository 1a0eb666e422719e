#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace bp {

/// A part of a mesh that lies flat in a plane, without a fold. No two of its faces overlap there.
struct Chart {
  std::vector<std::uint32_t> faces;  ///< numbers of triangles
  /// By face: its corners in the plane, lattice units, from (0, 0) to `size`.
  std::vector<std::array<std::array<double, 2>, 3>> corners;
  std::array<double, 2> size{};  ///< size of the smallest rectangle around the chart
};

}  // namespace bp
