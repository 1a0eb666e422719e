#include "tools/info/image_options.h"

#include "io/image/png_writer.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr double kLeastZoom = 0.01, kMostZoom = 1e6;  // beyond this, doubles no longer tell neighbouring samples apart

}  // namespace

void ImageOptions::add_to(Args& args) {
  args.group("Picture");
  args.option("--image", "FILE", file, "draw all INPUTs side by side, at one scale, into a PNG");
  args.option("--image-size", "PIXELS", panel_size, "side of the panel of each INPUT");
  args.option("--up", "x|y|z|-x|-y|-z", up,
              "axis that points up, for INPUTs that do not tell (default: that of the first that tells, else y)");
  args.words({{"x", ""}, {"y", ""}, {"z", ""}, {"-x", ""}, {"-y", ""}, {"-z", ""}});
  args.option(
      "--view", "AZIMUTH,ELEVATION", [this](const std::string& text) { set_view(text); },
      "direction of the viewer in degrees: from the front to the right, and above the horizon (default: 35,22)");
  args.option("--zoom", "FACTOR", zoom, "enlarge around the middle of the picture");
  args.option("--look-at", "X,Y,Z", look_at, "point in the middle of the picture (default: the middle of all INPUTs)");
  args.option(
      "--pick", "PX,PY", [this](const std::string& text) { set_pick(text); },
      "print the point of the scene at a pixel of the picture, X,Y,Z, and nothing else; pixels count from the upper "
      "left "
      "corner");
  args.removed("--azimuth", "--view AZIMUTH,ELEVATION takes both");
  args.removed("--elevation", "--view AZIMUTH,ELEVATION takes both");
  args.removed("--no-edges", "meshes of few triangles are always drawn with their edges");
}

void ImageOptions::set_view(const std::string& text) {
  std::vector<double> angles;
  for_each_item(text, [&](std::string_view item) { angles.push_back(parse_number(item)); });
  if (angles.size() != 2)
    fail(ErrorCode::bad_argument, "'{}' is not AZIMUTH,ELEVATION, two numbers in degrees such as 35,22", text);
  azimuth = angles[0], elevation = angles[1];
  view_given = true;
}

void ImageOptions::set_pick(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) fail(ErrorCode::bad_argument, "'{}' is not PX,PY, a pixel such as 300,200", text);
  const auto pixel = [&](const std::string& part) { return int(parse_integer(part, 0, kMostImageSide)); };
  pick = {pixel(text.substr(0, comma)), pixel(text.substr(comma + 1))};
}

void ImageOptions::check(const Args& args, bool up_counts) const {
  if (!pick) args.needs({"--image-size", "--view", "--zoom", "--look-at"}, "--image");
  if (!pick && !up_counts) args.needs({"--up"}, "--image");
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
