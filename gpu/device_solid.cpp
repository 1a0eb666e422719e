#include "gpu/device_solid.h"

#include <algorithm>

#include "gpu/kernels/device_error.h"
#include "gpu/kernels/tuning.h"
#include "lib/core/error.h"

namespace bp {

void DeviceSolid::voxelize(std::span<const FixedTriangle> triangles, BitBox& out, std::int64_t slack) {
  const VoxelBox box = out.box();
  if (box.empty() || triangles.empty()) return;
  const std::int64_t plane = std::int64_t(out.words_per_row()) * (box.max.y - box.min.y);
  std::int64_t slices = std::max<std::int64_t>(1, std::int64_t(kVoxelizeBytes / 8) / plane);
  for (std::int64_t z = box.min.z; z < box.max.z;) {
    VoxelBox part = box;
    part.min.z = std::int32_t(z);
    part.max.z = std::int32_t(std::min<std::int64_t>(z + slices, box.max.z));
    try {
      voxelize_part(triangles, slack, part, std::size_t(plane) * std::size_t(part.max.z - part.min.z),
                    out.row(box.min.y, part.min.z));
      z = part.max.z;
    } catch (const OutOfDeviceMemory&) {  // the device is fuller than expected, so smaller steps are taken
      slices = (part.max.z - part.min.z) / 2;
      if (slices == 0) throw;
      work_.make_room();
    }
  }
}

/// Voxelizes one part of a tile. `bits`: the words of `part` on the host, contiguous.
void DeviceSolid::voxelize_part(std::span<const FixedTriangle> triangles, std::int64_t slack, const VoxelBox& part,
                                std::size_t words, std::uint64_t* bits) {
  bits_.grow(2 * words);
  triangles_.grow(std::min(triangles.size(), kTriangleBatch));
  BP_CUDA_CHECK(cudaMemsetAsync(bits_.data(), 0, words * 8, work_.stream));
  for (std::size_t at = 0; at < triangles.size(); at += kTriangleBatch) {
    const std::size_t n = std::min(kTriangleBatch, triangles.size() - at);
    work_.staging.upload(triangles_.data(), triangles.data() + at, n * sizeof(FixedTriangle));
    voxelizer_.enqueue(triangles_.data(), std::uint32_t(n), slack, part, bits_.data(), work_.stream);
  }
  work_.staging.download_bits(bits, bits_.data(), words);
}

void DeviceSolid::find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile,
                                 std::vector<Crossing>& out) {
  if (tile.empty()) return;
  // Kernels count crossings in 32 bits. A triangle crosses each column at most once, so a batch of kCountedCrossings /
  // columns triangles cannot overflow the count.
  const std::uint64_t columns = std::uint64_t(tile.size().x) * std::uint64_t(tile.size().y);
  const std::size_t most = std::size_t(std::clamp<std::uint64_t>(kCountedCrossings / columns, 1, kTriangleBatch));
  if (columns > kCountedCrossings) fail(ErrorCode::bad_argument, "a tile of {} columns is too wide", columns);
  for (std::size_t at = 0; at < triangles.size(); at += most)
    find_in_batch(triangles.subspan(at, std::min(most, triangles.size() - at)), tile, out);
}

/// Finds the crossings of a batch. If they are too many for the device, or for one batch, the batch is halved.
void DeviceSolid::find_in_batch(std::span<const FixedTriangle> triangles, const VoxelBox& tile,
                                std::vector<Crossing>& out) {
  try {
    if (find_at_once(triangles, tile, out)) return;
  } catch (const OutOfDeviceMemory&) {
    if (triangles.size() == 1) throw;
    work_.make_room();
  }
  const std::size_t half = triangles.size() / 2;
  find_in_batch(triangles.first(half), tile, out);
  find_in_batch(triangles.subspan(half), tile, out);
}

/// Finds all crossings in one run. If there are more than kCrossingBatch, it runs again with room for all of them.
/// Returns false, with `out` unchanged, if several triangles have more than kMostCrossings; the caller then halves the
/// batch.
bool DeviceSolid::find_at_once(std::span<const FixedTriangle> triangles, const VoxelBox& tile,
                               std::vector<Crossing>& out) {
  work_.staging.upload(triangles_.grow(triangles.size()), triangles.data(), triangles.size_bytes());
  std::uint32_t capacity = kCrossingBatch, found = 0;
  for (;;) {
    winding_.find(triangles_.data(), std::uint32_t(triangles.size()), tile, crossings_.grow(capacity), capacity,
                  count_.grow(1), work_.stream);
    work_.staging.download(&found, count_.data(), sizeof(found));
    if (found <= capacity) break;
    if (found > kMostCrossings && triangles.size() > 1) return false;
    capacity = found;
  }
  const std::size_t old = out.size();
  out.resize(old + found);
  work_.staging.download(out.data() + old, crossings_.data(), found * sizeof(Crossing));
  return true;
}

void DeviceSolid::fill_winding(std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                               std::span<std::int32_t> numbers, BitBox& bits) {
  if (bits.box().empty()) return;
  if (crossings.size() <= kMostCrossings) {
    try {
      return fill_on_device(crossings, skip, numbers, bits);
    } catch (const OutOfDeviceMemory&) {  // nothing has come back yet
      work_.make_room();
    }
  }
  bp::fill_winding(crossings, bits.box(), skip, numbers, bits);
}

/// Fills on the device. If it throws OutOfDeviceMemory, `numbers` and `bits` are untouched.
void DeviceSolid::fill_on_device(const std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                                 std::span<std::int32_t> numbers, BitBox& bits) {
  Staging& staging = work_.staging;
  staging.upload(crossings_.grow(crossings.size()), crossings.data(), crossings.size() * sizeof(Crossing));
  staging.upload(numbers_.grow(numbers.size()), numbers.data(), numbers.size_bytes());
  if (!skip.empty()) staging.upload(skip_.grow(2 * skip.size()), skip.data(), skip.size_bytes());
  bits_.grow(2 * std::size_t(bits.word_count()));
  winding_.fill(crossings_.data(), std::uint32_t(crossings.size()), bits.box(), skip.empty() ? nullptr : skip_.data(),
                numbers_.data(), bits_.data(), work_.stream);
  staging.download_bits(bits.data(), bits_.data(), std::size_t(bits.word_count()));
  staging.download(numbers.data(), numbers_.data(), numbers.size_bytes());
}

void DeviceSolid::release() {
  voxelizer_.release();
  winding_.release();
  triangles_.release();
  crossings_.release();
  numbers_.release();
  for (auto* b : {&bits_, &skip_, &count_}) b->release();
}

}  // namespace bp
