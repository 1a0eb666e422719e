#pragma once
#include <optional>

#include "lib/exact/predicates.h"
#include "lib/geometry/near_surface.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/mesh/step_limits.h"

/// Makes each step of simplification keep bpmesh's targets --error and --volume.
namespace bp {

struct ProxyBounds {
  double error_world = 0;   ///< largest distance of a point of the proxy to what it encloses, scene units; 0: none
  double volume_world = 0;  ///< scene units cubed, negative for a surface turned inwards; 0: none
};

/// Refuses steps that break a bound. A step that moves a face farther from what is enclosed than error_world is
/// refused, unless the corners of the faces that it replaces were already as far. So the largest distance over the
/// proxy is at most
///   max(error_world, the largest distance over the surface that simplification began with),
/// up to the rounding of doubles. If the closing is what is enclosed, that is error_world. A step that adds volume
/// beyond volume_world is refused.
class ProxyLimits final : public StepLimits {
 public:
  /// `frame`: the frame of the mesh that the steps change. `enclosed`: a tree over the surface that is enclosed; may be
  /// null without an error bound.
  ProxyLimits(const ProxyBounds& bounds, const GridFrame& frame, const TriangleBvh* enclosed)
      : ProxyLimits(bounds, frame, enclosed, places_near(bounds, frame, enclosed)) {}
  /// Returns the bytes that one object takes, without the tree: 1 to 32 MiB with an error bound, depending on the area
  /// of `enclosed`.
  [[nodiscard]] static std::uint64_t bytes_needed(const ProxyBounds& bounds, const GridFrame& frame,
                                                  const TriangleBvh* enclosed);
  /// The largest possible result of bytes_needed().
  [[nodiscard]] static std::uint64_t most_bytes() { return kMostPlaces * NearSurface::kBytesPerPlace; }
  void begin(int128 volume6) override { volume6_ = volume6; }
  void relax(bool on) override { relaxed_ = on; }
  bool take(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after) override;
  [[nodiscard]] bool has_parts() const override { return bounds_.volume_world == 0; }
  [[nodiscard]] std::unique_ptr<StepLimits> for_part() const override;
  void add_part(const StepLimits& part) override;
  [[nodiscard]] std::uint64_t bytes_of_part() const override;
  [[nodiscard]] double error_lattice() const override { return bounds_.error_world / frame_.voxel * kLatticePerVoxel; }
  /// Returns "error" or "volume".
  [[nodiscard]] const char* last_refusal() const override { return last_refusal_; }

 private:
  static constexpr std::size_t kPlacesOfPart = std::size_t(1) << 15, kMostPlaces = std::size_t(1) << 20;
  [[nodiscard]] static std::size_t places_near(const ProxyBounds& bounds, const GridFrame& frame,
                                               const TriangleBvh* enclosed);
  ProxyLimits(const ProxyBounds& bounds, const GridFrame& frame, const TriangleBvh* enclosed, std::size_t places);
  [[nodiscard]] bool near_enough(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after);
  [[nodiscard]] TriangleD world(const LatticeTriangle& t) const;

  ProxyBounds bounds_;
  GridFrame frame_;
  const TriangleBvh* tree_;
  std::optional<NearSurface> enclosed_;  // with an error bound
  int128 volume6_ = 0, limit6_ = 0;      // six times the volume, lattice units cubed
  bool relaxed_ = false;
  bool beyond_ = false;  // faces beyond the error were allowed, because they replaced faces as far away
  const char* last_refusal_ = "";
};

/// Splits the pairs of `mesh` (quads.h) whose other diagonal might break a bound. All bounds then hold for every choice
/// of diagonals of the pairs that are left. Among the pairs that add volume, those that add least are kept.
void keep_pairs_within(StepLimits& limits, LatticeMesh& mesh);

/// Returns the enclosed volume, scene units cubed; exact except for one rounding.
[[nodiscard]] double volume_world(const LatticeMesh& mesh);

}  // namespace bp
