#pragma once
#include "lib/device/backend.h"
#include "lib/pass/close/earlier_closing.h"

namespace bp {

/// The tiles of a closing that stay what they were in an earlier one, because no scale in their reach has changed.
/// Nothing else decides about a voxel, so the earlier tiles may have been others. Thread-safe.
class EarlierTiles {
 public:
  static constexpr std::int32_t kMostVox = 128;  ///< edge: the smaller tiles are, the more of them stay

  /// `earlier` may be null: no tile stays. Keeps references.
  EarlierTiles(const EarlierClosing* earlier, const ScaleField& scale, const GridFrame& frame,
               const ClosingParams& params);
  /// Returns true unless the scale has changed everywhere.
  [[nodiscard]] bool mostly_stays() const;
  [[nodiscard]] bool stays(const VoxelBox& tile) const;
  /// Loads a tile that stays, as it was before its cavities were filled.
  void load(const VoxelBox& tile, BitBox& closed) const;

 private:
  const EarlierClosing* const earlier_;
  const ScaleField& scale_;
  const GridFrame frame_;
  std::int32_t reach_vox_ = 0;  ///< no scale beyond it decides about a tile, neither now nor then
};

}  // namespace bp
