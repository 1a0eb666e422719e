#pragma once
#include <cstdint>

#include "lib/core/coords.h"

namespace bp {

/// A direction in 32 bits, as octahedral coordinates: to within 0.003 degrees. 0: none.
using PackedNormal = std::uint32_t;

/// None of a vector without length, or that is not finite.
[[nodiscard]] PackedNormal pack_normal(const Vec3d& n);
/// Of length 1; zeros of none.
[[nodiscard]] Vec3d unpack_normal(PackedNormal packed);

}  // namespace bp
