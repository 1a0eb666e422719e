#pragma once
#include <string>

#include "lib/image/image.h"

/// Numbers as colours.
namespace bp {

/// From dark blue for 0 to yellow for 1; lighter all the way, so that it shows in grey, too. Clamps; NaN is 0.
[[nodiscard]] Color color_on_bar(double t);

/// The numbers at the ends of the bar that a panel shows; both empty: it shows none.
struct ColorBar {
  std::string low, high;
};

}  // namespace bp
