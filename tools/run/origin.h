#pragma once
#include <optional>
#include <string>

#include "lib/core/grid_frame.h"

/// --origin: a point that is subtracted from all vertices of what is written, exactly, because other programs compute
/// in 32-bit floats.
namespace bp {

struct OriginOption {
  enum class Kind { unsaid, off, automatic, point };
  Kind kind = Kind::unsaid;
  Vec3d point{};
  [[nodiscard]] std::string text() const;  ///< as it was given; empty: it was not
};
/// "auto", "off" or "X,Y,Z". Throws bad_argument.
[[nodiscard]] OriginOption parse_origin(const std::string& text);

/// The point of --origin auto: (0, 0, 0) for a scene that is no farther from it than a few times its size; else the
/// multiple of a power of ten (of two, where that would not be exact) that is nearest to the middle of its bounds. The
/// step is a tenth of the longest side to all of it. Depends on the bounds only.
[[nodiscard]] Vec3d auto_origin(const Bounds3d& bounds);

/// The point to subtract. Throws bad_argument, naming one that will do, if it would round coordinates of this frame.
[[nodiscard]] Vec3d origin_of(const OriginOption& option, const GridFrame& frame, const Bounds3d& bounds);

/// What is to be said of it; else empty: which point --origin auto has chosen; or that 32-bit floats do not tell
/// neighbouring lattice points apart, where the option was not given or its point does not help. file_tells: which
/// point was subtracted.
[[nodiscard]] std::string origin_note(const OriginOption& option, const GridFrame& frame, const Bounds3d& bounds,
                                      bool file_tells = true);

/// "84900,447600,0": as --origin takes it.
[[nodiscard]] std::string origin_text(const Vec3d& origin);

}  // namespace bp
