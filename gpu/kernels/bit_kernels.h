#pragma once
#include <cuda_runtime.h>

#include "gpu/kernels/grid_view.h"

/// Passes over packed bits: into and out of the domain's layout, the cube's dilation, the contour. All arrays hold
/// shape.word_count() words, flags of cells one word per quad (a byte is 0xff where the cell holds a set voxel).
namespace bp {

/// Returns cudaSuccess if this build holds code that the current device can run; else the first launch would fail.
[[nodiscard]] cudaError_t find_code();

/// A dense box of words somewhere on the device (a BitBox), and the place of its first word in the domain.
struct BoxOfWords {
  std::int32_t words = 0, ny = 0, nz = 0;  ///< 32-bit words per row
  std::int32_t w0 = 0, y0 = 0, z0 = 0;     ///< position in the domain; may be negative
};

/// Bricks of 64^3 voxels on the device (BrickBits, one after the other), and the box that they fill. Brick (x, y, z) of
/// the box is number slots[x + nx (y + ny z)]; it has no number if it is empty or full.
struct BrickTable {
  std::uint64_t* bits = nullptr;
  std::uint32_t* slots = nullptr;
  std::int32_t nx = 0, ny = 0, nz = 0;
  std::int32_t w0 = 0, y0 = 0, z0 = 0;  ///< position in the domain; may be negative
};
constexpr std::uint32_t kEmptyBrick = 0xffffffffu, kFullBrick = 0xfffffffeu;

/// bits := the bricks' voxels, empty elsewhere; cells := flags (must be zero before).
void pack_bricks(const BrickTable& from, const GridShape& shape, std::uint32_t* bits, std::uint32_t* cells,
                 cudaStream_t stream);
/// Packs the bricks of the domain that `to` covers, if they are neither empty nor full, without gaps and in any order.
/// Adds their number to `count`, which must be zero before.
void unpack_bricks(const std::uint32_t* bits, const GridShape& shape, const BrickTable& to, std::uint32_t* count,
                   cudaStream_t stream);

/// bits := the box's voxels, empty elsewhere; cells := flags (must be zero before).
void pack_bits(const std::uint32_t* from, const BoxOfWords& box, const GridShape& shape, std::uint32_t* bits,
               std::uint32_t* cells, cudaStream_t stream);
/// to := the domain's voxels of the box, cut to `keep`.
void unpack_bits(const std::uint32_t* bits, const GridShape& shape, const BoxOfWords& box, const VoxelRange& keep,
                 std::uint32_t* to, cudaStream_t stream);

/// table(w, y, z) := OR of bits over [y, y + length) x [z, z + length); length a power of two; `half` is scratch.
void window_table(const std::uint32_t* bits, const GridShape& shape, int length, std::uint32_t* half,
                  std::uint32_t* table, cudaStream_t stream);
/// Makes the table of twice the length from that of `length`.
void double_windows(const std::uint32_t* table, const GridShape& shape, int length, std::uint32_t* twice,
                    cudaStream_t stream);

/// A radius r asks for windows of 2r + 1 rows, which two overlapping windows of the power of two below cover. Radii of
/// an octave share a table: 0 | 1 | 2 3 | 4 .. 7 | ...
constexpr int kOctaves = 14;  ///< 2^13 voxels: a cube around the largest that is turned
[[nodiscard]] BP_HD inline int octave_of(int radius) {
  int k = 0;
  while ((2 << k) <= 2 * radius + 1) ++k;
  return k;
}
struct WindowTables {
  const std::uint32_t* table[kOctaves];  ///< of octave k: windows of 2^k; octave 0 is the bits themselves
};

/// Sets `out` to the voxels of `region` whose cube of this radius meets G. The table of the radius must exist. Exact
/// for voxels at least as far from the domain's lower faces.
void dilate_cube(const WindowTables& tables, const GridShape& shape, const VoxelRange& region, int radius,
                 std::uint32_t* out, cudaStream_t stream);
/// Does the same for a radius r(p) that varies. The tables of all radii that occur must exist.
///   bits   G
///   most   the largest radius
///   words  scratch, shape.word_count(); `count`, one more, must be zero before
void dilate_cube_varying(const WindowTables& tables, const std::uint32_t* bits, const GridShape& shape,
                         const VoxelRange& region, const ScaleView& scale, int most, int multiprocessors,
                         std::uint32_t* out, std::uint32_t* words, std::uint32_t* count, cudaStream_t stream);

/// contour := empty voxels with a 6-neighbour in bits; cells := its flags (must be zero before).
void outer_contour(const std::uint32_t* bits, const GridShape& shape, std::uint32_t* contour, std::uint32_t* cells,
                   cudaStream_t stream);

/// Returns 0xff in each byte of a flag word whose byte of `v` is not zero.
[[nodiscard]] BP_HD inline std::uint32_t spread_bytes(std::uint32_t v) {
  v |= v >> 4;
  v |= v >> 2;
  v |= v >> 1;
  return (v & 0x01010101u) * 255u;
}

}  // namespace bp
