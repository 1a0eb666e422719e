#pragma once
#include <array>
#include <optional>
#include <string>

#include "lib/image/render.h"
#include "tools/cli/args.h"

/// Options of bpinfo --image.
namespace bp {

struct ImageOptions {
  std::string file;                     ///< empty: no picture is wanted
  int panel_size = 720;                 ///< pixels
  std::optional<UpAxis> up;             ///< the axis for inputs that do not tell their own
  double azimuth = 35, elevation = 22;  ///< degrees
  bool view_given = false;              ///< the user chose the direction
  double zoom = 1;
  std::optional<Vec3d> look_at;
  std::optional<std::array<int, 2>> pick;  ///< the pixel whose point in the scene is wanted

  void add_to(Args& args);
  /// Checks the options after args.parse(). Throws bad_argument if an option has no effect without --image or --pick,
  /// or has an impossible value.
  /// `up_counts`: --up is of use without a picture, too.
  void check(const Args& args, bool up_counts = false) const;
  /// Returns options for square panels with axes and a ruler, without a typeface.
  [[nodiscard]] RenderOptions render_options(UpAxis up_axis) const;

 private:
  void set_view(const std::string& text);
  void set_pick(const std::string& text);
};

/// Throws bad_argument if a picture cannot have so many panels of that size.
void check_panel_size(int pixels, std::size_t panels);

}  // namespace bp
