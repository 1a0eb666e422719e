#pragma once
#include <functional>
#include <optional>
#include <span>

#include "lib/core/box.h"
#include "lib/core/color.h"
#include "lib/image/image.h"
#include "lib/image/image_cache.h"

namespace bp {

/// Samples with depth. Triangles and lines come in sample coordinates: x to the right, y down, z away from the viewer.
/// The order of triangles decides between equal depths, so the picture does not depend on threads.
class Canvas {
 public:
  Canvas(int width, int height, Color background);

  using Normals = std::array<Vec3d, 3>;  ///< of the corners of a triangle, in the directions of sample coordinates

  /// Draws triangles that face either way. Without normals they are shaded flat; a normal of no length stands for that
  /// of its triangle. Triangles are cut off far beyond the canvas (2^21 samples), and left out if coordinates are not
  /// finite. Parallel.
  void draw(std::span<const TriangleD> triangles, Color color, std::span<const Normals> normals = {});
  /// Draws triangles with colours of their own, one for each, and with images on them, unless `images` is null.
  void draw(std::span<const TriangleD> triangles, std::span<const TriangleColors> colors,
            std::span<const Normals> normals = {}, std::span<const TriangleTexture> textures = {},
            ImageCache* images = nullptr);

  /// Draws antialiased lines where nothing lies in front. Parallel.
  void draw_lines(std::span<const std::array<Vec3d, 2>> lines, Color color, double half_width);

  /// Returns the distance from the viewer of the surface in a sample; nothing if there is none.
  [[nodiscard]] std::optional<double> depth(int x, int y) const;

  /// Averages each 2 x 2 samples, and copies the result into `image` with the upper left corner at (x, y).
  void resolve(Image& image, int x, int y) const;

 private:
  struct Shaded;
  class Painter;
  template <class ColorOf>
  void draw_shaded(std::span<const TriangleD> triangles, const ColorOf& color_of, std::span<const Normals> normals,
                   const Painter& painter);
  struct Row {
    int begin, end;
  };
  void fill(const Shaded& t, Row rows, const Painter& painter);
  void draw_line(const std::array<Vec3d, 2>& line, Color color, double half_width, Row rows);
  [[nodiscard]] bool hidden(double x, double y, double depth) const;
  void for_each_band(const std::function<void(Row)>& body) const;

  int width_, height_;
  std::vector<float> depth_;
  std::vector<Color> color_;
};

}  // namespace bp
