#pragma once
#include <cstdint>
#include <optional>
#include <vector>

namespace bp {

/// A rectangle of texels and its place.
struct PackedRect {
  int width = 0, height = 0;
  int x = 0, y = 0;
};

/// Packs all of `rects` into a strip of this width, lowest places first (a skyline), tall ones before low ones. Returns
/// the height that they take; empty if one is wider than the strip, or if they take more than `most_height`. The same
/// rectangles get the same places. O(n (n + width)) at worst, mostly O(n log n).
[[nodiscard]] std::optional<int> pack(std::vector<PackedRect>& rects, int width, int most_height);

}  // namespace bp
