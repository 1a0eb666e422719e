#pragma once
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/image/typeface.h"

/// What panels of a picture are called.
namespace bp {

/// One for each path: the file's name, and where other paths end in the same name as many of its folders as it takes to
/// tell them apart. "-" is stdin. The same path has the same name.
[[nodiscard]] std::vector<std::string> panel_names(const std::vector<std::string>& paths);

/// "x 0 to 1, y 0 to 1, z -0.5 to 2.5", to a thousandth of the diagonal; "" of empty bounds.
[[nodiscard]] std::string bounds_text(const Bounds3d& bounds);

/// What to say where `typeface` is null; else "".
[[nodiscard]] std::string note_on_font(const Typeface* typeface);

}  // namespace bp
