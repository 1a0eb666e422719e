#pragma once
#include <functional>
#include <memory>
#include <string>

#include "lib/device/backend.h"

namespace bp {

/// A device's backend that is made by its first call, so that a device can start while its work is still being read.
/// A DeviceError of make() is thrown by that call, and by all later ones.
class LateBackend final : public Backend {
 public:
  /// `name` and `pinned_bytes`: what those of the backend will be.
  LateBackend(std::function<std::unique_ptr<Backend>()> make, std::string name, std::uint64_t pinned_bytes)
      : make_(std::move(make)), name_(std::move(name)), pinned_bytes_(pinned_bytes) {}

  [[nodiscard]] std::string name() const override { return made_ ? made_->name() : name_; }
  [[nodiscard]] std::uint64_t pinned_bytes() const override { return pinned_bytes_; }
  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed) override {
    made().close(solid, scale, halo, params, interior, closed);
  }
  void close_from_shelf(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale, const Halo& halo,
                        const ClosingParams& params, const VoxelBox& interior, BitBox& closed) override {
    made().close_from_shelf(solid, bricks, scale, halo, params, interior, closed);
  }
  void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside, WeightBlock& out,
             std::span<CoordinateRows::Place> places) override {
    made().weigh(coordinates, points, carry_outside, out, places);
  }

 private:
  Backend& made() {
    if (!made_) made_ = make_();
    return *made_;
  }

  std::function<std::unique_ptr<Backend>()> make_;
  std::string name_;
  std::uint64_t pinned_bytes_;
  std::unique_ptr<Backend> made_;  ///< null before the first call
};

}  // namespace bp
