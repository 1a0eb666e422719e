#pragma once
#include <optional>

#include "lib/core/predicates.h"
#include "lib/geometry/near_surface.h"
#include "lib/meshing/lattice_mesh.h"
#include "lib/meshing/step_limits.h"

/// The targets --error and --volume of bpmesh, as bounds that each step keeps.
namespace bp {

struct ProxyBounds {
  double error_world = 0;   ///< largest distance of a point of the proxy to what it encloses, scene units; 0: none
  double volume_world = 0;  ///< scene units cubed, negative for a surface turned inwards; 0: none
};

/// No step takes a face farther from what is enclosed than error_world, or, where the faces it replaces were farther
/// already, than their corners were. So the largest distance over the proxy is at most
///   max(error_world, the largest distance over the surface that simplification began with),
/// up to the rounding of doubles; with the closing enclosed, that is error_world. No step adds volume beyond
/// volume_world.
class ProxyLimits final : public StepLimits {
 public:
  /// `frame`: of what the steps will change. `enclosed`: may be null without an error bound.
  ProxyLimits(const ProxyBounds& bounds, const GridFrame& frame, const TriangleBvh* enclosed);
  /// What one takes of memory, `enclosed` aside: 4 MiB with an error bound.
  [[nodiscard]] static std::uint64_t bytes_needed(const ProxyBounds& bounds);
  void begin(int128 volume6) override { volume6_ = volume6; }
  void relax(bool on) override { relaxed_ = on; }
  bool take(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after) override;
  /// "error" or "volume".
  [[nodiscard]] const char* last_refusal() const override { return last_refusal_; }

 private:
  [[nodiscard]] bool near_enough(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after);
  [[nodiscard]] TriangleD world(const LatticeTriangle& t) const;

  ProxyBounds bounds_;
  GridFrame frame_;
  std::optional<NearSurface> enclosed_;  // with an error bound
  int128 volume6_ = 0, limit6_ = 0;      // six times the volume, lattice units cubed
  bool relaxed_ = false;
  bool beyond_ = false;  // faces beyond the error were allowed because they replaced others as far
  const char* last_refusal_ = "";
};

/// Splits those pairs of `mesh` (quads.h) whose other diagonal would break a bound: however the others are drawn, all
/// bounds hold. Of pairs that add volume, those that add least are kept.
void keep_pairs_within(StepLimits& limits, LatticeMesh& mesh);

/// Enclosed volume, scene units cubed; exact but for one rounding.
[[nodiscard]] double volume_world(const LatticeMesh& mesh);

}  // namespace bp
