#pragma once
#include <memory>

#include "lib/tileset/tileset.h"

/// Decides whether a volume by which viewers cull holds what is drawn. Exact for the numbers of the file: there is no
/// tolerance. Only if a sphere is scaled or touches a slanted side is a length rounded, to the safe side. Nothing
/// beyond 1e60, or with coordinates below 1e-60, is held.
namespace bp {

class VolumeProof {
 public:
  /// A volume with neither a box nor a sphere holds everything.
  explicit VolumeProof(const TileVolume& volume);
  ~VolumeProof();
  VolumeProof(const VolumeProof&) = delete;
  VolumeProof& operator=(const VolumeProof&) = delete;

  /// Tests a point in the volume's own space.
  [[nodiscard]] bool holds(const Vec3d& p) const;
  /// Tests a volume of a space from which `m` leads here: true if each of its parts is held.
  [[nodiscard]] bool holds(const TileVolume& inner, const Transform& m) const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

/// Returns about how far p lies outside, as a share of the volume's size; 0 inside. For messages.
[[nodiscard]] double beyond(const TileVolume& volume, const Vec3d& p);

}  // namespace bp
