#include "lib/pass/bake/bake.h"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/mesh/shaded_mesh.h"
#include "lib/pass/bake/detail/push_pull.h"

namespace bp {

namespace {

constexpr int kSide = 2;          // samples along a side of a texel
constexpr double kBefore = 1e-4;  // of the reach
constexpr int kBand = 16;         // rows of texels at a time

/// A face as it lies in the image and in the scene.
struct Face {
  std::array<std::array<float, 2>, 3> flat;
  TriangleD corners;
  std::array<Vec3d, 3> normals;
};

/// The sums of some rows of texels.
class Band {
 public:
  Band(const SceneLooks& looks, const BakeParams& params, double texel, PartialImage& image, int first)
      : scene_(looks.triangles()),
        eye_(looks),
        params_(params),
        size_(texel / kSide),
        image_(image),
        first_(first),
        last_(std::min(first + kBand, image.height)) {}

  void add(const Face& face) {
    const auto& f = face.flat;
    const double area = edge(f[0], f[1], f[2][0], f[2][1]);
    if (area == 0) return;
    const auto [left, right] = std::minmax({f[0][0], f[1][0], f[2][0]});
    const auto [top, bottom] = std::minmax({f[0][1], f[1][1], f[2][1]});
    for (int y = std::max(first_, int(top)); y < std::min(last_, int(bottom) + 1); ++y) {
      for (int x = std::max(0, int(left)); x < std::min(image_.width, int(right) + 1); ++x) add_texel(face, area, x, y);
    }
    add_middle(face);
  }

 private:
  static double edge(const std::array<float, 2>& a, const std::array<float, 2>& b, double x, double y) {
    return (double(b[0]) - a[0]) * (y - a[1]) - (double(b[1]) - a[1]) * (x - a[0]);
  }

  void add_texel(const Face& face, double area, int x, int y) {
    for (int k = 0; k < kSide * kSide; ++k) {
      const double px = x + (k % kSide + 0.5) / kSide, py = y + (k / kSide + 0.5) / kSide;
      const double a = edge(face.flat[1], face.flat[2], px, py) / area,
                   b = edge(face.flat[2], face.flat[0], px, py) / area, c = 1 - a - b;
      if (a < 0 || b < 0 || c < 0) continue;
      add_sample(face, {a, b, c}, x, y, (float(k) + 0.5F) / (kSide * kSide));
    }
  }
  /// A face between all samples of a texel is not lost if the texel has no other.
  void add_middle(const Face& face) {
    const auto& f = face.flat;
    const int x = int((f[0][0] + f[1][0] + f[2][0]) / 3), y = int((f[0][1] + f[1][1] + f[2][1]) / 3);
    if (y < first_ || y >= last_ || x < 0 || x >= image_.width || weight(x, y) > 0) return;
    add_sample(face, {1.0 / 3, 1.0 / 3, 1.0 / 3}, x, y, 0.5F);
  }

  [[nodiscard]] float& weight(int x, int y) {
    return image_.weight[std::size_t(y) * std::size_t(image_.width) + std::size_t(x)];
  }

  void add_sample(const Face& face, const std::array<double, 3>& part, int x, int y, float threshold) {
    Vec3d p{}, n{};
    for (std::size_t k = 0; k < 3; ++k) {
      p = p + part[k] * face.corners[k];
      n = n + part[k] * face.normals[k];
    }
    const double l = length(n);
    const std::optional<Look> found = seen(p, l > 0 ? (1 / l) * n : face.normals[0], threshold);
    if (!found) return;
    const Look& look = *found;
    LinearTexel& sum = image_.texels[std::size_t(y) * std::size_t(image_.width) + std::size_t(x)];
    for (std::size_t i = 0; i < 3; ++i) sum[i] += look.color[i] * look.alpha;
    sum[3] += look.alpha;
    weight(x, y) += 1;
  }

  /// Nothing if the scene is out of reach.
  std::optional<Look> seen(const Vec3d& p, const Vec3d& n, float threshold) {
    bool through = false;                                        // a hole
    const Vec3d out = params_.reach_world * n, in = -1.0 * out;  // from a little before: they may touch
    const Vec3d start_in = p + kBefore * out, start_out = p + kBefore * in;
    std::optional<TriangleBvh::Hit> hit = look_along(start_in, in, threshold, through);
    Vec3d start = start_in, direction = in;
    if (params_.both_ways) {
      const auto outwards = look_along(start_out, out, threshold, through);
      if (outwards && (!hit || outwards->along < hit->along)) hit = outwards, start = start_out, direction = out;
    }
    if (hit) return opaque(eye_.at(hit->item, start + hit->along * direction, size_));
    const TriangleBvh::Nearest nearest = scene_.nearest(p, near_);
    near_ = nearest.item;
    if (nearest.distance_squared > params_.reach_world * params_.reach_world) return {};
    Look look = opaque(eye_.at(near_, nearest_point(p, scene_.item(near_).corners), size_));
    if (through) look.alpha = 0;
    return look;
  }
  std::optional<TriangleBvh::Hit> look_along(const Vec3d& p, const Vec3d& direction, float threshold, bool& through) {
    return scene_.first_along(p, direction, [&](std::uint32_t item, double along) {
      const bool covers = eye_.covers(item, p + along * direction, size_, threshold);
      through = through || !covers;
      return covers;
    });
  }
  static Look opaque(Look look) {
    look.alpha = 1;
    return look;
  }

  const TriangleBvh& scene_;
  SceneLooks::Eye eye_;
  const BakeParams& params_;
  double size_;
  PartialImage& image_;
  int first_, last_;
  std::uint32_t near_ = 0;  // found last
};

std::vector<Face> faces_of(const LatticeMesh& mesh, const Atlas& atlas) {
  const ShadedMesh drawn = shaded(mesh);
  std::vector<Face> faces(mesh.triangles.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    faces[f].flat = atlas.corners[f];
    for (std::size_t k = 0; k < 3; ++k) {
      faces[f].corners[k] = mesh.frame.world(mesh.vertices[mesh.triangles[f][k]]);
      const std::array<float, 3>& n = drawn.normals[drawn.triangles[f][k]];
      faces[f].normals[k] = {n[0], n[1], n[2]};
    }
  }
  return faces;
}

/// Faces by the bands of rows that they touch, in order.
std::vector<std::vector<std::uint32_t>> by_band(const std::vector<Face>& faces, int height) {
  std::vector<std::vector<std::uint32_t>> bands(std::size_t((height + kBand - 1) / kBand));
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const auto [top, bottom] = std::minmax({faces[f].flat[0][1], faces[f].flat[1][1], faces[f].flat[2][1]});
    for (int b = int(top) / kBand; b <= std::min(int(bottom) / kBand, int(bands.size()) - 1); ++b)
      bands[std::size_t(b)].push_back(f);
  }
  return bands;
}

/// Sums become means; a hole has no colour of its own.
void divide(PartialImage& image) {
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    LinearTexel& t = image.texels[i];
    const float alpha = t[3], weight = image.weight[i];
    for (std::size_t k = 0; k < 3 && alpha > 0; ++k) t[k] /= alpha;
    if (weight > 0) t[3] = alpha / weight;
    if (alpha == 0) image.weight[i] = 0;
  }
}

}  // namespace

TextureImage bake(const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks, const BakeParams& params) {
  const std::vector<Face> faces = faces_of(mesh, atlas);
  const std::vector<std::vector<std::uint32_t>> bands = by_band(faces, atlas.height);
  PartialImage image{atlas.width, atlas.height, {}, {}};
  image.texels.resize(std::size_t(atlas.width) * std::size_t(atlas.height));
  image.weight.resize(image.texels.size());
  const double texel = atlas.texel * mesh.frame.voxel / kLatticePerVoxel;
  parallel_for(std::int64_t(bands.size()), [&](std::int64_t b) {
    Band band(looks, params, texel, image, int(b) * kBand);
    for (const std::uint32_t f : bands[std::size_t(b)]) band.add(faces[f]);
  });
  std::vector<float> alpha(image.texels.size(), 1);
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    if (image.weight[i] > 0) alpha[i] = image.texels[i][3] / image.weight[i];
  }
  divide(image);
  fill_gaps(image);
  TextureImage out(atlas.width, atlas.height);
  for (std::size_t i = 0; i < out.texels.size(); ++i) {
    const LinearTexel& t = image.texels[i];
    out.texels[i] = {byte_of_linear(t[0]), byte_of_linear(t[1]), byte_of_linear(t[2]),
                     std::uint8_t(alpha[i] * 255 + 0.5F)};
  }
  return out;
}

}  // namespace bp
