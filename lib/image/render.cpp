#include "lib/image/render.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/image/camera.h"
#include "lib/image/canvas.h"
#include "lib/image/legend.h"

namespace bp {

namespace {

constexpr int kSamples = 2;  // per pixel and direction
constexpr std::size_t kBatch = 1 << 15;

/// Gets triangle t of the mesh. Returns false if it names a vertex that does not exist.
bool corners_of(const IndexedMesh& mesh, std::size_t t, TriangleD& corners) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.triangles[t][k] >= mesh.vertices.size()) return false;
    corners[k] = mesh.vertices[mesh.triangles[t][k]];
  }
  return true;
}

/// Calls f(p) for each finite corner of all triangles to be drawn.
template <class F>
void for_each_corner(std::span<const View> views, const F& f) {
  TriangleD corners;
  std::vector<TriangleD> batch;
  const auto visit = [&](const TriangleD& t) {
    for (const Vec3d& p : t)
      if (is_finite(p)) f(p);
  };
  for (const View& v : views) {
    for (std::size_t t = 0; v.mesh != nullptr && t < v.mesh->triangles.size(); ++t)
      if (corners_of(*v.mesh, t, corners)) visit(corners);
    std::for_each(v.triangles.begin(), v.triangles.end(), visit);
    if (v.source == nullptr) continue;
    for (v.source->rewind(); v.source->read(batch);) std::for_each(batch.begin(), batch.end(), visit);
  }
}

std::vector<Vec3d> corners_of(const Bounds3d& b) {
  std::vector<Vec3d> corners(b.empty() ? 0 : 8);
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (std::size_t i = 0; i < 3; ++i) corners[c][i] = (c >> i & 1) != 0 ? b.max[i] : b.min[i];
  return corners;
}

/// Aims at the given bounds or, without them, at all triangles. Returns false if there are none.
bool aim(Camera& camera, std::span<const View> views, const Bounds3d& bounds, const RenderOptions& options) {
  Bounds3d seen;
  const auto see = [&](const Vec3d& p) {
    if (seen.empty()) camera.look_at(options.look_at.value_or(p));  // any point of the scene suffices
    seen.add(camera.seen(p));
  };
  if (bounds.empty()) {
    for_each_corner(views, see);
  } else {
    for (const Vec3d& p : corners_of(bounds)) see(p);
  }
  if (seen.empty()) return false;
  camera.fit(seen, options.panel_width * kSamples, options.panel_height * kSamples);
  camera.zoom(options.zoom, options.look_at);
  return true;
}

/// Draws batches of projected triangles.
class PanelPainter {
 public:
  PanelPainter(const Camera& camera, Canvas& canvas, Color color) : camera_(camera), canvas_(canvas), color_(color) {}

  /// The looks of triangles, one of each kind for each triangle, or none of that kind.
  struct Looks {
    std::span<const TriangleColors> colors{};
    std::span<const std::array<PackedNormal, 3>> normals{};
    std::span<const TriangleTexture> textures{};
    ImageCache* images = nullptr;
  };

  /// corner(i) returns a TriangleD in scene units, for i in [0, n).
  template <class Corners>
  void paint(std::size_t n, const Corners& corners, const Looks& looks) {
    for (std::size_t begin = 0; begin < n; begin += kBatch) {
      projected_.resize(std::min(kBatch, n - begin));
      parallel_ranges(std::int64_t(projected_.size()), 2048, [&](std::int64_t b, std::int64_t e) {
        for (auto i = std::size_t(b); i < std::size_t(e); ++i) {
          const TriangleD t = corners(begin + i);
          for (std::size_t k = 0; k < 3; ++k) projected_[i][k] = camera_.project(t[k]);
        }
      });
      normals_.resize(looks.normals.empty() ? 0 : projected_.size());
      for (std::size_t i = 0; i < normals_.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) normals_[i][k] = camera_.turned(unpack_normal(looks.normals[begin + i][k]));
      }
      if (looks.colors.empty()) {
        canvas_.draw(projected_, color_, normals_);
      } else {
        canvas_.draw(projected_, looks.colors.subspan(begin, projected_.size()), normals_,
                     looks.textures.subspan(std::min(begin, looks.textures.size())), looks.images);
      }
    }
  }

 private:
  const Camera& camera_;
  Canvas& canvas_;
  Color color_;
  std::vector<TriangleD> projected_;
  std::vector<std::array<Vec3d, 3>> normals_;
};

TriangleD corners_or_nothing(const IndexedMesh& mesh, std::size_t t) {
  TriangleD corners{};  // it has no area, so it draws nothing
  if (!corners_of(mesh, t, corners)) corners = {};
  return corners;
}

/// Triangles of a source, in batches.
struct SourceBatch {
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;

  [[nodiscard]] bool read(const View& view) {
    colors.clear();
    textures.clear();
    if (view.source_images != nullptr) return view.source->read_textured(triangles, colors, textures);
    return view.source_colors ? view.source->read_colored(triangles, colors) : view.source->read(triangles);
  }
  void add(const SourceBatch& part) {
    triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
    colors.insert(colors.end(), part.colors.begin(), part.colors.end());
    textures.insert(textures.end(), part.textures.begin(), part.textures.end());
  }
};

void paint_source(const View& view, PanelPainter& painter) {
  SourceBatch batch, part;
  const auto paint = [&] {
    painter.paint(batch.triangles.size(), [&](std::size_t t) { return batch.triangles[t]; },
                  {batch.colors, {}, batch.textures, view.source_images});
    batch = {};
  };
  view.source->rewind();
  while (part.read(view)) {  // parts may be small
    batch.add(part);
    if (batch.triangles.size() >= kBatch) paint();
  }
  paint();
}

void paint_faces(const View& view, const Camera& camera, Canvas& canvas) {
  PanelPainter painter(camera, canvas, view.color);
  if (view.mesh != nullptr)
    painter.paint(view.mesh->triangles.size(), [&](std::size_t t) { return corners_or_nothing(*view.mesh, t); }, {});
  painter.paint(view.triangles.size(), [&](std::size_t t) { return view.triangles[t]; }, {view.colors, view.normals});
  if (view.source != nullptr) paint_source(view, painter);
}

/// Returns each edge once, in lexicographic order of its ends on the screen.
std::vector<std::array<Vec3d, 2>> edges_of(const View& view, const Camera& camera) {
  std::vector<std::array<Vec3d, 2>> edges;
  const auto add = [&](const TriangleD& t, std::span<const std::uint8_t> inner_edges, std::size_t i) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (i < inner_edges.size() && (inner_edges[i] >> e & 1) != 0) continue;
      const Vec3d p = camera.project(t[e]), q = camera.project(t[(e + 1) % 3]);
      if (is_finite(p) && is_finite(q)) edges.push_back(p < q ? std::array{p, q} : std::array{q, p});
    }
  };
  for (std::size_t t = 0; view.mesh != nullptr && t < view.mesh->triangles.size(); ++t)
    add(corners_or_nothing(*view.mesh, t), view.mesh->inner_edges, t);
  for (std::size_t t = 0; t < view.triangles.size(); ++t) add(view.triangles[t], view.inner_edges, t);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Draws the arrows of panel i; the first one lies over the others.
void draw_marks(Image& image, const View& view, const Camera& camera, std::size_t i, const RenderOptions& options) {
  for (auto mark = view.marks.rbegin(); mark != view.marks.rend(); ++mark) {
    const int left = int(i) * options.panel_width, side = std::min(options.panel_width, options.panel_height);
    const Vec3d p = camera.project(mark->at);
    draw_mark(image, left, 0, side, left + p[0] / kSamples, p[1] / kSamples, mark->text, options.typeface);
  }
}

/// Draws axes, ruler and label of panel i.
void draw_legend(Image& image, const Legend& legend, const View& view, const Camera& camera, std::size_t i,
                 const RenderOptions& options) {
  const int x = int(i) * options.panel_width, below = options.panel_height;
  std::array<Vec3d, 3> axes;
  for (std::size_t k = 0; k < 3; ++k) axes[k] = camera.turned(view.axes[k]);
  legend.draw_axes(image, x, below, axes);
  legend.draw_ruler(image, x + options.panel_width, below, camera.samples_per_unit() / kSamples);
  legend.draw_bar(image, x, below, view.bar);
  legend.write(image, x, below, legend.lines(view.label));
}

/// Draws lines between panels; a part in detail fills its panel.
void draw_borders(Image& image, const RenderOptions& options) {
  constexpr Color kBorder{205, 208, 214};
  for (int x = options.panel_width; x < image.width; x += options.panel_width)
    for (int y = 0; y < image.height; ++y) image.at(x, y) = kBorder;
}

void check_size(const RenderOptions& options, int columns) {
  const int w = options.panel_width, h = options.panel_height;
  if (std::min(w, h) < kLeastPanelSide || std::max<std::int64_t>(h, std::int64_t(w) * columns) > kMostImageSide)
    fail(ErrorCode::bad_argument,
         "image of {} panels, {} x {} pixels each: sides must be {} to {}, all panels together", columns, w, h,
         kLeastPanelSide, kMostImageSide);
}

/// Returns the camera of a panel; `common` is that of all panels.
Camera camera_of(const Camera& common, std::span<const View> views, std::size_t i, const RenderOptions& options) {
  Camera camera = common;
  if (!views[i].bounds.empty()) aim(camera, views.subspan(i, 1), views[i].bounds, options);
  return camera;
}

}  // namespace

Image render(std::span<const View> views, const RenderOptions& options) {
  const int w = options.panel_width, h = options.panel_height;
  const int columns = std::max(1, int(views.size()));
  check_size(options, columns);
  const Legend legend(w, options.typeface, options.marks, options.ink, options.background);
  std::size_t lines = 0;
  for (const View& v : views) lines = std::max(lines, legend.lines(v.label).size());
  Image image(w * columns, h + legend.height(lines), options.background);

  Camera common(options);
  const bool anything = aim(common, views, options.bounds, options);
  for (std::size_t i = 0; i < views.size(); ++i) {
    Canvas canvas(w * kSamples, h * kSamples, options.background);
    const Camera camera = camera_of(common, views, i, options);
    if (anything) {
      paint_faces(views[i], camera, canvas);
      if (views[i].edges) canvas.draw_lines(edges_of(views[i], camera), options.ink, 0.9);
    }
    canvas.resolve(image, int(i) * w, 0);
    if (anything) draw_marks(image, views[i], camera, i, options);
    draw_legend(image, legend, views[i], camera, i, options);
  }
  if (options.marks) draw_borders(image, options);
  return image;
}

std::optional<Vec3d> point_behind(std::span<const View> views, const RenderOptions& options, int x, int y) {
  const int w = options.panel_width, h = options.panel_height;
  check_size(options, std::max(1, int(views.size())));
  if (x < 0 || y < 0 || x >= w * int(views.size()) || y >= h)
    fail(ErrorCode::bad_argument, "pixel {},{} is in no panel; the panels take {} x {} pixels", x, y,
         w * int(views.size()), h);
  const auto i = std::size_t(x / w);
  Camera common(options);
  if (!aim(common, views, options.bounds, options)) return {};
  Canvas canvas(w * kSamples, h * kSamples, options.background);
  const Camera camera = camera_of(common, views, i, options);
  paint_faces(views[i], camera, canvas);
  std::optional<Vec3d> nearest;  // nearest of the samples of the pixel
  for (int sample = 0; sample < kSamples * kSamples; ++sample) {
    const int sx = x % w * kSamples + sample % kSamples, sy = y * kSamples + sample / kSamples;
    const std::optional<double> depth = canvas.depth(sx, sy);
    if (depth && (!nearest || *depth < (*nearest)[2])) nearest = Vec3d{sx + 0.5, sy + 0.5, *depth};
  }
  if (nearest) nearest = camera.unproject(*nearest);
  return nearest;
}

}  // namespace bp
