#include "lib/pass/bake/bake.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/mesh/shaded_mesh.h"
#include "lib/pass/bake/detail/mip_image.h"
#include "lib/pass/bake/detail/push_pull.h"

namespace bp {

namespace {

constexpr int kSide = 2;  // samples along a side of a texel
/// The image, which texels are known, smaller copies; and the file that is made of it.
constexpr std::uint64_t kBytesPerTexel = 9, kBytesPerFace = sizeof(TriangleD) + 400;
constexpr double kBefore = 1e-4;  // of the reach
constexpr int kBand = 16;         // rows of texels at a time

/// A face as it lies in the image and in the scene.
struct Face {
  std::array<std::array<float, 2>, 3> flat;
  TriangleD corners;
  std::array<Vec3d, 3> normals;
};

/// Some rows of texels: sums of colours by how much they cover, and of samples.
class Band {
 public:
  Band(const SceneLooks& looks, const BakeParams& params, double texel, const TextureImage& image, int first)
      : scene_(looks.triangles()),
        eye_(looks),
        params_(params),
        size_(texel / kSide),
        width_(image.width),
        first_(first),
        last_(std::min(first + kBand, image.height)),
        sums_(std::size_t(width_) * std::size_t(last_ - first)),
        samples_(sums_.size()) {}

  void add(const Face& face) {
    const auto& f = face.flat;
    const double area = edge(f[0], f[1], f[2][0], f[2][1]);
    if (area == 0) return;
    const auto [left, right] = std::minmax({f[0][0], f[1][0], f[2][0]});
    const auto [top, bottom] = std::minmax({f[0][1], f[1][1], f[2][1]});
    for (int y = std::max(first_, int(top)); y < std::min(last_, int(bottom) + 1); ++y) {
      for (int x = std::max(0, int(left)); x < std::min(width_, int(right) + 1); ++x) add_texel(face, area, x, y);
    }
    add_middle(face);
  }

  /// Means; `known`: which texels have a colour.
  void write(TextureImage& image, std::vector<std::uint8_t>& known) const {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const LinearTexel& sum = sums_[i];
      const std::size_t to = std::size_t(first_) * std::size_t(width_) + i;
      const float alpha = sum[3];
      if (alpha > 0)
        for (std::size_t k = 0; k < 3; ++k) image.texels[to][k] = byte_of_linear(sum[k] / alpha);
      image.texels[to][3] = samples_[i] > 0 ? std::uint8_t(alpha / float(samples_[i]) * 255 + 0.5F) : std::uint8_t(255);
      known[to] = alpha > 0;
    }
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
    if (y < first_ || y >= last_ || x < 0 || x >= width_ || samples_[at(x, y)] > 0) return;
    add_sample(face, {1.0 / 3, 1.0 / 3, 1.0 / 3}, x, y, 0.5F);
  }

  [[nodiscard]] std::size_t at(int x, int y) const {
    return std::size_t(y - first_) * std::size_t(width_) + std::size_t(x);
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
    LinearTexel& sum = sums_[at(x, y)];
    for (std::size_t i = 0; i < 3; ++i) sum[i] += look.color[i] * look.alpha;
    sum[3] += look.alpha;
    ++samples_[at(x, y)];
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
  int width_, first_, last_;
  std::vector<LinearTexel> sums_;
  std::vector<std::uint16_t> samples_;
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

}  // namespace

TextureImage bake(const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks, const BakeParams& params) {
  const std::uint64_t texels = std::uint64_t(atlas.width) * std::uint64_t(atlas.height);
  const std::uint64_t needed = texels * kBytesPerTexel + mesh.triangles.size() * kBytesPerFace;
  if (needed > params.memory.bytes)
    throw NeedsMemory(fmt::format("baking a texture of {} x {} texels", atlas.width, atlas.height), needed,
                      params.memory.bytes, params.memory.limit_with(needed - params.memory.bytes),
                      {Remedy::no_textures});
  const std::vector<Face> faces = faces_of(mesh, atlas);
  const std::vector<std::vector<std::uint32_t>> bands = by_band(faces, atlas.height);
  TextureImage image(atlas.width, atlas.height);
  std::vector<std::uint8_t> known(image.texels.size());
  const double texel = atlas.texel * mesh.frame.voxel / kLatticePerVoxel;
  parallel_for(std::int64_t(bands.size()), [&](std::int64_t b) {
    Band band(looks, params, texel, image, int(b) * kBand);
    for (const std::uint32_t f : bands[std::size_t(b)]) band.add(faces[f]);
    band.write(image, known);
  });
  fill_gaps(image, known);
  return image;
}

}  // namespace bp
