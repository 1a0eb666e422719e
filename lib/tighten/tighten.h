#pragma once
#include <cstdint>

#include "lib/simplify/regions.h"
#include "lib/tighten/proxy_editor.h"

/// Tightening: vertex moves and edge flips that lower the proxy's volume while everything in `enclosed` stays inside
/// and the proxy stays embedded. Simplification under constraints against its own faces can only grow; this takes the
/// growth back.
namespace bp {

struct TightenParams : ShapeLimits {
  int sweeps = 4;            ///< at most, that move all vertices together
  int final_sweeps = 3;      ///< then, at most, that move each vertex as far as it goes alone
  double least_gain = 5e-4;  ///< sweeps of a kind end when one gains less than this share of the volume
  bool stops_early = false;  ///< no single vertices, where the last of the first sweeps gained less than that
  double volume = 0;         ///< the volume for that, lattice units cubed; 0: of the mesh, which is whole then
  std::uint64_t faces_per_region = kFacesPerRegion;  ///< as in SimplifyParams
};

struct TightenCounts {
  std::uint64_t sweeps = 0, moves = 0, flips = 0, tries = 0;
  double volume_before = 0, volume_after = 0;  ///< lattice units cubed
};

/// Lattice units cubed.
[[nodiscard]] double volume_of(const HalfEdgeMesh& mesh);

/// Tightens the mesh of the editor on the way to something else: it may come out larger, where vertices made room that
/// others could not take and cannot go back themselves.
TightenCounts tighten_on(ProxyEditor& editor, const TightenParams& params);

/// The mesh of the editor, tightened; as it was if that made it larger: sweeps keep a margin of less than a lattice
/// unit. Deterministic. Every step is checked exactly before it is taken. Cost: a few exact tests per vertex and
/// sweep.
[[nodiscard]] LatticeMesh tighten(ProxyEditor& editor, const GridFrame& frame, const TightenParams& params,
                                  TightenCounts& counts);

/// `proxy`: closed, 2-manifold, embedded, enclosing. The result has the same properties and at most the same volume.
[[nodiscard]] LatticeMesh tighten(const LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                                  TightenCounts& counts);

}  // namespace bp
