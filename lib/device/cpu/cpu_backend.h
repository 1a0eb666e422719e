#pragma once
#include "lib/closing/closing_scratch.h"
#include "lib/device/backend.h"

namespace bp {

/// The tile operations on the calling thread.
class CpuBackend final : public Backend {
 public:
  [[nodiscard]] std::string name() const override { return "cpu"; }
  void voxelize(std::span<const FixedTriangle> triangles, BitBox& out, std::int64_t slack) override;
  void find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile,
                      std::vector<Crossing>& out) override;
  void fill_winding(std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                    std::span<std::int32_t> numbers, BitBox& bits) override;
  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed) override;
  void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside, WeightBlock& out,
             std::span<CoordinateRows::Place> places) override;

 private:
  ClosingScratch scratch_;
  CoordinateRows rows_;
};

}  // namespace bp
