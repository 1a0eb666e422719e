#pragma once
#include <vector>

#include "lib/pass/measure/detail/frame_tensor.h"

namespace bp::detail {

/// A lattice of tensors, x fastest; what is known of each cell, and with which weight.
struct FrameLattice {
  std::array<std::int32_t, 3> size{};
  std::vector<FrameTensor> known;  ///< 1 / weight of what was added
  std::vector<double> weight;      ///< 0: nothing is known
  bool places = false;             ///< known at a few places only

  [[nodiscard]] std::size_t count() const { return std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]); }
};

/// The smoothest tensors that keep what is known, by conjugate gradients: the least sum of weight |u - known|^2 and
/// |gradient of u|^2, which never leaves the range of what is known; between places, as in [CB17] 5.2, of |Laplacian of
/// u|^2, which has no peaks there. The same numbers for any number of threads.
[[nodiscard]] std::vector<FrameTensor> smoothed(const FrameLattice& lattice);

}  // namespace bp::detail
