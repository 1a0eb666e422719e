#include "lib/pass/bake/bake.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/atlas/tangents.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/image/mip_image.h"
#include "lib/mesh/shaded_mesh.h"
#include "lib/pass/bake/detail/push_pull.h"
#include "lib/pass/bake/detail/scene_eye.h"

namespace bp {

namespace {

constexpr int kSide = 2;  // samples along a side of a texel
/// Bytes of the image, the mask of known texels, smaller copies, and the file that is made of them.
constexpr std::uint64_t kBytesPerTexel = 9, kBytesPerSurfaceTexel = 21, kBytesPerFace = sizeof(TriangleD) + 400;
constexpr double kBefore = 1e-4;  // of the reach
constexpr int kSquare = 32;       // texels along a side, at work at a time

/// A face as it lies in the image and in the scene.
struct Face {
  std::array<std::array<float, 2>, 3> flat;
  TriangleD corners;
  std::array<Vec3d, 3> normals;
  std::array<Vec3d, 3> tangents{};  // set if surfaces are wanted
  double mirrored = 1;              // as tangents_of() returns it
};

/// Images to be filled; all but the first may be null.
struct Canvas {
  TextureImage* color;
  TextureImage* normal = nullptr;
  TextureImage* roughness = nullptr;
  TextureImage* emission = nullptr;
};

/// Sums over a texel's samples, weighted by how much they cover.
struct SurfaceSum {
  Vec3d normal{};  // in tangent space
  float roughness = 0, metal = 0;
  std::array<float, 3> emission{};

  void add(const Look& look, const Vec3d& in_tangent_space) {
    normal = normal + double(look.alpha) * in_tangent_space;
    roughness += look.alpha * look.roughness;
    metal += look.alpha * look.metal;
    for (std::size_t i = 0; i < 3; ++i) emission[i] += look.alpha * look.emission[i];
  }
  void write(const Canvas& to, int x, int y, float alpha) const {
    // Least component along the mesh's normal of a normal that looks away, since viewers know no others.
    constexpr double kLeast = 0.05;
    Vec3d n = normal;
    n[2] = std::max(n[2], kLeast * length(n));
    const double l = length(n);
    n = l > 0 ? (1 / l) * n : Vec3d{0, 0, 1};  // the samples may cancel
    TextureImage::Texel& texel = to.normal->at(x, y);
    for (std::size_t i = 0; i < 3; ++i) texel[i] = std::uint8_t((n[i] / 2 + 0.5) * 255 + 0.5);
    const auto byte = [&](float sum) { return std::uint8_t(sum / alpha * 255 + 0.5F); };
    to.roughness->at(x, y) = {255, byte(roughness), byte(metal), 255};
    for (std::size_t i = 0; i < 3; ++i) to.emission->at(x, y)[i] = byte_of_linear(emission[i] / alpha);
  }
};

/// A chart's texels in a square of the image. No other chart has any of them.
struct Plot {
  // Place along a curve through the scene's space: neighbours need the same blocks of the scene.
  std::uint64_t place = 0;
  std::array<int, 2> begin{}, end{};
  std::vector<std::uint32_t> faces;
};

/// Sums of colours, weighted by how much they cover, and numbers of samples.
class PlotBaker {
 public:
  PlotBaker(const SceneLooks& looks, const BakeParams& params, double texel, const Plot& plot, bool surfaces)
      : eye_(looks, surfaces),
        params_(params),
        size_(texel / kSide),
        begin_(plot.begin),
        end_(plot.end),
        sums_(std::size_t(end_[0] - begin_[0]) * std::size_t(end_[1] - begin_[1])),
        samples_(sums_.size()),
        surfaces_(surfaces ? sums_.size() : 0) {}

  void add(const Face& face) {
    const auto& f = face.flat;
    const double area = edge(f[0], f[1], f[2][0], f[2][1]);
    if (area == 0) return;
    const auto [left, right] = std::minmax({f[0][0], f[1][0], f[2][0]});
    const auto [top, bottom] = std::minmax({f[0][1], f[1][1], f[2][1]});
    for (int y = std::max(begin_[1], int(top)); y < std::min(end_[1], int(bottom) + 1); ++y) {
      for (int x = std::max(begin_[0], int(left)); x < std::min(end_[0], int(right) + 1); ++x)
        add_texel(face, area, x, y);
    }
    add_middle(face);
  }

  /// Writes the means, and marks their texels as known.
  void write(const Canvas& to, std::vector<BakedTexel>& known) const {
    TextureImage& image = *to.color;
    for (int y = begin_[1]; y < end_[1]; ++y) {
      for (int x = begin_[0]; x < end_[0]; ++x) {
        const std::uint16_t samples = samples_[at(x, y)];
        if (samples == 0) continue;
        const LinearTexel& sum = sums_[at(x, y)];
        TextureImage::Texel& texel = image.at(x, y);
        const float alpha = sum[3];
        for (std::size_t k = 0; k < 3 && alpha > 0; ++k) texel[k] = byte_of_linear(sum[k] / alpha);
        texel[3] = std::uint8_t(alpha / float(samples) * 255 + 0.5F);
        if (!surfaces_.empty() && alpha > 0) surfaces_[at(x, y)].write(to, x, y, alpha);
        known[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] =
            alpha > 0 ? BakedTexel::color : BakedTexel::hole;
      }
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
  /// Adds the middle of a face that lies between all samples of a texel, so that a texel without other samples does not
  /// lose it.
  void add_middle(const Face& face) {
    const auto& f = face.flat;
    const int x = int((f[0][0] + f[1][0] + f[2][0]) / 3), y = int((f[0][1] + f[1][1] + f[2][1]) / 3);
    if (y < begin_[1] || y >= end_[1] || x < begin_[0] || x >= end_[0] || samples_[at(x, y)] > 0) return;
    add_sample(face, {1.0 / 3, 1.0 / 3, 1.0 / 3}, x, y, 0.5F);
  }

  [[nodiscard]] std::size_t at(int x, int y) const {
    return std::size_t(y - begin_[1]) * std::size_t(end_[0] - begin_[0]) + std::size_t(x - begin_[0]);
  }

  void add_sample(const Face& face, const std::array<double, 3>& part, int x, int y, float threshold) {
    Vec3d p{}, n{};
    for (std::size_t k = 0; k < 3; ++k) {
      p = p + part[k] * face.corners[k];
      n = n + part[k] * face.normals[k];
    }
    const double l = length(n);
    n = l > 0 ? (1 / l) * n : face.normals[0];
    eye_.look_from(n);
    const std::optional<Look> found = seen(p, n, threshold);
    if (!found) return;
    const Look& look = *found;
    LinearTexel& sum = sums_[at(x, y)];
    for (std::size_t i = 0; i < 3; ++i) sum[i] += look.color[i] * look.alpha;
    sum[3] += look.alpha;
    if (!surfaces_.empty()) surfaces_[at(x, y)].add(look, in_tangent_space(face, part, n, look.normal));
    ++samples_[at(x, y)];
  }

  static Vec3d in_tangent_space(const Face& face, const std::array<double, 3>& part, const Vec3d& n,
                                const std::array<float, 3>& direction) {
    Vec3d tangent{};
    for (std::size_t k = 0; k < 3; ++k) tangent = tangent + part[k] * face.tangents[k];
    const Vec3d up = face.mirrored * cross(n, tangent), d{direction[0], direction[1], direction[2]};
    return {dot(d, tangent), dot(d, up), dot(d, n)};
  }

  /// Returns what a sample sees. Nothing if the scene is out of reach.
  std::optional<Look> seen(const Vec3d& p, const Vec3d& n, float threshold) {
    bool through = false;  // the line has gone through a hole
    // Lines begin a little before the surface, since both surfaces may touch.
    const Vec3d out = params_.reach_world * n, in = -1.0 * out;
    auto found = eye_.first_along(p + kBefore * out, in, size_, threshold, through);
    if (params_.both_ways) {
      const auto outwards = eye_.first_along(p + kBefore * in, out, size_, threshold, through);
      if (outwards && (!found || outwards->along < found->along)) found = outwards;
    }
    std::optional<Look> look = found ? found->look : eye_.nearest(p, params_.reach_world, size_, threshold);
    if (look) look->alpha = found || (!through && look->alpha > 0) ? 1 : 0;
    return look;
  }

  SceneEye eye_;
  const BakeParams& params_;
  double size_;
  std::array<int, 2> begin_, end_;
  std::vector<LinearTexel> sums_;
  std::vector<std::uint16_t> samples_;
  std::vector<SurfaceSum> surfaces_;  // empty if surfaces are not wanted
};

/// Returns the mesh as it is drawn with a texture, where charts are apart. Tangents change nothing else.
LatticeMesh with_places(const LatticeMesh& mesh, const Atlas& atlas) {
  LatticeMesh out = mesh;
  auto texture = std::make_shared<MeshTexture>();
  texture->uv = atlas.corners;
  texture->chart = atlas.chart;
  out.texture = std::move(texture);
  return out;
}

void add_tangents(const LatticeMesh& mesh, const Atlas& atlas, std::vector<Face>& faces) {
  const LatticeMesh placed = with_places(mesh, atlas);
  const ShadedMesh drawn = shaded(placed);
  const std::vector<std::array<float, 4>> tangents = tangents_of(placed, drawn);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<float, 4>& t = tangents[drawn.triangles[f][k]];
      faces[f].tangents[k] = {t[0], t[1], t[2]};
      faces[f].mirrored = double(t[3]);
    }
  }
}

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

/// Adds the squares of the image that faces of a chart touch.
void add_plots(const std::vector<std::uint32_t>& chart, const std::vector<Face>& faces, const Bounds3d& bounds,
               std::vector<Plot>& plots) {
  std::map<std::array<int, 2>, std::size_t> by_square;
  for (const std::uint32_t f : chart) {
    const auto& p = faces[f].flat;
    const auto [left, right] = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto [top, bottom] = std::minmax({p[0][1], p[1][1], p[2][1]});
    for (int y = int(top) / kSquare; y <= int(bottom) / kSquare; ++y) {
      for (int x = int(left) / kSquare; x <= int(right) / kSquare; ++x) {
        const auto [found, is_new] = by_square.try_emplace({y, x}, plots.size());
        if (is_new) plots.push_back({morton_of(middle_of(faces[f].corners), bounds), {int(left), int(top)}, {}, {}});
        Plot& plot = plots[found->second];
        plot.faces.push_back(f);
        const std::array<int, 2> lo{int(left), int(top)}, hi{int(right) + 1, int(bottom) + 1}, square{x, y};
        for (std::size_t i = 0; i < 2; ++i) {
          plot.begin[i] = std::max(std::min(plot.begin[i], lo[i]), square[i] * kSquare);
          plot.end[i] = std::min(std::max(plot.end[i], hi[i]), (square[i] + 1) * kSquare);
        }
      }
    }
  }
}

std::vector<Plot> plots_of(const std::vector<Face>& faces, const Atlas& atlas) {
  Bounds3d bounds;
  std::vector<std::vector<std::uint32_t>> charts;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    bounds.merge(bounds_of(faces[f].corners));
    if (charts.size() <= atlas.chart[f]) charts.resize(atlas.chart[f] + 1);
    charts[atlas.chart[f]].push_back(f);
  }
  std::vector<Plot> plots;
  for (const std::vector<std::uint32_t>& chart : charts) add_plots(chart, faces, bounds, plots);
  std::stable_sort(plots.begin(), plots.end(), [](const Plot& a, const Plot& b) { return a.place < b.place; });
  return plots;
}

void bake_into(const Canvas& to, const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks,
               const BakeParams& params) {
  const bool surfaces = to.normal != nullptr;
  const std::uint64_t needed = bytes_to_bake(mesh, atlas, surfaces);
  if (needed > params.memory.bytes)
    throw NeedsMemory(fmt::format("baking a texture of {} x {} texels", atlas.width, atlas.height), needed,
                      params.memory.bytes, params.memory.limit_with(needed - params.memory.bytes),
                      {Remedy::no_textures});
  std::vector<Face> faces = faces_of(mesh, atlas);
  if (surfaces) add_tangents(mesh, atlas, faces);
  const std::vector<Plot> plots = plots_of(faces, atlas);
  for (TextureImage* const image : {to.color, to.normal, to.roughness, to.emission}) {
    if (image != nullptr) *image = TextureImage(atlas.width, atlas.height, {0, 0, 0, 255});
  }
  std::vector<BakedTexel> known(to.color->texels.size());
  const double texel = atlas.texel * mesh.frame.voxel / kLatticePerVoxel;
  parallel_for(std::int64_t(plots.size()), [&](std::int64_t i) {
    const Plot& plot = plots[std::size_t(i)];
    PlotBaker baker(looks, params, texel, plot, surfaces);
    for (const std::uint32_t f : plot.faces) baker.add(faces[f]);
    baker.write(to, known);
  });
  for (TextureImage* const image : {to.color, to.normal, to.roughness, to.emission}) {
    if (image != nullptr) fill_gaps(*image, known);
  }
  fill_alpha(*to.color, known);
}

}  // namespace

std::uint64_t bytes_to_bake(const LatticeMesh& mesh, const Atlas& atlas, bool surfaces) {
  const std::uint64_t texels = std::uint64_t(atlas.width) * std::uint64_t(atlas.height);
  return texels * (surfaces ? kBytesPerSurfaceTexel : kBytesPerTexel) + mesh.triangles.size() * kBytesPerFace;
}

TextureImage bake(const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks, const BakeParams& params) {
  TextureImage image;
  bake_into({&image}, mesh, atlas, looks, params);
  return image;
}

BakedSurface bake_surface(const LatticeMesh& mesh, const Atlas& atlas, const SceneLooks& looks,
                          const BakeParams& params) {
  BakedSurface baked;
  bake_into({&baked.color, &baked.normal, &baked.roughness, &baked.emission}, mesh, atlas, looks, params);
  return baked;
}

bool says_nothing(const TextureImage& normals) {
  constexpr int kLean = 18;  // of 255
  constexpr std::size_t kOneIn = 100;
  constexpr int kDetail = 8;  // texels along a side: two pixels where the level's error is one pixel
  const auto leans = [](const TextureImage::Texel& t) {
    const int x = 2 * int(t[0]) - 255, y = 2 * int(t[1]) - 255;
    return x * x + y * y > kLean * kLean;
  };
  std::size_t all = 0;
  std::vector<int> columns(std::size_t(normals.width));  // number of leaning texels in the last rows, by column
  for (int y = 0; y < normals.height; ++y) {
    int square = 0;  // the same in the last columns
    for (int x = 0; x < normals.width; ++x) {
      const bool here = leans(normals.at(x, y));
      columns[std::size_t(x)] += int(here) - int(y >= kDetail && leans(normals.at(x, y - kDetail)));
      square += columns[std::size_t(x)] - (x >= kDetail ? columns[std::size_t(x - kDetail)] : 0);
      if (2 * square > kDetail * kDetail) return false;
      all += here ? 1 : 0;
    }
  }
  return all * kOneIn <= normals.texels.size();
}

}  // namespace bp
