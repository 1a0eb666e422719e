#include "gpu/device_tiles.h"

#include <fmt/format.h>

#include "gpu/kernels/device_error.h"
#include "gpu/kernels/tuning.h"

namespace bp {

namespace {

/// Returns the longest axis along which a tile can be divided into two parts that are closed separately; -1 if there is
/// none.
int longest_divisible_axis(const VoxelBox& tile) {
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    const bool divisible = tile.size()[i] >= 2 * (i == 0 ? kBrickEdge : kUnit);
    if (divisible && (axis < 0 || tile.size()[i] >= tile.size()[axis])) axis = i;
  }
  return axis;
}

}  // namespace

void DeviceTiles::close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                        const VoxelBox& interior, BitBox& closed) {
  closed.reset(interior);
  if (interior.empty()) return;
  try {
    close_at_once(solid, scale, halo, params, interior, closed);
  } catch (const OutOfDeviceMemory&) {
    work_.make_room();
    close_in_halves(solid, scale, halo, params, interior, closed);
  }
}

void DeviceTiles::close_at_once(const BitBox& solid, const ScaleLattice& scale, const Halo& halo,
                                const ClosingParams& params, const VoxelBox& interior, BitBox& closed) {
  const TileLayout layout = lay_out(solid.box(), scale, halo, interior);
  const std::size_t words_in = std::size_t(solid.word_count()) * 2, words_out = std::size_t(closed.word_count()) * 2;
  in_.grow(words_in);
  out_.grow(words_out);
  work_.staging.upload(in_.data(), solid.data(), words_in * 4);
  CubesOver cubes;
  const TileField field = upload_field(scale, params, interior.grown(halo.erosion_vox), layout, cubes);
  closing_.enqueue(layout, in_.data(), field, out_.data(), work_.stream);
  work_.staging.download(closed.data(), out_.data(), words_out * 4);
}

/// Closes a tile that is too large for the device: each half of the interior with the part of the solid that it needs.
void DeviceTiles::close_in_halves(const BitBox& solid, const ScaleLattice& scale, const Halo& halo,
                                  const ClosingParams& params, const VoxelBox& interior, BitBox& closed) {
  VoxelBox lower = interior, upper = interior;
  const int axis = longest_divisible_axis(interior);
  if (axis < 0) {
    throw DeviceError(fmt::format("{}: not enough device memory for a tile of {} x {} x {} voxels", work_.device,
                                  interior.size().x, interior.size().y, interior.size().z));
  }
  const std::int32_t unit = axis == 0 ? kBrickEdge : kUnit;  // along x whole words are needed
  lower.max[axis] = upper.min[axis] = floor_div(interior.min[axis] + (interior.size()[axis] + unit) / 2, unit) * unit;
  for (const VoxelBox& half : {lower, upper}) {
    BitBox part_solid(intersect(half.grown(halo.total_vox()), solid.box())), part_closed;
    copy_voxels(solid, part_solid);
    close(part_solid, scale, halo, params, half, part_closed);
    copy_voxels(part_closed, closed);
  }
}

void DeviceTiles::close_bricks(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale,
                               const Halo& halo, const ClosingParams& params, const VoxelBox& interior,
                               BitBox& closed) {
  const BrickBox seen = intersect(bricks_of(interior.grown(halo.total_vox())), bricks), made = bricks_of(interior);
  if (seen.empty()) return closed.reset(interior);
  const TileLayout layout = lay_out(voxels_of(seen), scale, halo, interior);
  const BrickTable in = bricks_.upload(solid, seen, layout.solid);
  CubesOver cubes;
  const TileField field = upload_field(scale, params, interior.grown(halo.erosion_vox), layout, cubes);
  const BrickTable out = bricks_.room_for(made, layout.closed);
  closing_.enqueue(layout, in, field, out, DeviceBricks::count_of(out), work_.stream);
  closed.reset(interior);
  bricks_.download(out, made, closed);
}

/// Uploads the scale and the cubes. It sets `cubes`, which must live as long as the field.
TileField DeviceTiles::upload_field(const ScaleLattice& scale, const ClosingParams& params, const VoxelBox& dilated,
                                    const TileLayout& layout, CubesOver& cubes) {
  TileField field{scale, nullptr, params.element};
  if (!scale.constant()) field.samples = upload(scale.samples, samples_);
  if (params.turned()) cubes = cubes_over(*params.orientation, dilated);
  if (!cubes.widest.turned) return field;
  field.cubes = &cubes;
  field.cubes_there = view_of(cubes, layout, scale);
  field.cubes_there.rotations = upload(cubes.rotations, rotations_);
  field.cubes_there.cells = upload(cubes.cells, rotation_of_cell_);
  return field;
}

void DeviceTiles::release() {
  bricks_.release();
  closing_.release();
  for (auto* b : {&in_, &out_}) b->release();
  samples_.release(), rotations_.release(), rotation_of_cell_.release();
}

}  // namespace bp
