#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>

#include "lib/enclosed/enclosed.h"
#include "lib/grid/stream.h"

namespace bp {

/// Tells what is near a set of voxels by masks: the voxels grown by a distance (lib/volume/dilate_ball.h). A mask is
/// made when its distance is asked for first, and serves all questions after that. For long distances, and where
/// there are many voxels, its own are larger: some 16 MiB are enough for each. Thread-safe.
class NearMasks {
 public:
  /// `voxels` must outlive it.
  explicit NearMasks(const BrickShelf& voxels) : voxels_(voxels) {}
  ~NearMasks();
  NearMasks(const NearMasks&) = delete;
  NearMasks& operator=(const NearMasks&) = delete;

  /// Whether all points of the faces are within `distance`, lattice units, of the voxels. Up to the diagonal of two of
  /// the mask's voxels the answer may be wrong to either side. Cost: a look at the mask's voxels around each piece of a
  /// face, which is quartered until all voxels around a piece are set, or one of a piece of their size is not.
  [[nodiscard]] bool is_near(std::span<const NewFace> faces, double distance) const;
  [[nodiscard]] std::uint64_t bytes() const;  ///< of the masks that were made

 private:
  struct Mask;
  [[nodiscard]] const Mask& mask(double distance) const;

  const BrickShelf& voxels_;
  mutable std::mutex making_;
  mutable std::atomic<const Mask*> masks_{nullptr};  // a list; the last one made comes first
};

}  // namespace bp
