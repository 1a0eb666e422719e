#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>

#include "lib/core/grid_frame.h"
#include "lib/core/indexed_mesh.h"
#include "lib/core/triangle_source.h"
#include "lib/image/color_bar.h"
#include "lib/image/image.h"
#include "lib/image/image_cache.h"
#include "lib/image/typeface.h"

/// A small software rasteriser: meshes side by side, each with its label below. Needs no display. The same bytes on
/// every run and for any number of threads.
namespace bp {

/// One panel. What is set among `mesh`, `triangles` and `source` is drawn, in this order.
struct View {
  const IndexedMesh* mesh = nullptr;
  std::span<const TriangleD> triangles;
  TriangleSource* source =
      nullptr;                 ///< streamed from its start, in bounded memory; RenderOptions::bounds must cover it
  Color color{176, 188, 204};  ///< of all that has none of its own
  std::span<const TriangleColors> colors;     ///< of `triangles`; empty: none
  bool source_colors = false;                 ///< draw `source` in its own
  ImageCache* source_images = nullptr;        ///< draw `source` with these on it, and in its colours; null: none
  std::span<const std::uint8_t> inner_edges;  ///< of `triangles` (TriangleSource::read_faces()); empty: none
  bool edges = false;  ///< draws the edges of `mesh` and `triangles`, but inner ones, as dark lines
  Bounds3d bounds;     ///< what to show, at a scale of its own; empty: as RenderOptions say
  std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};  ///< that the panel shows as x, y, z
  std::string label;                                                          ///< lines separated by \n
  ColorBar bar;                                                               ///< what its colours mean
};

constexpr int kLeastPanelSide = 16, kMostImageSide = 16384;  ///< pixels; the latter of all panels together

struct RenderOptions {
  int panel_width = 720, panel_height = 720;  ///< pixels; axes and labels come below
  double azimuth = 35;  ///< degrees that the viewer stands to the right of the front (-y of a z-up scene, +z of a y-up)
  double elevation = 22;  ///< degrees above the horizon
  UpAxis up = UpAxis::y;
  Bounds3d bounds;                 ///< what to show, scene units; empty: all that is drawn, as large as it fits
  double zoom = 1;                 ///< times as large as it fits
  std::optional<Vec3d> look_at{};  ///< point in the middle of every panel; none: the middle of what it shows
  Typeface* typeface = nullptr;    ///< of labels; null: none are drawn
  bool marks = false;              ///< axes and a ruler, in panels that are not too small; lines between panels
  Color background{255, 255, 255}, ink{40, 44, 52};
};

/// Orthographic, all panels without bounds of their own at one scale and around one centre, so that they can be
/// compared; z-buffer, flat shading
/// from both sides under two lights, 2 x 2 samples a pixel. A panel without anything finite to draw stays empty.
/// Memory: 32 bytes a pixel of one panel. Throws bad_argument if a side is too small or too large; passes on what a
/// source throws.
[[nodiscard]] Image render(std::span<const View> views, const RenderOptions& options = {});

/// The point that such a picture shows at pixel (x, y), which counts from the upper left corner: in the middle of the
/// pixel, on what lies nearest to the viewer. None where nothing is drawn. Its error is a small part of a pixel.
/// Throws as render(), and bad_argument if the pixel is in no panel.
[[nodiscard]] std::optional<Vec3d> point_behind(std::span<const View> views, const RenderOptions& options, int x,
                                                int y);

}  // namespace bp
