#pragma once
#include <cuda_runtime.h>

#include "gpu/grid_view.h"

/// Passes over packed bits: into and out of the domain's layout, the cube's dilation, the contour. All arrays hold
/// shape.word_count() words, flags of cells one word per quad (a byte is 0xff where the cell holds a set voxel).
namespace bp {

/// A dense box of words elsewhere (a BitBox on the device), and where its first word lies in the domain.
struct BoxOfWords {
  std::int32_t words = 0, ny = 0, nz = 0;  ///< 32-bit words per row
  std::int32_t w0 = 0, y0 = 0, z0 = 0;     ///< position in the domain; may be negative
};

/// bits := the box's voxels, empty elsewhere; cells := flags (must be zero before).
void pack_bits(const std::uint32_t* from, const BoxOfWords& box, const GridShape& shape, std::uint32_t* bits,
               std::uint32_t* cells, cudaStream_t stream);
/// to := the domain's voxels of the box, cut to `keep`.
void unpack_bits(const std::uint32_t* bits, const GridShape& shape, const BoxOfWords& box, const VoxelRange& keep,
                 std::uint32_t* to, cudaStream_t stream);

/// table(w, y, z) := OR of bits over [y, y + length) x [z, z + length); length a power of two; `half` is scratch.
void window_table(const std::uint32_t* bits, const GridShape& shape, int length, std::uint32_t* half,
                  std::uint32_t* table, cudaStream_t stream);

/// The dilation by cubes of the radii r whose windows 2r+1 lie in [length, 2 length), from the table of that length:
/// D united with { p : r(p) >= r, the cube of radius r at p meets G } for each such r <= r(p). One call with the only
/// radius gives the whole of a constant dilation; varying fields need one call per length. Exact for p at least r(p)
/// away from the domain's lower faces.
///   first   true: out is overwritten; false: united with what is there
void dilate_cube(const std::uint32_t* table, int length, const std::uint32_t* bits, const GridShape& shape,
                 const VoxelRange& region, const ScaleView& scale, bool first, std::uint32_t* out, cudaStream_t stream);

/// contour := empty voxels with a 6-neighbour in bits; cells := its flags (must be zero before).
void outer_contour(const std::uint32_t* bits, const GridShape& shape, std::uint32_t* contour, std::uint32_t* cells,
                   cudaStream_t stream);

/// 0xff in each byte of a flag word whose byte of `v` is not zero.
[[nodiscard]] BP_HD inline std::uint32_t spread_bytes(std::uint32_t v) {
  v |= v >> 4;
  v |= v >> 2;
  v |= v >> 1;
  return (v & 0x01010101u) * 255u;
}

}  // namespace bp
