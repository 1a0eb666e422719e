#pragma once
#include <optional>

#include "lib/levels/detail/ruler.h"
#include "lib/levels/lod_level.h"

namespace bp {

/// Keeps the best of the meshes that are proposed for one level. A mesh that has at most the faces asked for is better
/// than one that has more. Between two that do, or two that do not, the mesh of the lower price is better.
///
/// The price of a bounding mesh is its error times its volume: either may grow by a tenth where the other one falls by
/// a tenth. An eighth of a voxel is added to the error, and a skin of that thickness to the volume, since nobody sees
/// smaller differences. The price of a fit is its error alone.
class BestLevel {
 public:
  /// faces: the number asked for; 0: none. Keeps a reference to `ruler`.
  BestLevel(const Ruler& ruler, MeshMode mode, std::uint64_t faces) : ruler_(ruler), mode_(mode), faces_(faces) {}

  /// Measures a mesh that was made in this way, and keeps it if it is better than all meshes before. The measurement
  /// ends as soon as the mesh is known not to be better. Returns whether it was kept.
  bool propose(const char* way, LodLevel level);
  /// Measures the level, and keeps it only if its error is at most an eighth of a voxel: then no other mesh need be
  /// proposed.
  bool propose_exact(const char* way, const LodLevel& level);

  [[nodiscard]] const LodLevel& level() const { return *level_; }
  /// Returns whether the best mesh has an error of at most an eighth of a voxel.
  [[nodiscard]] bool is_exact() const { return level_ && level_->error_world <= unseen(); }
  /// Returns the best mesh with its error, its price and the list of all meshes that were tried. At least one was
  /// proposed.
  [[nodiscard]] LodLevel take();

 private:
  [[nodiscard]] double unseen() const;
  [[nodiscard]] double weight(const LodLevel& level) const;
  [[nodiscard]] double most_error(const LodLevel& level) const;
  void note(const char* way, const LodLevel& level, double error);
  void keep(LodLevel level, double error);

  const Ruler& ruler_;
  MeshMode mode_;
  std::uint64_t faces_;
  std::optional<LodLevel> level_;
  std::vector<TriedWay> tried_;
};

}  // namespace bp
