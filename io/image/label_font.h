#pragma once
#include <memory>
#include <span>
#include <string>

#include "lib/image/typeface.h"

namespace bp {

/// Returns the paths at which distributions keep DejaVu Sans, then other sans-serif fonts. Pictures of two machines
/// have the same bytes if both have the same font file and FreeType.
[[nodiscard]] std::span<const std::string> label_font_paths();

/// Opens the first of `paths` that FreeType can read and scale; null if there is none. Throws only if memory runs out.
[[nodiscard]] std::unique_ptr<Typeface> open_label_font(std::span<const std::string> paths = label_font_paths());

}  // namespace bp
