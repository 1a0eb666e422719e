#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/core/indexed_mesh.h"
#include "lib/core/packed_normal.h"
#include "lib/core/triangle_source.h"
#include "lib/image/color_bar.h"
#include "lib/image/image.h"
#include "lib/image/image_cache.h"
#include "lib/image/mark.h"
#include "lib/image/render_options.h"

/// A small software rasteriser: it draws meshes side by side, each with its label below. It needs no display. The bytes
/// are the same on every run and for any number of threads.
namespace bp {

/// One panel. It draws whichever of `mesh`, `triangles` and `source` are set, in this order.
struct View {
  const IndexedMesh* mesh = nullptr;
  std::span<const TriangleD> triangles;
  TriangleSource* source =
      nullptr;                 ///< streamed from its start, in bounded memory; RenderOptions::bounds must cover it
  Color color{176, 188, 204};  ///< of everything without a colour of its own
  std::span<const TriangleColors> colors;  ///< of `triangles`; empty: none
  /// Normals of the corners of `triangles`, between which shades are interpolated; empty: flat shading.
  std::span<const std::array<PackedNormal, 3>> normals;
  bool source_colors = false;           ///< draw `source` in its own colours
  ImageCache* source_images = nullptr;  ///< draw `source` with these images, and in its colours; null: without images
  std::span<const std::uint8_t> inner_edges;  ///< of `triangles` (TriangleSource::read_faces()); empty: none
  bool edges = false;  ///< draw the edges of `mesh` and `triangles`, except inner ones, as dark lines
  Bounds3d bounds;     ///< the part to show, at a scale of its own; empty: as RenderOptions say
  /// Directions that the panel shows as x, y, z.
  std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  std::vector<Mark> marks;  ///< places that arrows point at, over everything else
  std::string label;        ///< lines separated by \n
  ColorBar bar;             ///< the meaning of its colours
};

constexpr int kLeastPanelSide = 16, kMostImageSide = 16384;  ///< pixels; the latter for all panels together

/// Renders panels. The view is orthographic. All panels without bounds of their own have one scale and one centre, so
/// that they can be compared. A z-buffer, shading from both sides under two lights, and 2 x 2 samples a pixel are
/// used. A panel without anything finite to draw stays empty. Memory: 32 bytes a pixel of one panel. Throws
/// bad_argument if a side is too small or too large; passes on what a source throws.
[[nodiscard]] Image render(std::span<const View> views, const RenderOptions& options = {});

/// Returns the point that such a picture shows at pixel (x, y), which counts from the upper left corner: in the middle
/// of the pixel, on the surface nearest to the viewer. Nothing if no surface is there. Its error is a small part of a
/// pixel. Throws as render() does, and bad_argument if the pixel is in no panel.
[[nodiscard]] std::optional<Vec3d> point_behind(std::span<const View> views, const RenderOptions& options, int x,
                                                int y);

}  // namespace bp
