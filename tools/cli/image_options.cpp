#include "tools/cli/image_options.h"

#include "io/image/png_writer.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr double kLeastZoom = 0.01, kMostZoom = 1e6;  // beyond, doubles no longer tell neighbouring samples apart

}  // namespace

void ImageOptions::add_to(Args& args, const std::string& image_help, const std::string& up_help) {
  args.option("--image", "FILE", file, image_help);
  args.option("--image-size", "PIXELS", panel_size, "side of a panel of the image");
  args.option("--up", "x|y|z|-x|-y|-z", up, up_help);
  args.option("--azimuth", "DEGREES", azimuth, "where the viewer stands, from the front to the right");
  args.option("--elevation", "DEGREES", elevation, "how far above the horizon the viewer stands");
  args.option("--zoom", "FACTOR", zoom, "draw it FACTOR times as large; the middle stays in the middle");
  args.option("--look-at", "X,Y,Z", look_at, "point in the middle of the image (default: the middle of what is drawn)");
}

void ImageOptions::check(const Args& args) const {
  args.needs({"--image-size", "--up", "--azimuth", "--elevation", "--zoom", "--look-at"}, "--image");
  check_png_name(file);
  if (!(zoom >= kLeastZoom && zoom <= kMostZoom))
    fail(ErrorCode::bad_argument, "--zoom {}: must be {} to {:.0f}; 2 draws everything twice as large", zoom,
         kLeastZoom, kMostZoom);
}

RenderOptions ImageOptions::render_options(UpAxis up_axis) const {
  RenderOptions options;
  options.panel_width = options.panel_height = panel_size;
  options.azimuth = azimuth, options.elevation = elevation;
  options.up = up_axis;
  options.zoom = zoom, options.look_at = look_at;
  options.marks = true;
  return options;
}

void check_panel_size(int pixels, std::size_t panels) {
  const std::size_t most = kMostImageSide / panels;
  if (pixels >= kLeastPanelSide && std::size_t(pixels) <= most) return;
  fail(ErrorCode::bad_argument, "--image-size {}: must be {} to {} pixels{}", pixels, kLeastPanelSide, most,
       panels == 1 ? "" : fmt::format(", for {} panels side by side", panels));
}

}  // namespace bp
