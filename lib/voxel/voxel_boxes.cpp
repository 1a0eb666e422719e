#include "lib/voxel/voxel_boxes.h"

#include <cstring>

#include "lib/core/clones.h"

namespace bp {

namespace {

/// x, y, z, and the number that follows in memory, which is not used.
typedef double Four __attribute__((vector_size(32)));
typedef std::int32_t FourInts __attribute__((vector_size(16)));

/// Nearest integers of |x| < 2^51, as round_to_integer().
BP_INLINE void round_to_integers(Four& x) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
  x = (x + kShift) - kShift;
}

/// Fixed point as FixedFrame makes it, in doubles: all of it below 2^53.
BP_INLINE void load_fixed(const double* from, const Four& origin, double voxel, Four& out) {
  std::memcpy(&out, from, sizeof out);
  out = (out - origin) / voxel * double(kFixedOne);
  round_to_integers(out);
}

/// Voxels of whole fixed-point numbers.
BP_INLINE void store_coord(const Four& fixed, VoxelCoord& out) {
  const Four voxels = fixed * (1.0 / double(kFixedOne));
  Four whole = voxels;
  round_to_integers(whole);
  whole -= voxels < whole ? Four{1, 1, 1, 1} : Four{};
  const FourInts ints = __builtin_convertvector(whole, FourInts);
  out = {ints[0], ints[1], ints[2]};
}

/// `corners`: nine coordinates, and a tenth number that is read and not used.
BP_INLINE void store_box(const double* corners, const Four& origin, double voxel, double slack, VoxelBox& out) {
  Four a, b, c;
  load_fixed(corners, origin, voxel, a);
  load_fixed(corners + 3, origin, voxel, b);
  load_fixed(corners + 6, origin, voxel, c);
  Four low = a < b ? a : b, high = a < b ? b : a;
  low = c < low ? c : low;
  high = high < c ? c : high;
  store_coord(low - (slack + 1), out.min);
  store_coord(high + (slack + double(kFixedOne)), out.max);
}

BP_CLONES void store_boxes(const double* corners, std::size_t n, const double* world_origin, double voxel, double slack,
                           VoxelBox* out) {
  const Four origin{world_origin[0], world_origin[1], world_origin[2], 0};
  for (std::size_t i = 0; i < n; ++i) store_box(corners + 9 * i, origin, voxel, slack, out[i]);
}

}  // namespace

void voxel_boxes(std::span<const TriangleD> triangles, const GridFrame& frame, std::int64_t slack, VoxelBox* out) {
  if (triangles.empty()) return;
  const Vec3d origin = frame.world_origin();
  const std::size_t n = triangles.size() - 1;
  store_boxes(triangles[0][0].data(), n, origin.data(), frame.voxel, double(slack), out);
  double last[10]{};  // the last triangle, since no number follows it in memory
  std::memcpy(last, &triangles[n], sizeof(TriangleD));
  store_boxes(last, 1, origin.data(), frame.voxel, double(slack), out + n);
}

}  // namespace bp
