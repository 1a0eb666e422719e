#pragma once
#include <vector>

#include "lib/deform/detail/wide.h"

namespace bp::detail {

/// Of Green coordinates.
template <class Real>
struct GreenScratch {
  struct alignas(sizeof(Real)) Vertex {
    Real x, y, z, distance;  ///< from the point
    Real sum;                ///< the weight
  };
  struct alignas(sizeof(Real)) Edge {
    Real inner;     ///< product of the vectors to its ends
    Real integral;  ///< of one over the distance along it
  };
  struct alignas(sizeof(Real)) Face {
    Real weight;
  };
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
  std::vector<Face> faces;
};

/// Memory of the coordinates of kWide points, kept from call to call.
struct CoordinateScratch {
  struct alignas(8 * kWide) Vertex {
    WideVec toward;   ///< the unit vector from the point
    Wide per_length;  ///< one over the distance
    Wide sum;         ///< the weight
  };
  struct alignas(8 * kWide) Edge {
    WideVec across;  ///< cross product of its ends' unit vectors
    WideVec mean;    ///< its part of mean vectors
  };
  struct alignas(8 * kWide) Face {
    WideVec middle;  ///< between its corners on the unit sphere
    Wide share[3];   ///< of the corners in it: they sum to 1
    Wide prior;
  };
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
  std::vector<Face> faces;
  GreenScratch<Wide> green;
};

}  // namespace bp::detail
