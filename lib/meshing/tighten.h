#pragma once
#include <cstdint>
#include <functional>

#include "lib/meshing/enclosed.h"
#include "lib/meshing/lattice_mesh.h"
#include "lib/meshing/step_limits.h"

/// Tightening: vertex moves and edge flips that lower the proxy's volume while everything in `enclosed` stays inside
/// and the proxy stays embedded. Simplification under constraints against its own faces can only grow; this takes the
/// growth back.
namespace bp {

struct TightenParams {
  int sweeps = 40;  ///< at most; stops earlier when a sweep gains less than `least_gain` of the volume
  double least_gain = 5e-4;
  /// As in SimplifyParams: longest edge that a move or a flip may make near a point, lattice units; empty: no limit.
  std::function<double(const LatticeCoord&)> edge_limit;
  StepLimits* limits = nullptr;  ///< if given, every step keeps them
};

struct TightenCounts {
  std::uint64_t sweeps = 0, moves = 0, flips = 0, tries = 0;
  double volume_before = 0, volume_after = 0;  ///< lattice units cubed
};

/// `proxy`: closed, 2-manifold, embedded, enclosing. Deterministic. Every step is checked exactly before it is taken,
/// so the result has the same properties and at most the same volume.
[[nodiscard]] LatticeMesh tighten(const LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                                  TightenCounts& counts);

}  // namespace bp
