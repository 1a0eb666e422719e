#pragma once
#include <string>

#include "lib/image/image.h"

/// Numbers as colours.
namespace bp {

/// Returns a colour from dark blue for 0 to yellow for 1. It gets lighter all the way, so that it shows in grey, too.
/// Clamps; NaN is 0.
[[nodiscard]] Color color_on_bar(double t);

/// The numbers at the ends of the bar of a panel. If both are empty, the panel shows no bar.
struct ColorBar {
  std::string low, high;
};

}  // namespace bp
