#pragma once
#include <vector>

#include "gpu/device_bricks.h"
#include "gpu/device_closing.h"
#include "gpu/device_work.h"

namespace bp {

/// The closing of tiles that lie on the host: Backend::close(), and close_from_shelf() for whole bricks.
class DeviceTiles {
 public:
  DeviceTiles(const DeviceWork& work, const ClosingTuning& tuning) : work_(work), bricks_(work), closing_(tuning) {}

  /// Closes a tile; one that is too large for the device by halves.
  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed);
  /// Closes bricks, both ways. `interior` is whole bricks. Throws OutOfDeviceMemory, with `closed` undefined.
  void close_bricks(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale, const Halo& halo,
                    const ClosingParams& params, const VoxelBox& interior, BitBox& closed);
  /// Frees all device memory.
  void release();

 private:
  void close_at_once(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                     const VoxelBox& interior, BitBox& closed);
  void close_in_halves(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                       const VoxelBox& interior, BitBox& closed);
  TileField upload_field(const ScaleLattice& scale, const ClosingParams& params, const VoxelBox& dilated,
                         const TileLayout& layout, CubesOver& cubes);
  template <class T>
  const T* upload(const std::vector<T>& from, DeviceBuffer<T>& to) {
    work_.staging.upload(to.grow(from.size()), from.data(), from.size() * sizeof(T));
    return to.data();
  }

  DeviceWork work_;
  DeviceBricks bricks_;
  DeviceClosing closing_;
  DeviceBuffer<std::uint32_t> in_, out_;
  DeviceBuffer<Scale> samples_;
  DeviceBuffer<Rotation> rotations_;
  DeviceBuffer<std::uint16_t> rotation_of_cell_;
};

}  // namespace bp
