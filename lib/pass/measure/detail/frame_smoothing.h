#pragma once
#include <vector>

#include "lib/pass/measure/detail/frame_tensor.h"

namespace bp::detail {

/// A lattice of tensors, x fastest: the known tensor of each cell, and its weight.
struct FrameLattice {
  std::array<std::int32_t, 3> size{};
  std::vector<FrameTensor> known;  ///< sum of what was added, over its weight
  std::vector<double> weight;      ///< 0: the tensor is unknown
  bool places = false;             ///< tensors are known at a few places only

  [[nodiscard]] std::size_t count() const { return std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]); }
};

/// Returns the smoothest tensors that keep the known ones, by conjugate gradients. They minimise the sum of weight |u -
/// known|^2 and |gradient of u|^2, which never leaves the range of the known tensors. Between places, as in [CB17] 5.2,
/// they minimise |Laplacian of u|^2, which has no peaks there. The numbers are the same for any number of threads.
[[nodiscard]] std::vector<FrameTensor> smoothed(const FrameLattice& lattice);

}  // namespace bp::detail
