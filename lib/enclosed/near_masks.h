#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>

#include "lib/enclosed/enclosed.h"
#include "lib/grid/stream.h"

namespace bp {

/// Answers what is near a set of voxels by masks: the voxels grown by a distance (lib/volume/dilate_ball.h). A mask is
/// made when its distance is first asked for, and serves all later questions. Masks for long distances or many voxels
/// have larger voxels, so that each takes some 16 MiB. Thread-safe.
class NearMasks {
 public:
  /// `voxels` must outlive it.
  explicit NearMasks(const BrickShelf& voxels) : voxels_(voxels) {}
  ~NearMasks();
  NearMasks(const NearMasks&) = delete;
  NearMasks& operator=(const NearMasks&) = delete;

  /// Returns whether all points of the faces are within `distance`, lattice units, of the voxels. The answer may be
  /// wrong, to either side, by the diagonal of two of the mask's voxels. Cost: the mask's voxels around each piece of a
  /// face. Pieces are quartered until all voxels around a piece are set, or one around a piece of a voxel's size is
  /// not.
  [[nodiscard]] bool is_near(std::span<const NewFace> faces, double distance) const;
  /// Returns the same for all points of the edge from a to b.
  [[nodiscard]] bool is_near(const LatticeCoord& a, const LatticeCoord& b, double distance) const;
  void prepare(double distance) const { static_cast<void>(mask(distance)); }  ///< makes the mask for the distance
  [[nodiscard]] std::uint64_t bytes() const;                                  ///< bytes of all masks so far
  /// Returns about the most bytes that a mask of such voxels takes.
  [[nodiscard]] static std::uint64_t bytes_of_mask(const BrickShelf& voxels);

 private:
  class Mask;
  struct Entry;
  [[nodiscard]] Entry& entry(double distance) const;
  [[nodiscard]] const Mask& mask(double distance) const;

  const BrickShelf& voxels_;
  mutable std::mutex adding_;                     // an entry, not the mask in it
  mutable std::atomic<Entry*> entries_{nullptr};  // a linked list, the last one added first
};

}  // namespace bp
