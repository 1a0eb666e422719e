#pragma once
#include <memory>
#include <span>
#include <vector>

#include "lib/mesh/guard.h"

/// Bounds on the proxy as a whole (distance, volume) that each step of simplification and tightening keeps.
namespace bp {

using LatticeTriangle = std::array<LatticeCoord, 3>;

class StepLimits {
 public:
  virtual ~StepLimits() = default;
  /// A stage begins with a surface of this volume, six times, cubed lattice units: what was counted before may have
  /// been undone since, or erased.
  virtual void begin(int128 volume6) = 0;
  /// Asked last, right before the faces `before` give way to `after`, which have the same rim. True: every bound is
  /// kept, and the step is counted as taken.
  [[nodiscard]] virtual bool take(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after) = 0;
  /// While relaxed, volume is only counted; and distance does not matter if the first surface was beyond its limit.
  virtual void relax(bool on) = 0;
  /// Whether each step can be judged by itself: then parts of the surface can be changed at the same time.
  [[nodiscard]] virtual bool has_parts() const { return false; }
  /// The same bounds for steps on a part of the surface, on another thread, and what they saw there.
  [[nodiscard]] virtual std::unique_ptr<StepLimits> for_part() const { return nullptr; }
  virtual void add_part(const StepLimits& part) { static_cast<void>(part); }  ///< one of for_part()
  [[nodiscard]] virtual std::uint64_t bytes_of_part() const { return 0; }
  /// The largest distance that they allow, lattice units; 0 if they do not mind distances.
  [[nodiscard]] virtual double error_lattice() const { return 0; }
  /// Name of the bound that refused the last step that was refused; empty if none was.
  [[nodiscard]] virtual const char* last_refusal() const { return ""; }
};

/// take() for a change of `mesh`; true without limits.
[[nodiscard]] inline bool within_limits(StepLimits* limits, const HalfEdgeMesh& mesh, std::span<const FaceId> replaced,
                                        std::span<const NewFace> faces) {
  if (limits == nullptr) return true;
  std::vector<LatticeTriangle> before, after;
  for (const FaceId f : replaced) before.push_back({mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)});
  for (const NewFace& f : faces) after.push_back(f.corners);
  return limits->take(before, after);
}

}  // namespace bp
