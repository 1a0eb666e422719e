#pragma once
#include <optional>
#include <string>

#include "lib/core/grid_frame.h"

/// --origin: a point that is subtracted from all written vertices, exactly, because other programs compute in 32-bit
/// floats.
namespace bp {

struct OriginOption {
  enum class Kind { unsaid, off, automatic, point };
  Kind kind = Kind::unsaid;
  Vec3d point{};
  [[nodiscard]] std::string text() const;  ///< the text as it was given; empty: not given
};
/// Parses "auto", "off" or "X,Y,Z". Throws bad_argument.
[[nodiscard]] OriginOption parse_origin(const std::string& text);

/// Returns the point of --origin auto. For a scene that is no farther from (0, 0, 0) than a few times its size: (0, 0,
/// 0). For any other scene: the point near the middle of its bounds whose coordinates are multiples of a power of ten
/// (of a power of two where that would not be exact), which is a tenth of the longest side to all of it. Depends on the
/// bounds only.
[[nodiscard]] Vec3d auto_origin(const Bounds3d& bounds);

/// Returns the point to subtract. Throws bad_argument, and names a point that can be used, if it would round
/// coordinates of this frame.
[[nodiscard]] Vec3d origin_of(const OriginOption& option, const GridFrame& frame, const Bounds3d& bounds);

/// Returns a note that tells which point --origin auto has chosen; or that 32-bit floats do not tell neighbouring
/// lattice points apart, if the option was not given or its point does not help. Nothing otherwise. file_tells: the
/// file tells which point was subtracted.
[[nodiscard]] std::string origin_note(const OriginOption& option, const GridFrame& frame, const Bounds3d& bounds,
                                      bool file_tells = true);

/// Returns "84900,447600,0", as --origin takes it.
[[nodiscard]] std::string origin_text(const Vec3d& origin);

}  // namespace bp
