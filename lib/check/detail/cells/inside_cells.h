#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include "lib/check/detail/surface.h"

namespace bp {

/// Cells of space that lie strictly inside a closed surface. They settle most triangles of a scene by their boxes,
/// since most lie far from the surface. The cells' edge is a power of two, so that their planes are exact doubles. They
/// form blocks of 8^3 cells. The cells of a block are computed when the third box meets it, and are then known for all
/// further boxes.
class InsideCells {
 public:
  /// The surface must be closed and oriented, and all its corners in the domain of the predicates. Keeps a reference to
  /// it. Takes at most `memory_bytes`, and 13 to 25 MiB for some ten thousand faces.
  InsideCells(const Surface& surface, std::uint64_t memory_bytes);

  /// Returns true only if no triangle of the surface meets the closed box, and the surface winds around the box at
  /// least once. Exact. Returns false if that is not known, whatever the box is: the answer may depend on earlier
  /// calls, so both answers must lead to the same result. Thread-safe.
  [[nodiscard]] bool hold(const Bounds3d& box) const;

 private:
  using Layers = std::array<std::uint64_t, 8>;  ///< a bit for each cell of a block; a word for each z, x is fastest
  using Place = std::array<std::uint32_t, 3>;

  [[nodiscard]] double plane(std::size_t axis, std::uint32_t cell) const {
    return (first_[axis] + double(cell)) * edge_;
  }
  [[nodiscard]] std::size_t number_of(const Place& block) const {
    return block[0] + std::size_t(blocks_[0]) * (block[1] + std::size_t(blocks_[1]) * block[2]);
  }
  [[nodiscard]] std::uint32_t state_of(const Place& block) const;
  [[nodiscard]] std::uint32_t look_at(const Place& block) const;
  [[nodiscard]] bool continues(const Layers& part, const Place& block) const;
  [[nodiscard]] std::uint32_t keep(const Layers& inside) const;
  [[nodiscard]] bool winds_around(const Place& cell) const;

  const Surface& surface_;
  double edge_ = 0, per_edge_ = 0;  ///< edge of a cell, scene units; and 1 / edge_
  Vec3d first_{};                   ///< the first cell begins at first_ * edge_; whole numbers
  Place cells_{}, blocks_{};        ///< numbers along each axis; 0: nothing is ever known
  std::uint32_t most_kept_ = 0;
  std::unique_ptr<std::atomic<std::uint32_t>[]> states_;  ///< of each block
  std::unique_ptr<Layers[]> kept_;                        ///< inside cells of the blocks in which other cells are not
  mutable std::atomic<std::uint32_t> kept_count_{0};
};

}  // namespace bp
