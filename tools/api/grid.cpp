#include "tools/api/grid.h"

#include <algorithm>
#include <cstring>

#include "io/stream/brick_shelf.h"
#include "io/stream/brick_tally.h"
#include "lib/core/error.h"
#include "tools/api/call.h"
#include "tools/api/structs.h"
#include "tools/run/memory_shares.h"

namespace bp::api {

const StreamTotals& VoxelGrid::totals() const {
  std::call_once(counted_, [&] {
    ShelfSource source = open();
    totals_ = totals_of(source);
  });
  return totals_;
}

const std::string& VoxelGrid::rules() const {
  std::call_once(written_, [&] {
    if (header.has_field || header.has_closing) rules_ = to_json(header.scale);
  });
  return rules_;
}

const BrickShelf* VoxelGrid::layer(std::int32_t layer) const {
  if (layer != BP_SOLID && layer != BP_CLOSING) fail(ErrorCode::bad_argument, "layer: {} is none of its values", layer);
  return layer == BP_SOLID ? solid.get() : closing.get();
}

namespace {

std::shared_ptr<const VoxelGrid> load(const char* path, Call& call) {
  BrickReader reader(file_name(path));
  call.begin("reading");
  const ShelfFactory shelves =
      make_shelf_factory(UsableMemory(call.common().memory_bytes, kVoxelProgram).bytes / 2, call.common().temp);
  auto grid = std::make_shared<VoxelGrid>();
  grid->header = reader.header();
  grid->solid = shelves();
  if (grid->header.has_closing) grid->closing = shelves();
  ShelfSink sink(grid->solid.get(), grid->closing.get());
  for (Brick brick; reader.read(brick);) {
    stop_if_asked();
    sink.write(brick);
  }
  return grid;
}

void write(const VoxelGrid& grid, OutputFile& file, Call& call) {
  call.begin("writing");
  BrickWriter writer(file, grid.header);
  ShelfSource source = grid.open();
  for (Brick brick; source.read(brick);) {
    stop_if_asked();
    writer.write(brick);
  }
  writer.finish();
  file.commit();
}

bp_grid_info info_of(const VoxelGrid& grid) {
  const StreamHeader& h = grid.header;
  bp_grid_info info{};
  info.voxel = h.frame.voxel;
  const Vec3d origin = h.frame.world_origin();
  const VoxelBox box = voxels_of(h.bricks);
  const std::int32_t min[3] = {box.min.x, box.min.y, box.min.z}, max[3] = {box.max.x, box.max.y, box.max.z};
  for (std::size_t i = 0; i < 3; ++i) {
    info.origin[i] = origin[i];
    info.min[i] = min[i];
    info.max[i] = max[i];
    info.bounds_min[i] = h.bounds.min[i];
    info.bounds_max[i] = h.bounds.max[i];
  }
  info.has_closing = h.has_closing ? 1 : 0;
  info.fill = std::int32_t(h.fill);
  info.up = std::int32_t(h.frame.up) + BP_UP_Y;
  if (h.has_closing && h.scale.constant()) info.scale = h.scale.base;
  for (std::size_t i = 0; i < 2; ++i) {
    info.bricks[i] = grid.totals().layers[i].bricks;
    info.voxels[i] = grid.totals().layers[i].voxels;
  }
  info.rules = grid.rules().c_str();
  return info;
}

VoxelBox box_of(const std::int32_t min[3], const std::int32_t extent[3]) {
  (void)needed(min, "min");
  (void)needed(extent, "extent");
  VoxelBox box{{min[0], min[1], min[2]}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    if (extent[i] < 0 || std::int64_t(min[i]) + extent[i] > INT32_MAX)
      fail(ErrorCode::bad_argument, "a box of {} voxels from {} on is no box of the grid", extent[i], min[i]);
  }
  box.max = {min[0] + extent[0], min[1] + extent[1], min[2] + extent[2]};
  return box;
}

/// Copies the part of `box` that lies in one brick.
void copy_bytes(const BrickBits& bits, const VoxelBox& brick, const VoxelBox& box, std::uint8_t* out) {
  const VoxelBox part = intersect(brick, box);
  const std::size_t nx = std::size_t(box.max.x - box.min.x), ny = std::size_t(box.max.y - box.min.y);
  for (std::int32_t z = part.min.z; z < part.max.z; ++z) {
    for (std::int32_t y = part.min.y; y < part.max.y; ++y) {
      const std::uint64_t word = bits[std::size_t(z - brick.min.z) * kBrickEdge + std::size_t(y - brick.min.y)];
      std::uint8_t* const row = out + (std::size_t(z - box.min.z) * ny + std::size_t(y - box.min.y)) * nx;
      for (std::int32_t x = part.min.x; x < part.max.x; ++x)
        row[x - box.min.x] = std::uint8_t((word >> (x - brick.min.x)) & 1);
    }
  }
}

void read_dense(const BrickShelf* shelf, const VoxelBox& box, std::uint8_t* out) {
  std::memset(&needed(out, "the result"), 0, std::size_t(box.volume()));
  if (shelf == nullptr || box.empty()) return;
  BrickBits bits;
  for_each(bricks_of(box), [&](const BrickCoord& coord) {
    if (shelf->fill(coord) == BrickFill::empty) return;
    (void)shelf->get(coord, bits);
    const VoxelCoord first = first_voxel(coord);
    copy_bytes(bits, {first, {first.x + kBrickEdge, first.y + kBrickEdge, first.z + kBrickEdge}}, box, out);
  });
}

std::size_t list_bricks(const BrickShelf* shelf, std::int32_t* coords, std::size_t capacity) {
  if (shelf == nullptr) return 0;
  const std::vector<BrickCoord> all = shelf->coords();
  if (capacity > 0) (void)needed(coords, "the array of coordinates");
  for (std::size_t i = 0; i < std::min(capacity, all.size()); ++i) {
    coords[3 * i] = all[i].x;
    coords[3 * i + 1] = all[i].y;
    coords[3 * i + 2] = all[i].z;
  }
  return all.size();
}

/// Returns the layer of a caller as a number, since C allows any, and a value that bp_layer does not have must not be
/// read as one.
std::int32_t number_of(const bp_layer& layer) {
  static_assert(sizeof layer == sizeof(std::int32_t));
  std::int32_t number = 0;
  std::memcpy(&number, &layer, sizeof number);
  return number;
}

}  // namespace

}  // namespace bp::api

using namespace bp::api;

extern "C" {

bp_status bp_grid_load(const char* path, const bp_run* run, bp_grid** out) {
  return guarded_result(run, out, [&](Call& call) { return load(path, call); });
}

bp_status bp_grid_save(const bp_grid* grid, const char* path, int overwrite, const bp_run* run) {
  return guarded_call(run, [&](Call& call) {
    bp::OutputFile file(file_name(path), overwrite != 0);
    write(*needed(grid, "grid").grid, file, call);
  });
}

bp_status bp_grid_write(const bp_grid* grid, bp_sink_fn sink, void* user, const bp_run* run) {
  return guarded_call(
      run, [&](Call& call) { write(*needed(grid, "grid").grid, *output_of(sink, user, "the stream"), call); });
}

bp_status bp_grid_read_info(const bp_grid* grid, bp_grid_info* info, size_t size) {
  return guarded([&] { put_struct(info, size, info_of(*needed(grid, "grid").grid)); });
}

bp_status bp_grid_read(const bp_grid* grid, bp_layer layer, const int32_t min[3], const int32_t extent[3],
                       uint8_t* out) {
  return guarded([&] { read_dense(needed(grid, "grid").grid->layer(number_of(layer)), box_of(min, extent), out); });
}

bp_status bp_grid_bricks(const bp_grid* grid, bp_layer layer, int32_t* coords, size_t capacity, size_t* count) {
  return guarded([&] {
    needed(count, "count") = list_bricks(needed(grid, "grid").grid->layer(number_of(layer)), coords, capacity);
  });
}

bp_status bp_grid_brick(const bp_grid* grid, bp_layer layer, const int32_t coord[3], uint64_t bits[4096]) {
  return guarded([&] {
    const bp::BrickShelf* const shelf = needed(grid, "grid").grid->layer(number_of(layer));
    (void)needed(coord, "coord");
    bp::BrickBits out{};
    if (shelf != nullptr) (void)shelf->get({coord[0], coord[1], coord[2]}, out);
    std::memcpy(&needed(bits, "bits"), out.data(), sizeof out);
  });
}

void bp_grid_free(bp_grid* grid) {
  delete grid;
}

}  // extern "C"
