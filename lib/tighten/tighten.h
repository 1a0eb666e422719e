#pragma once
#include <cstdint>

#include "lib/simplify/regions.h"
#include "lib/tighten/proxy_editor.h"

/// Tightens a proxy: moves vertices and flips edges to lower its volume, while everything in `enclosed` stays inside
/// and the proxy stays embedded. Simplification that is checked only against its own faces must grow; tightening
/// removes that growth.
namespace bp {

struct TightenParams : ShapeLimits {
  int sweeps = 4;            ///< most sweeps that move all vertices together
  int final_sweeps = 3;      ///< most sweeps afterwards that move each vertex as far as it goes alone
  double least_gain = 5e-4;  ///< sweeps of a kind end when one gains less than this share of the volume
  bool stops_early = false;  ///< vertices do not move alone if the last of the first sweeps gained less than that
  /// The volume for that share, lattice units cubed; 0: that of the mesh, which must be whole.
  double volume = 0;
  std::uint64_t faces_per_region = kFacesPerRegion;  ///< as in SimplifyParams
};

struct TightenCounts {
  std::uint64_t sweeps = 0, moves = 0, flips = 0, tries = 0;
  double volume_before = 0, volume_after = 0;  ///< lattice units cubed
};

/// Returns the volume of the mesh, lattice units cubed.
[[nodiscard]] double volume_of(const HalfEdgeMesh& mesh);

/// Tightens an editor's mesh that is changed further afterwards. It may come out larger, since some vertices make room
/// that others cannot use, and cannot go back themselves.
TightenCounts tighten_on(ProxyEditor& editor, const TightenParams& params);

/// Returns the tightened mesh of the editor. Returns it unchanged if the result would be larger, since sweeps keep a
/// margin of less than a lattice unit. Deterministic. Every step is checked exactly before it is made. Cost: a few
/// exact tests for each vertex and sweep.
[[nodiscard]] LatticeMesh tighten(ProxyEditor& editor, const GridFrame& frame, const TightenParams& params,
                                  TightenCounts& counts);

/// Tightens `proxy`, which must be closed, 2-manifold, embedded and enclosing. The result has the same properties and
/// at most the same volume.
[[nodiscard]] LatticeMesh tighten(const LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                                  TightenCounts& counts);

}  // namespace bp
