#pragma once
#include <cstddef>
#include <cstdint>

#include "gpu/kernels/tuning.h"
#include "lib/closing/rotation.h"
#include "lib/grid/scale_field.h"

/// How a tile lies in device memory, and how its scale is read there. Plain structs, passed to kernels by value.
namespace bp {

/// Bits of the domain of a tile: words of 32 voxels along x (bit i is voxel x0 + i), then y, then z. The domain starts
/// at a multiple of 32 voxels in x and of 8 in y and z of the grid, so that cells of 8^3 voxels and lattice cells of
/// the scale field coincide; ny and nz are multiples of 16.
struct GridShape {
  std::int32_t words = 0, ny = 0, nz = 0;
  [[nodiscard]] BP_HD std::int32_t cells_y() const { return ny / kCell; }
  [[nodiscard]] BP_HD std::int32_t cells_z() const { return nz / kCell; }
  [[nodiscard]] BP_HD std::uint32_t word_count() const {
    return std::uint32_t(words) * std::uint32_t(ny) * std::uint32_t(nz);
  }
  /// Returns the number of quads. Four cells along x share a word of flags, one byte each.
  [[nodiscard]] BP_HD std::uint32_t quad_count() const { return word_count() / (kCell * kCell); }
  [[nodiscard]] BP_HD std::uint32_t word(std::int32_t w, std::int32_t y, std::int32_t z) const {
    return (std::uint32_t(z) * std::uint32_t(ny) + std::uint32_t(y)) * std::uint32_t(words) + std::uint32_t(w);
  }
  [[nodiscard]] BP_HD std::uint32_t quad(std::int32_t w, std::int32_t cy, std::int32_t cz) const {
    return (std::uint32_t(cz) * std::uint32_t(cells_y()) + std::uint32_t(cy)) * std::uint32_t(words) + std::uint32_t(w);
  }
};

/// A quad of cells by number.
struct QuadCoord {
  std::int32_t w, cy, cz;
};
[[nodiscard]] BP_HD inline QuadCoord quad_at(const GridShape& s, std::uint32_t i) {
  const std::uint32_t rest = i / std::uint32_t(s.words);
  return {std::int32_t(i - rest * std::uint32_t(s.words)), std::int32_t(rest % std::uint32_t(s.cells_y())),
          std::int32_t(rest / std::uint32_t(s.cells_y()))};
}

/// A box of voxels of the domain, half-open.
struct VoxelRange {
  std::int32_t x0, y0, z0, x1, y1, z1;
  /// Returns the voxels of word (w, y, z) that lie in the box.
  [[nodiscard]] BP_HD std::uint32_t mask(std::int32_t w, std::int32_t y, std::int32_t z) const {
    if (y < y0 || y >= y1 || z < z0 || z >= z1) return 0;
    const std::int32_t lo = x0 - 32 * w, hi = x1 - 32 * w;
    if (lo >= 32 || hi <= 0) return 0;
    const std::uint32_t from = lo <= 0 ? 0xffffffffu : 0xffffffffu << lo;
    return hi >= 32 ? from : from & ((1u << hi) - 1);
  }
};

/// Returns the place of a lattice of n that is nearest to i.
[[nodiscard]] BP_HD inline std::int32_t nearest_index(std::int32_t i, std::int32_t n) {
  return i < 0 ? 0 : i >= n ? n - 1 : i;
}

/// The scale field over the domain: samples every 8 voxels, or one number.
struct ScaleView {
  const Scale* samples = nullptr;
  std::int32_t nx = 0, ny = 0, nz = 0;  ///< samples held
  std::int32_t ox = 0, oy = 0, oz = 0;  ///< index of the sample at voxel (0,0,0) of the domain
  Scale constant = 0;                   ///< S where the field is constant

  /// Returns the sample at the corner of cell (cx, cy, cz). Outside of the lattice it is the nearest one; no voxel
  /// there counts.
  [[nodiscard]] BP_HD std::uint32_t sample(std::int32_t cx, std::int32_t cy, std::int32_t cz) const {
    const std::int32_t i = nearest_index(cx + ox, nx), j = nearest_index(cy + oy, ny), k = nearest_index(cz + oz, nz);
    return samples[(std::uint32_t(k) * std::uint32_t(ny) + std::uint32_t(j)) * std::uint32_t(nx) + std::uint32_t(i)];
  }
  /// Returns 64 times S at x = 8 cx, interpolated in y and z. ScaleLattice::at() is the definition.
  [[nodiscard]] BP_HD std::uint32_t column(std::int32_t cx, std::int32_t y, std::int32_t z) const {
    const std::int32_t cy = y >> 3, cz = z >> 3;
    const std::uint32_t fy = std::uint32_t(y & 7), fz = std::uint32_t(z & 7);
    return (8 - fz) * ((8 - fy) * sample(cx, cy, cz) + fy * sample(cx, cy + 1, cz)) +
           fz * ((8 - fy) * sample(cx, cy, cz + 1) + fy * sample(cx, cy + 1, cz + 1));
  }
  [[nodiscard]] BP_HD Scale at(std::int32_t x, std::int32_t y, std::int32_t z) const {
    const std::uint32_t fx = std::uint32_t(x & 7);
    return Scale(((8 - fx) * column(x >> 3, y, z) + fx * column((x >> 3) + 1, y, z)) >> 9);
  }
};

/// Rotations on the device, one for each cell of 8^3 voxels. Outside of the lattice the nearest one holds.
struct RotationView {
  const Rotation* cells = nullptr;
  std::int32_t nx = 0, ny = 0, nz = 0;  ///< cells held
  std::int32_t ox = 0, oy = 0, oz = 0;  ///< index of the cell at voxel (0,0,0) of the domain

  [[nodiscard]] BP_HD const Rotation& at(std::int32_t x, std::int32_t y, std::int32_t z) const {
    const std::int32_t i = nearest_index((x >> 3) + ox, nx), j = nearest_index((y >> 3) + oy, ny),
                       k = nearest_index((z >> 3) + oz, nz);
    return cells[(std::uint32_t(k) * std::uint32_t(ny) + std::uint32_t(j)) * std::uint32_t(nx) + std::uint32_t(i)];
  }
};

}  // namespace bp
