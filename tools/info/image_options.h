#pragma once
#include <array>
#include <optional>
#include <string>

#include "lib/image/render.h"
#include "tools/cli/args.h"

/// --image of bpinfo, and the options that belong to it.
namespace bp {

struct ImageOptions {
  std::string file;                     ///< empty: no picture is wanted
  int panel_size = 720;                 ///< pixels
  std::optional<UpAxis> up;             ///< of what does not tell its own
  double azimuth = 35, elevation = 22;  ///< degrees
  double zoom = 1;
  std::optional<Vec3d> look_at;
  std::optional<std::array<int, 2>> pick;  ///< the point behind this pixel is wanted

  void add_to(Args& args);
  /// After args.parse(). Throws bad_argument if an option means nothing without --image or --pick, or has no meaning at
  /// all.
  void check(const Args& args) const;
  /// Of square panels with axes and a ruler; without a typeface.
  [[nodiscard]] RenderOptions render_options(UpAxis up_axis) const;

 private:
  void set_view(const std::string& text);
  void set_pick(const std::string& text);
};

/// Throws bad_argument if no picture has so many panels of that size.
void check_panel_size(int pixels, std::size_t panels);

}  // namespace bp
