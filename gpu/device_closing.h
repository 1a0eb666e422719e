#pragma once
#include <cuda_runtime.h>

#include <functional>

#include "gpu/kernels/bit_kernels.h"
#include "gpu/kernels/device_buffer.h"
#include "gpu/kernels/distance_kernels.h"
#include "gpu/kernels/turned_kernels.h"
#include "lib/closing/closing.h"

/// The closing of one tile whose voxels are on the device already. It is a fixed sequence of kernels on one stream,
/// without allocation once the sizes are known, and without synchronisation with the host. The bits are those of
/// lib/closing/closing.h.
namespace bp {

/// The place of a tile on the device, computed on the host from its boxes.
struct TileLayout {
  GridShape shape;
  BoxOfWords solid, closed;             ///< the caller's boxes in the domain
  VoxelRange dilated, interior;         ///< where D is needed, and where E is needed
  std::int32_t ox = 0, oy = 0, oz = 0;  ///< sample of the scale lattice at voxel (0,0,0) of the domain
};
/// Lays out a tile. Throws OutOfDeviceMemory if the domain has 2^31 words or more.
[[nodiscard]] TileLayout lay_out(const VoxelBox& solid, const ScaleLattice& scale, const Halo& halo,
                                 const VoxelBox& interior);

/// Returns where the cubes of a tile lie in its domain. Their numbers must still be copied to the device.
[[nodiscard]] CubeView view_of(const CubesOver& cubes, const TileLayout& layout, const ScaleLattice& scale);

struct ClosingTuning {
  int multiprocessors = 1;
  std::size_t slab_bytes = 0;  ///< memory for distances; at least one word of columns is taken
  bool wide = false;           ///< 32-bit distances even where 16 bits suffice
};

/// The scale and the cubes at each voxel of a tile.
struct TileField {
  const ScaleLattice& scale;  ///< bounds and shape
  const Scale* samples;       ///< the samples on the device; unused if the scale is constant
  StructuringElement element;
  const CubesOver* cubes = nullptr;  ///< turned cubes over the dilation; null: none is turned
  CubeView cubes_there{};            ///< the same cubes on the device
};

class DeviceClosing {
 public:
  /// Called between the stages with their names, for measurements.
  using Mark = std::function<void(const char* stage)>;

  explicit DeviceClosing(const ClosingTuning& tuning) : tuning_(tuning) {}

  /// Enqueues the closing of a tile. All pointers to the device must stay valid until the stream has passed.
  void enqueue(const TileLayout& layout, const std::uint32_t* solid, const TileField& field, std::uint32_t* closed,
               cudaStream_t stream, const Mark& mark = {});
  /// Enqueues the closing from bricks into bricks. `closed` has room for the whole interior, which is whole bricks.
  ///   count  out: number of bricks of `closed` that are neither empty nor full
  void enqueue(const TileLayout& layout, const BrickTable& solid, const TileField& field, const BrickTable& closed,
               std::uint32_t* count, cudaStream_t stream);

  /// Frees all device memory.
  void release();

 private:
  struct Transform {
    bool erosion;
    TransformBounds bounds;
    const std::uint32_t *seeds, *seed_cells;
    std::uint8_t* wanted;
    VoxelRange region;
    std::uint32_t* out;
  };
  void grow(const TileLayout& layout);
  void start(const TileLayout& layout, cudaStream_t stream);
  [[nodiscard]] const std::uint32_t* close(const TileLayout& layout, const TileField& field, cudaStream_t stream,
                                           const Mark& mark);
  [[nodiscard]] const std::uint32_t* dilate(const TileLayout& layout, const TileField& field, const ScaleView& view,
                                            TransformBounds bounds, cudaStream_t stream, const Mark& mark);
  [[nodiscard]] WindowTables windows(const GridShape& shape, int least, int most, cudaStream_t stream);
  void dilate_by_cube(const TileLayout& layout, const ScaleLattice& scale, const ScaleView& view, cudaStream_t stream);
  void dilate_by_turned_cubes(const TileLayout& layout, const TileField& field, const ScaleView& view,
                              cudaStream_t stream, const Mark& mark);
  void transform(const TileLayout& layout, const ScaleView& view, const Transform& t, cudaStream_t stream,
                 const Mark& mark);
  void transform_slabs(const TileLayout& layout, const ScaleView& view, const Transform& t, const CellAnswers& answers,
                       cudaStream_t stream, const Mark& done);
  [[nodiscard]] int slab_words(const TileLayout& layout, const TransformBounds& bounds, int words);

  ClosingTuning tuning_;
  DeviceBuffer<std::uint32_t> solid_, dilated_, contour_, closed_, tables_;
  DeviceBuffer<std::uint32_t>
      flags_;  ///< zeroed at the start of a tile: flags of the cells of G and of the contour, and wanted quads
  DeviceBuffer<std::uint32_t> answers_;
  DeviceBuffer<uint2> w_of_cells_;
  DeviceBuffer<std::uint8_t> cells_, values_, pass_flags_, columns_;
  DeviceBuffer<std::uint32_t> lists_;
  DeviceBuffer<WorkCounts> counts_;
};

}  // namespace bp
