#pragma once
#include "lib/tighten/proxy_editor.h"
#include "lib/tighten/tighten_params.h"

/// Tightens a proxy: moves vertices and flips edges to lower its volume, while everything in `enclosed` stays inside
/// and the proxy stays embedded. Simplification that is checked only against its own faces must grow; tightening
/// removes that growth.
namespace bp {

/// Returns the volume of the mesh, lattice units cubed.
[[nodiscard]] double volume_of(const HalfEdgeMesh& mesh);

/// Tightens an editor's mesh that is changed further afterwards. It may come out larger, since some vertices make room
/// that others cannot use, and cannot go back themselves.
TightenCounts tighten_on(ProxyEditor& editor, const TightenParams& params);

/// Returns the tightened mesh of the editor. Returns it unchanged if the result would be larger before thin faces
/// are flipped, since sweeps keep a margin of less than a lattice unit. Deterministic. Every step is checked exactly
/// before it is made. Cost: a few exact tests for each vertex and sweep.
[[nodiscard]] LatticeMesh tighten(ProxyEditor& editor, const GridFrame& frame, const TightenParams& params,
                                  TightenCounts& counts);

/// Tightens `proxy`, which must be closed, 2-manifold, embedded and enclosing. The result has the same properties and
/// at most the same volume.
[[nodiscard]] LatticeMesh tighten(const LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                                  TightenCounts& counts);

}  // namespace bp
