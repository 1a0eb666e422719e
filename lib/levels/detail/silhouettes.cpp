#include "lib/levels/detail/silhouettes.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/grid/count_bits.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr double kHighestView = 50;  // degrees above the horizon

}  // namespace

Silhouettes::Silhouettes(const LatticeBox& box, UpAxis up) : centre_(0.5 * to_double(box.min + box.max)) {
  const Vec3d size = to_double(box.max - box.min);
  pixels_ = kSide / std::max(length(size), 1.0);
  const AxisTurn to_scene = to_y_up(up).inverse();
  const double golden = M_PI * (3 - std::sqrt(5.0));  // turned by it, views come from all around
  for (std::size_t i = 0; i < kViews; ++i) {
    const double around = double(i) * golden, above = (double(i) + 0.5) / kViews * kHighestView * (M_PI / 180);
    const Vec3d away =
        to_scene(Vec3d{-std::sin(around) * std::cos(above), -std::sin(above), -std::cos(around) * std::cos(above)});
    const Vec3d right = to_scene(Vec3d{std::cos(around), 0, -std::sin(around)});
    double seen = 0;
    for (std::size_t k = 0; k < 3; ++k) seen += std::abs(away[k]) * size[(k + 1) % 3] * size[(k + 2) % 3];
    views_[i] = {right, cross(away, right), seen * pixels_ * pixels_};
  }
}

double Silhouettes::share(const LatticeMesh& mesh) const {
  double sum = 0;
  for (const View& view : views_) {
    if (view.pixels_of_box > 0) sum += double(pixels_of(view, mesh)) / view.pixels_of_box;
  }
  return sum / kViews;
}

std::uint64_t Silhouettes::pixels_of(const View& view, const LatticeMesh& mesh) const {
  Picture picture{};
  for (const auto& t : mesh.triangles) {
    std::array<Flat, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = flat(view, to_double(mesh.vertices[t[k]]));
    fill(corners, picture);
  }
  return count_bits(std::as_bytes(std::span(picture)));
}

Silhouettes::Flat Silhouettes::flat(const View& view, const Vec3d& p) const {
  const Vec3d d = p - centre_;
  return {kSide / 2 + pixels_ * dot(d, view.right), kSide / 2 + pixels_ * dot(d, view.down)};
}

/// Sets the pixels whose middles lie in the triangle, row by row.
void Silhouettes::fill(const std::array<Flat, 3>& corners, Picture& picture) {
  const auto [low, high] = std::minmax({corners[0][1], corners[1][1], corners[2][1]});
  const int first = std::max(0, int(std::ceil(low - 0.5))), last = std::min(kSide - 1, int(std::floor(high - 0.5)));
  for (int y = first; y <= last; ++y) {
    const double middle = y + 0.5;
    double from = kSide, to = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Flat &p = corners[k], &q = corners[(k + 1) % 3];
      if ((p[1] <= middle) == (q[1] <= middle)) continue;
      const double x = p[0] + (middle - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
      from = std::min(from, x);
      to = std::max(to, x);
    }
    const int begin = std::max(0, int(std::ceil(from - 0.5)));
    const int end = std::min(kSide, int(std::floor(to - 0.5)) + 1);
    for (int x = begin; x < end;) {
      const int word_end = std::min(end, (x / 64 + 1) * 64);
      const std::uint64_t bits = ~std::uint64_t(0) >> (64 - (word_end - x)) << x % 64;
      picture[std::size_t(y) * kWordsOfRow + std::size_t(x / 64)] |= bits;
      x = word_end;
    }
  }
}

}  // namespace bp
