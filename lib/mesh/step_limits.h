#pragma once
#include <memory>
#include <span>
#include <vector>

#include "lib/mesh/guard.h"

/// Bounds on the whole proxy (distance, volume) that each step of simplification and tightening keeps.
namespace bp {

using LatticeTriangle = std::array<LatticeCoord, 3>;

class StepLimits {
 public:
  virtual ~StepLimits() = default;
  /// Begins a stage with a surface of this volume, six times, cubed lattice units. The sum so far is replaced: counted
  /// changes may have been undone or erased since.
  virtual void begin(int128 volume6) = 0;
  /// Asks, as the last test, whether the faces `before` may give way to `after`, which have the same rim. If every
  /// bound is kept, it counts the step as taken and returns true.
  [[nodiscard]] virtual bool take(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after) = 0;
  /// While relaxed, volume is only counted, and distance is not limited if the first surface was beyond its limit.
  virtual void relax(bool on) = 0;
  /// Returns whether each step can be judged by itself. Then parts of the surface can be changed at the same time.
  [[nodiscard]] virtual bool has_parts() const { return false; }
  /// Returns the same bounds for steps on a part of the surface, on another thread.
  [[nodiscard]] virtual std::unique_ptr<StepLimits> for_part() const { return nullptr; }
  /// Adds what a part of for_part() has seen.
  virtual void add_part(const StepLimits& part) { static_cast<void>(part); }
  [[nodiscard]] virtual std::uint64_t bytes_of_part() const { return 0; }
  /// Returns the largest distance that the bounds allow, lattice units; 0 if they do not limit distances.
  [[nodiscard]] virtual double error_lattice() const { return 0; }
  /// Returns the name of the bound that made the last refusal; empty if there was none.
  [[nodiscard]] virtual const char* last_refusal() const { return ""; }
};

/// Calls take() for a change of `mesh`. Returns true without limits.
[[nodiscard]] inline bool within_limits(StepLimits* limits, const HalfEdgeMesh& mesh, std::span<const FaceId> replaced,
                                        std::span<const NewFace> faces) {
  if (limits == nullptr) return true;
  std::vector<LatticeTriangle> before, after;
  for (const FaceId f : replaced) before.push_back({mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)});
  for (const NewFace& f : faces) after.push_back(f.corners);
  return limits->take(before, after);
}

}  // namespace bp
