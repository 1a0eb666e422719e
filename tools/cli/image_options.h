#pragma once
#include <optional>
#include <string>

#include "lib/image/render.h"
#include "tools/cli/args.h"

/// --image and the options that belong to it; bpinfo and bpcheck have the same.
namespace bp {

struct ImageOptions {
  std::string file;          ///< empty: no picture is wanted
  int panel_size = 720;      ///< pixels
  std::optional<UpAxis> up;  ///< of what does not tell its own
  double azimuth = 35, elevation = 22;
  double zoom = 1;
  std::optional<Vec3d> look_at;

  void add_to(Args& args, const std::string& image_help, const std::string& up_help);
  /// After args.parse(). Throws bad_argument if an option means nothing without --image, or has no meaning at all.
  void check(const Args& args) const;
  /// Of square panels with axes and a ruler; without a typeface.
  [[nodiscard]] RenderOptions render_options(UpAxis up_axis) const;
};

/// Throws bad_argument if no picture has so many panels of that size.
void check_panel_size(int pixels, std::size_t panels);

}  // namespace bp
