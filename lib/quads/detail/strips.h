#pragma once
#include <array>
#include <vector>

#include "lib/mesh/half_edge_mesh.h"
#include "lib/quads/quads.h"

/// Strips of quads. A strip enters each of its quads through a side and leaves it through the opposite side, until it
/// comes back: around a limb, or along it and back. Removing a strip merges its two rails into one, so a mesh of quads
/// stays one.
namespace bp {

struct Strip {
  /// The sides that the strip crosses, in order: a vertex of the left rail, and one of the right rail.
  std::vector<std::array<VertexId, 2>> rungs;
  std::vector<std::uint32_t> quads;  ///< quad i lies between rungs i and i + 1
  double price = 0;                  ///< see price_strips()
};

/// Returns the strips of a closed mesh of quads that can be removed: those that do not cross or touch themselves, and
/// leave at least three quads at each vertex. Each quad lies in at most two of them. O(n log n).
[[nodiscard]] std::vector<Strip> strips_of(const std::vector<Quad>& quads, std::size_t vertices);

/// Returns the quads of which two opposite corners may be merged, as strips of one rung: at most `most_worse` more
/// edges are missing or too many at their vertices afterwards.
[[nodiscard]] std::vector<Strip> single_quads(const std::vector<Quad>& quads, std::size_t vertices, int most_worse);

/// Sets the prices of strips: the volume between the surface before and after the removal, for each quad that it saves.
/// `tight`: the vertices of the shrunk mesh. Quads that get longer than `edge` raise the price.
void price_strips(std::vector<Strip>& strips, const std::vector<Quad>& quads, const std::vector<Vec3d>& tight,
                  double edge);

}  // namespace bp
