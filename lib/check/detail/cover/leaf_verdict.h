#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include "lib/check/cover_tile.h"
#include "lib/check/detail/leaf_proof.h"
#include "lib/check/tile_finding.h"
#include "lib/core/triangle_source.h"

/// The verdicts of check_cover() on triangles of the scene, and the comparison of the scene with leaves.
namespace bp {

/// Verdicts on a triangle in the cell of a tile. bare, uncovered: nothing is drawn, in the cell or in an octant of it.
enum class CoverVerdict { fine, thin, flat, touching, outside, undecided, rounded, missing, bare, uncovered, count };

struct CoverCounts {
  std::array<std::atomic<std::uint64_t>, std::size_t(CoverVerdict::count)> triangles{};
  std::uint64_t strays = 0;  ///< triangles of a leaf
  void add(CoverVerdict verdict) {
    if (verdict != CoverVerdict::fine) ++triangles[std::size_t(verdict)];
  }
  [[nodiscard]] std::uint64_t of(CoverVerdict verdict) const { return triangles[std::size_t(verdict)]; }
};

/// Adds a finding for each kind of verdict on the scene's triangles at a tile that is not good.
void report_verdicts(const CoverTile& tile, const CoverCounts& counts, std::vector<TileFinding>& findings);

/// Compares t with a leaf. A triangle without area shows nothing, and no leaf has it. `error`: the leaf's; rounding is
/// added.
[[nodiscard]] CoverVerdict compare_with_leaf(LeafProof& proof, const Bounds3d& cell, const TriangleD& t, double error);
/// Compares t with a leaf without triangles. `flat`: as for LeafProof.
[[nodiscard]] CoverVerdict compare_with_nothing(const Bounds3d& cell, const TriangleD& t, double error, double flat);

/// The errors of a tileset's leaves, once all coordinates of the scene were read.
struct LeafErrors {
  Rounding rounding;          ///< the scene's
  double flat = 0;            ///< as for LeafProof; 0 if there are no leaves
  double largest = 0;         ///< the largest error that leaves are compared with, rounding included
  std::vector<char> refused;  ///< per tile: a leaf with too large an error, which is compared with nothing
};
/// Judges the errors of leaves. The file chose the errors of leaves and the cells, but only the scene tells what
/// rounding is. Adds a finding for each refused leaf in `mine`. Reads the scene for its bounds.
[[nodiscard]] LeafErrors judge_leaf_errors(const std::vector<CoverTile>& tiles, const std::vector<bool>& mine,
                                           TriangleSource& scene, std::vector<TileFinding>& findings);

}  // namespace bp
