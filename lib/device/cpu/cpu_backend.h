#pragma once
#include "lib/closing/closing_scratch.h"
#include "lib/device/backend.h"

namespace bp {

/// The tile operations on the calling thread.
class CpuBackend final : public Backend {
 public:
  [[nodiscard]] std::string name() const override { return "cpu"; }
  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed) override;
  void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside, WeightBlock& out,
             std::span<CoordinateRows::Place> places) override;

 private:
  ClosingScratch scratch_;
  CoordinateRows rows_;
};

}  // namespace bp
