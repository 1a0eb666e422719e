#include "lib/image/canvas.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/parallel.h"
#include "lib/image/clip.h"

namespace bp {

namespace {

constexpr int kSubBits = 8;  // corners snap to 1/256 sample, so that edges are decided in integers, without cracks
constexpr double kSub = 1 << kSubBits;
constexpr double kMaxCoordinate = 1 << 22;       // samples; products of two differences stay below 2^63
constexpr double kClipped = kMaxCoordinate / 2;  // parts beyond that are cut off
constexpr int kBand = 32;                        // rows per work item

/// Returns 1 for the normal of a triangle that faces the viewer, -1 for one that faces away, whose normals are turned.
double facing(const Vec3d& n) {
  return n[2] > 0 ? -1 : 1;
}

double shade(const Vec3d& n, double s) {
  // A key light comes from the upper left, a fill light from the right, both from the viewer's side.
  const double key = s * (-0.41 * n[0] - 0.62 * n[1] - 0.67 * n[2]);
  const double fill = s * (0.74 * n[0] - 0.12 * n[1] - 0.66 * n[2]);
  return 0.42 + 0.56 * std::max(0.0, key) + 0.16 * std::max(0.0, fill);
}

std::uint8_t to_byte(double x) {
  return std::uint8_t(std::clamp(x + 0.5, 0.0, 255.0));
}
Color scaled(Color c, double s) {
  return {to_byte(c.r * s), to_byte(c.g * s), to_byte(c.b * s)};
}
/// Converts linear light, as lib/core/color.h does.
Color shown(double r, double g, double b) {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> t(65536 / 16);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto x = std::uint16_t(16 * i + 8);
      t[i] = srgb_bytes({x, x, x})[0];
    }
    return t;
  }();
  const auto at = [&](double x) { return table[std::size_t(std::clamp(x, 0.0, 65535.0)) / 16]; };
  return {at(r), at(g), at(b)};
}
Color blend(Color below, Color above, double a) {
  return {to_byte(below.r + a * (above.r - below.r)), to_byte(below.g + a * (above.g - below.g)),
          to_byte(below.b + a * (above.b - below.b))};
}

bool drawable(const Vec3d& p) {
  return std::abs(p[0]) < kMaxCoordinate && std::abs(p[1]) < kMaxCoordinate &&
         std::abs(p[2]) < std::numeric_limits<float>::max();
}
bool drawable(const TriangleD& t) {
  return drawable(t[0]) && drawable(t[1]) && drawable(t[2]);
}

/// Return the colour of a clipped triangle: the plain one, or its own.
Color color_of_part(const ClippedTriangle&, Color color) {
  return color;
}
const TriangleColors& color_of_part(const ClippedTriangle& t, const TriangleColors&) {
  return t.colors;
}
std::vector<ClippedTriangle> clipped(const TriangleD& t, Color) {
  return clip(t, TriangleColors{}, kClipped);
}
std::vector<ClippedTriangle> clipped(const TriangleD& t, const TriangleColors& colors) {
  return clip(t, colors, kClipped);
}

/// Returns whether samples on an edge belong to the triangle. Exactly one of the two triangles at an edge owns them.
bool owns_its_samples(std::int64_t dx, std::int64_t dy) {
  return dy > 0 || (dy == 0 && dx < 0);
}

}  // namespace

/// A triangle ready to be drawn: snapped corners in counter-clockwise order on the screen, colour, depth as a plane.
struct Canvas::Shaded {
  std::int32_t x[3], y[3];
  int x_min = 0, x_max = -1, y_min = 0, y_max = -1;  // samples whose centres may be inside; empty if x_max < x_min
  double z, dz_dx, dz_dy;                            // depth at sample (0, 0), clamped to [z_low, z_high]
  float z_low, z_high;
  Vec3d normal{};
  Color base, color;    // without and with the shade
  bool varies = false;  // whether the colour varies: linear light as planes
  double light[3]{}, dl_dx[3]{}, dl_dy[3]{};
  double s = 1, ds_dx = 0, ds_dy = 0;                     // the shade at sample (0, 0), and its steps
  bool is_smooth = false;                                 // whether the shade varies
  std::uint32_t material = TriangleTexture::kNoMaterial;  // of the image on the triangle; its place is given by planes
  double uv[2], duv_dx[2], duv_dy[2];

  Shaded() = default;
  Shaded(const TriangleD& t, const TriangleColors& colors, int width, int height)
      : Shaded(t, shown(colors[0].r, colors[0].g, colors[0].b), width, height) {
    varies = (colors[0] != colors[1] || colors[0] != colors[2]) && x_min <= x_max;
    const auto channel = [](LinearColor c, int i) { return double(i == 0 ? c.r : i == 1 ? c.g : c.b); };
    for (int i = 0; i < 3; ++i) {
      light[i] = channel(colors[0], i);
      if (varies) set_plane(t, {light[i], channel(colors[1], i), channel(colors[2], i)}, light[i], dl_dx[i], dl_dy[i]);
    }
  }
  /// Computes the linear function with these values at the corners: its value at sample (0, 0), and its steps.
  static void set_plane(const TriangleD& t, const Vec3d& at, double& first, double& d_dx, double& d_dy) {
    const double ux = t[1][0] - t[0][0], uy = t[1][1] - t[0][1], vx = t[2][0] - t[0][0], vy = t[2][1] - t[0][1];
    const double du = at[1] - at[0], dv = at[2] - at[0];
    d_dx = (du * vy - dv * uy) / (ux * vy - uy * vx), d_dy = (dv * ux - du * vx) / (ux * vy - uy * vx);
    first = at[0] + (0.5 - t[0][0]) * d_dx + (0.5 - t[0][1]) * d_dy;
  }
  /// Shades the part by the normals at the corners of `t`, the whole triangle.
  void shade_by(const Normals& normals, const TriangleD& t) {
    if (x_min > x_max) return;
    Vec3d at{};
    for (std::size_t k = 0; k < 3; ++k) {
      const bool none = normals[k] == Vec3d{};
      at[k] = shade(none ? normal : normals[k], facing(normal));
    }
    is_smooth = true;
    set_plane(t, at, s, ds_dx, ds_dy);
  }
  [[nodiscard]] double shade_at(int px, int py) const { return s + px * ds_dx + py * ds_dy; }
  /// Lays an image on the part. `t`: the whole triangle.
  void lay(const TriangleTexture& texture, const TriangleD& t) {
    if (x_min > x_max) return;
    material = texture.material;
    for (std::size_t i = 0; i < 2; ++i)
      set_plane(t, {texture.uv[0][i], texture.uv[1][i], texture.uv[2][i]}, uv[i], duv_dx[i], duv_dy[i]);
  }
  /// Returns linear light, before the shade.
  [[nodiscard]] std::array<double, 3> light_at(int px, int py) const {
    const auto at = [&](int i) { return light[i] + px * dl_dx[i] + py * dl_dy[i]; };
    return {at(0), at(1), at(2)};
  }
  [[nodiscard]] Color color_at(int px, int py) const {
    if (!varies) return is_smooth ? scaled(base, shade_at(px, py)) : color;
    const auto [r, g, b] = light_at(px, py);
    return scaled(shown(r, g, b), shade_at(px, py));
  }
  Shaded(const TriangleD& t, Color plain, int width, int height) : base(plain) {
    if (!drawable(t)) return;
    const Vec3d u{t[1][0] - t[0][0], t[1][1] - t[0][1], t[1][2] - t[0][2]};
    const Vec3d v{t[2][0] - t[0][0], t[2][1] - t[0][1], t[2][2] - t[0][2]};
    Vec3d n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 0) || !std::isfinite(length) || n[2] == 0) return;
    dz_dx = -n[0] / n[2], dz_dy = -n[1] / n[2];
    z = t[0][2] + (0.5 - t[0][0]) * dz_dx + (0.5 - t[0][1]) * dz_dy;
    z_low = float(std::min({t[0][2], t[1][2], t[2][2]})), z_high = float(std::max({t[0][2], t[1][2], t[2][2]}));
    normal = {n[0] / length, n[1] / length, n[2] / length};
    s = shade(normal, facing(normal));
    color = scaled(base, s);
    for (int k = 0; k < 3; ++k) {
      const std::size_t from = n[2] > 0 ? std::size_t(k) : std::size_t(2 - k);
      x[k] = std::int32_t(std::lround(t[from][0] * kSub)), y[k] = std::int32_t(std::lround(t[from][1] * kSub));
    }
    const auto [x0, x1] = std::minmax({x[0], x[1], x[2]});
    const auto [y0, y1] = std::minmax({y[0], y[1], y[2]});
    x_min = std::max(0, sample_at_or_after(x0)), x_max = std::min(width - 1, sample_at_or_before(x1));
    y_min = std::max(0, sample_at_or_after(y0)), y_max = std::min(height - 1, sample_at_or_before(y1));
  }

  /// Returns the first sample at or after c. Sample i has its centre at (i + 1/2) * 256.
  static int sample_at_or_after(std::int32_t c) { return (c + (1 << (kSubBits - 1)) - 1) >> kSubBits; }
  static int sample_at_or_before(std::int32_t c) { return (c - (1 << (kSubBits - 1))) >> kSubBits; }
};

/// Paints images on triangles; null: there are none.
class Canvas::Painter {
 public:
  Painter() = default;
  Painter(std::span<const TriangleTexture> textures, ImageCache* images)
      : textures_(images != nullptr ? textures : std::span<const TriangleTexture>()), images_(images) {}

  void lay(Shaded& shaded, std::size_t i, const TriangleD& t) const {
    if (i < textures_.size()) shaded.lay(textures_[i], t);
  }

  /// The image of one triangle.
  class Coat {
   public:
    Coat(const Painter& painter, const Shaded& t) : t_(t) {
      if (t.material == TriangleTexture::kNoMaterial) return;
      material_ = &painter.images_->material(t.material);
      area_ = std::abs(t.duv_dx[0] * t.duv_dy[1] - t.duv_dx[1] * t.duv_dy[0]);
      image_ = painter.images_->get(material_->image);
      const TextureSurface& surface = material_->surface;
      glow_ = painter.images_->get(surface.emission.image);
      glows_ = surface.emission_factor != std::array<float, 3>{} && (glow_ != nullptr || !surface.emission.is_there());
    }
    /// Returns the colour; false at a hole. An alpha between 0 and 1 is a hole below a half.
    bool color_at(int x, int y, Color& color) const {
      if (image_ == nullptr && !glows_) {
        color = t_.color_at(x, y);
        return true;
      }
      const LinearTexel texel = texel_at(image_.get(), x, y, material_->wrap);
      const float least = material_->alpha_mode == AlphaMode::mask ? material_->cutoff : 0.5F;
      if (material_->alpha_mode != AlphaMode::opaque && texel[3] * material_->alpha < least) return false;
      std::array<double, 3> light{65535, 65535, 65535};
      if (!material_->replaces_color || image_ == nullptr) light = t_.light_at(x, y);
      for (std::size_t i = 0; i < 3; ++i) light[i] *= double(texel[i]);
      if (glows_) add_glow(light, x, y);
      color = scaled(shown(light[0], light[1], light[2]), t_.shade_at(x, y));
      return true;
    }

   private:
    [[nodiscard]] LinearTexel texel_at(const MipImage* image, int x, int y,
                                       const std::array<TextureWrap, 2>& wrap) const {
      if (image == nullptr) return {1, 1, 1, 1};
      const auto place = [&](std::size_t i) { return t_.uv[i] + x * t_.duv_dx[i] + y * t_.duv_dy[i]; };
      return image->at(place(0), place(1), std::sqrt(area_ * image->width() * image->height()), wrap);
    }
    void add_glow(std::array<double, 3>& light, int x, int y) const {
      const LinearTexel texel = texel_at(glow_.get(), x, y, material_->surface.emission.wrap);
      for (std::size_t i = 0; i < 3; ++i)
        light[i] = std::min(65535.0, light[i] + 65535 * double(material_->surface.emission_factor[i] * texel[i]));
    }
    const Shaded& t_;
    const TextureMaterial* material_ = nullptr;
    std::shared_ptr<const MipImage> image_, glow_;
    bool glows_ = false;
    double area_ = 0;  // area of a pixel in the image
  };

 private:
  std::span<const TriangleTexture> textures_;
  ImageCache* images_ = nullptr;
};

Canvas::Canvas(int width, int height, Color background)
    : width_(width),
      height_(height),
      depth_(std::size_t(width) * std::size_t(height), std::numeric_limits<float>::infinity()),
      color_(depth_.size(), background) {}

void Canvas::for_each_band(const std::function<void(Row)>& body) const {
  parallel_for((height_ + kBand - 1) / kBand, [&](std::int64_t i) {
    body({int(i) * kBand, std::min(height_, int(i + 1) * kBand)});
  });
}

void Canvas::draw(std::span<const TriangleD> triangles, Color color, std::span<const Normals> normals) {
  draw_shaded(triangles, [&](std::size_t) { return color; }, normals, {});
}

void Canvas::draw(std::span<const TriangleD> triangles, std::span<const TriangleColors> colors,
                  std::span<const Normals> normals, std::span<const TriangleTexture> textures, ImageCache* images) {
  draw_shaded(
      triangles, [&](std::size_t i) { return colors[i]; }, normals, Painter(textures, images));
}

template <class ColorOf>
void Canvas::draw_shaded(std::span<const TriangleD> triangles, const ColorOf& color_of,
                         std::span<const Normals> normals, const Painter& painter) {
  constexpr std::size_t kBatch = 1 << 15;
  std::vector<Shaded> ready;
  const auto coat = [&](Shaded& shaded, std::size_t i) {
    if (i < normals.size()) shaded.shade_by(normals[i], triangles[i]);
    painter.lay(shaded, i, triangles[i]);
  };
  for (std::size_t begin = 0; begin < triangles.size(); begin += kBatch) {
    const std::size_t n = std::min(kBatch, triangles.size() - begin);
    ready.resize(n);
    parallel_ranges(std::int64_t(n), 1024, [&](std::int64_t b, std::int64_t e) {
      for (auto i = std::size_t(b); i < std::size_t(e); ++i) {
        ready[i] = Shaded(triangles[begin + i], color_of(begin + i), width_, height_);
        coat(ready[i], begin + i);
      }
    });
    for (std::size_t i = begin; i < begin + n; ++i) {
      if (drawable(triangles[i])) continue;
      for (const ClippedTriangle& part : clipped(triangles[i], color_of(i))) {
        ready.emplace_back(part.corners, color_of_part(part, color_of(i)), width_, height_);
        coat(ready.back(), i);
      }
    }
    for_each_band([&](Row rows) {
      for (const Shaded& t : ready)
        if (t.y_min < rows.end && t.y_max >= rows.begin && t.x_min <= t.x_max) fill(t, rows, painter);
    });
  }
}

void Canvas::fill(const Shaded& t, Row rows, const Painter& painter) {
  // Twice the signed areas of (edge, sample centre) are stepped from sample to sample. A sample is inside if all are
  // positive, or zero on an edge that owns its samples.
  std::int64_t row_value[3], step_x[3], step_y[3];
  const int y_begin = std::max(t.y_min, rows.begin), y_end = std::min(t.y_max + 1, rows.end);
  for (int e = 0; e < 3; ++e) {
    const int f = (e + 1) % 3;
    const std::int64_t dx = std::int64_t(t.x[f]) - t.x[e], dy = std::int64_t(t.y[f]) - t.y[e];
    const std::int64_t cx = (std::int64_t(t.x_min) << kSubBits) + (1 << (kSubBits - 1)) - t.x[e];
    const std::int64_t cy = (std::int64_t(y_begin) << kSubBits) + (1 << (kSubBits - 1)) - t.y[e];
    row_value[e] = dx * cy - dy * cx - (owns_its_samples(dx, dy) ? 0 : 1);
    step_x[e] = -dy * (1 << kSubBits), step_y[e] = dx * (1 << kSubBits);
  }
  const Painter::Coat coat(painter, t);
  for (int y = y_begin; y < y_end; ++y) {
    std::int64_t a = row_value[0], b = row_value[1], c = row_value[2];
    const std::size_t row = std::size_t(y) * std::size_t(width_);
    for (int x = t.x_min; x <= t.x_max; ++x, a += step_x[0], b += step_x[1], c += step_x[2]) {
      if ((a | b | c) < 0) continue;
      const float z = std::clamp(float(t.z + x * t.dz_dx + y * t.dz_dy), t.z_low, t.z_high);
      if (z >= depth_[row + std::size_t(x)] || !coat.color_at(x, y, color_[row + std::size_t(x)])) continue;
      depth_[row + std::size_t(x)] = z;
    }
    for (int e = 0; e < 3; ++e) row_value[e] += step_y[e];
  }
}

/// Returns whether a point is hidden. The farthest of the samples around it counts, so that a steep face does not hide
/// its own edge.
bool Canvas::hidden(double x, double y, double depth) const {
  const int cx = int(std::floor(x)), cy = int(std::floor(y));
  float farthest = -std::numeric_limits<float>::infinity();
  for (int j = std::max(0, cy - 1); j <= std::min(height_ - 1, cy + 1); ++j)
    for (int i = std::max(0, cx - 1); i <= std::min(width_ - 1, cx + 1); ++i)
      farthest = std::max(farthest, depth_[std::size_t(j) * std::size_t(width_) + std::size_t(i)]);
  return depth > double(farthest) + 0.5;
}

void Canvas::draw_lines(std::span<const std::array<Vec3d, 2>> lines, Color color, double half_width) {
  for_each_band([&](Row rows) {
    for (std::array<Vec3d, 2> line : lines) {
      if ((!drawable(line[0]) || !drawable(line[1])) && !clip(line, kClipped)) continue;
      const double low = std::min(line[0][1], line[1][1]) - half_width - 1;
      const double high = std::max(line[0][1], line[1][1]) + half_width + 1;
      if (low < rows.end && high >= rows.begin) draw_line(line, color, half_width, rows);
    }
  });
}

void Canvas::draw_line(const std::array<Vec3d, 2>& line, Color color, double half_width, Row rows) {
  const Vec3d &p = line[0], &q = line[1];
  const double dx = q[0] - p[0], dy = q[1] - p[1], length_squared = dx * dx + dy * dy;
  const double reach = half_width + 0.5;
  const int y_begin = std::max(rows.begin, int(std::floor(std::min(p[1], q[1]) - reach)));
  const int y_end = std::min(rows.end, int(std::ceil(std::max(p[1], q[1]) + reach)));
  for (int y = y_begin; y < y_end; ++y) {
    // The part of the line within reach of this row, as parameters along it.
    double t0 = 0, t1 = 1;
    if (dy != 0) {
      const double a = (y + 0.5 - reach * 1.5 - p[1]) / dy, b = (y + 0.5 + reach * 1.5 - p[1]) / dy;
      t0 = std::clamp(std::min(a, b), 0.0, 1.0), t1 = std::clamp(std::max(a, b), 0.0, 1.0);
    }
    const double xa = p[0] + t0 * dx, xb = p[0] + t1 * dx;
    const int x_begin = std::max(0, int(std::floor(std::min(xa, xb) - 1.5 * reach)));
    const int x_end = std::min(width_, int(std::ceil(std::max(xa, xb) + 1.5 * reach)));
    for (int x = x_begin; x < x_end; ++x) {
      const double px = x + 0.5 - p[0], py = y + 0.5 - p[1];
      const double t = length_squared > 0 ? std::clamp((px * dx + py * dy) / length_squared, 0.0, 1.0) : 0;
      const double ex = px - t * dx, ey = py - t * dy;
      const double coverage = std::clamp(reach - std::sqrt(ex * ex + ey * ey), 0.0, 1.0);
      if (coverage == 0 || hidden(p[0] + t * dx, p[1] + t * dy, p[2] + t * (q[2] - p[2]))) continue;
      Color& c = color_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
      c = blend(c, color, coverage * 0.8);
    }
  }
}

std::optional<double> Canvas::depth(int x, int y) const {
  const float z = depth_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
  return std::isfinite(z) ? std::optional<double>(z) : std::nullopt;
}

void Canvas::resolve(Image& image, int x, int y) const {
  for (int j = 0; j < height_ / 2; ++j) {
    for (int i = 0; i < width_ / 2; ++i) {
      const Color* upper = &color_[std::size_t(2 * j) * std::size_t(width_) + std::size_t(2 * i)];
      const Color* lower = upper + width_;
      const auto mean = [&](auto channel) {
        return std::uint8_t((upper[0].*channel + upper[1].*channel + lower[0].*channel + lower[1].*channel + 2) / 4);
      };
      image.at(x + i, y + j) = {mean(&Color::r), mean(&Color::g), mean(&Color::b)};
    }
  }
}

}  // namespace bp
