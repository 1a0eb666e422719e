#pragma once
#include <span>
#include <string>
#include <vector>

#include "lib/closing/closing.h"
#include "lib/deform/weight_block.h"
#include "lib/device/backends.h"
#include "lib/grid/stream.h"

/// The operations on tiles and on cages' coordinates that CpuBackend and CudaBackend implement. Each worker thread has
/// one Backend. It owns its scratch (on a GPU: its stream and buffers), allocated on the first call and kept. Results
/// do not depend on threads, tile size or backend. A failure of a device is a DeviceError; what the call should have
/// changed is then undefined.
namespace bp {

class Backend {
 public:
  virtual ~Backend() = default;
  [[nodiscard]] virtual std::string name() const = 0;  ///< "cpu", "cuda:0 NVIDIA H100 80GB HBM3"
  /// Returns the bytes of page-locked host memory that the backend holds, in addition to the memory of its calls.
  [[nodiscard]] virtual std::uint64_t pinned_bytes() const { return 0; }

  /// Does what close_tile() in lib/closing/closing.h does.
  virtual void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                     const VoxelBox& interior, BitBox& closed) = 0;

  /// Closes a tile whose solid voxels are on a shelf, all of them in `bricks`. A GPU transfers only bricks that are
  /// neither empty nor full. By default the tile and its halo are loaded into a box.
  virtual void close_from_shelf(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale,
                                const Halo& halo, const ClosingParams& params, const VoxelBox& interior,
                                BitBox& closed);

  /// Does what weigh_points() in lib/deform/weight_block.h does. A GPU leaves points on the cage and outside to the
  /// calling thread.
  virtual void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
                     WeightBlock& out, std::span<CoordinateRows::Place> places) = 0;

 private:
  BitBox loaded_;  ///< box of close_from_shelf(); kept
};

}  // namespace bp
