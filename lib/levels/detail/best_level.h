#pragma once
#include <optional>
#include <string>

#include "lib/levels/detail/ruler.h"
#include "lib/levels/lod_level.h"

namespace bp {

/// The best of the meshes that are proposed for one level. A mesh that has at most the faces asked for is better than
/// one that has more. Else the one of the lower price is better.
///
/// The price of a mesh is its error times its volume: either may grow by a tenth where the other one falls by a tenth.
/// An eighth of a voxel is added to the error, and a skin of that thickness to the volume, so that nothing is paid for
/// differences that nobody sees. Of fits, the error alone counts.
class BestLevel {
 public:
  /// faces: asked for; 0: none. Keeps a reference to `ruler`.
  BestLevel(const Ruler& ruler, MeshMode mode, std::uint64_t faces) : ruler_(ruler), mode_(mode), faces_(faces) {}

  /// Proposes a mesh, which was made in this way: measures it, as far as it takes to know whether it is better than
  /// what was proposed before, and keeps it if it is. Returns whether it was kept.
  bool propose(const char* way, LodLevel level);
  /// The same, and it is kept only if its error is not worth mentioning: then no other mesh need be proposed.
  bool propose_exact(const char* way, const LodLevel& level);

  [[nodiscard]] const LodLevel& level() const { return *level_; }
  /// Whether its error is not worth mentioning.
  [[nodiscard]] bool is_exact() const { return level_ && level_->error_world <= unseen(); }
  /// The best mesh, with all that is measured of a level.
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
