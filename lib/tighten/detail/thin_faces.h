#pragma once
#include <cstdint>

#include "lib/tighten/proxy_editor.h"

namespace bp {

/// Flips edges of thin faces where the thinner one of the two new faces is less thin. A face with a corner of nearly
/// 180 degrees goes so. Each flip may add `most` to the volume, lattice units cubed; it is checked exactly, as all
/// changes are. Tightening would flip such edges back, so this comes last. Returns the number of flips. Deterministic.
std::uint64_t flip_thin_faces(ProxyEditor& editor, double most);

}  // namespace bp
