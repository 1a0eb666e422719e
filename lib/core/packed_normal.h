#pragma once
#include <cstdint>

#include "lib/core/coords.h"

namespace bp {

/// A direction in 32 bits, as octahedral coordinates. It is right to within 0.003 degrees. 0: no direction.
using PackedNormal = std::uint32_t;

/// Returns 0 for a vector that has no length or is not finite.
[[nodiscard]] PackedNormal pack_normal(const Vec3d& n);
/// Returns a vector of length 1, or zeros for 0.
[[nodiscard]] Vec3d unpack_normal(PackedNormal packed);

}  // namespace bp
