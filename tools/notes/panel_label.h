#pragma once
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/image/typeface.h"

/// Names of the panels of a picture.
namespace bp {

/// Returns one name for each path: the file's name, with as many of its folders as tell it from other files of the same
/// name. "-" is stdin. The same path has the same name.
[[nodiscard]] std::vector<std::string> panel_names(const std::vector<std::string>& paths);

/// Returns "x 0 to 1, y 0 to 1, z -0.5 to 2.5", to a thousandth of the diagonal; "" for empty bounds.
[[nodiscard]] std::string bounds_text(const Bounds3d& bounds);

/// Returns a note if `typeface` is null; else "".
[[nodiscard]] std::string note_on_font(const Typeface* typeface);

}  // namespace bp
