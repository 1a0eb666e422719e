#pragma once
#include <vector>

#include "gpu/device_work.h"
#include "gpu/kernels/bit_kernels.h"
#include "lib/grid/stream.h"

namespace bp {

/// The bricks of a tile on their way to a GPU and back. Only bricks that are neither empty nor full travel.
class DeviceBricks {
 public:
  explicit DeviceBricks(DeviceWork work) : work_(std::move(work)) {}

  /// Uploads the bricks of a shelf that lie in the box `seen`. `where`: place of the box in the tile's domain.
  BrickTable upload(const BrickShelf& solid, const BrickBox& seen, const BoxOfWords& where);
  /// Returns an empty table with room for all bricks of the box, to be filled on the device.
  BrickTable room_for(const BrickBox& made, const BoxOfWords& where);
  /// Returns the place on the device, behind a table of room_for(), of the number of bricks that travel.
  [[nodiscard]] static std::uint32_t* count_of(const BrickTable& table);
  /// Puts the bricks of `table`, which the device has filled, into `closed`, which is empty.
  void download(const BrickTable& table, const BrickBox& made, BitBox& closed);
  /// Frees all device memory.
  void release();

 private:
  DeviceWork work_;
  std::vector<std::uint32_t> slots_;  // on the host: where each brick is
  DeviceBuffer<std::uint32_t> in_, out_, in_slots_, out_slots_;
};

}  // namespace bp
