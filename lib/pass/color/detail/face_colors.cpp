#include "lib/pass/color/detail/face_colors.h"

#include <cmath>

#include "lib/core/parallel.h"
#include "lib/mesh/inner_edges.h"
#include "lib/voxel/color_samples.h"

namespace bp {

namespace {

constexpr double kSpacing = kColorCellVox * kLatticePerVoxel / 2;  // lattice units; the scene was sampled as densely
constexpr int kLeastRows = 2;
constexpr double kMostSamples = 1 << 14;  // of a face, about: they are in memory together
constexpr int kFitRounds = 3;
constexpr std::size_t kColorsTried = 16;
// Shares of a face: from here on it may be a pattern; it is no outlier.
constexpr double kPatternFar = 0.25, kMostFar = 0.5;
constexpr double kOneSide = 0.3;                 // largest share of a pattern's variance that a slope may explain
constexpr double kNear = 0.05 * 65535;           // distance of a colour from the fit at which it counts half
constexpr double kLittle = kNear * kNear / 100;  // variance: below it all colours are near
/// Two colours differ if they do so by such a share of the visible range, and by so many standard deviations within the
/// faces.
constexpr double kLeastStep = 0.1, kLeastDeviations = 1;

Rgb rgb_of(LinearColor c) {
  return {double(c.r), double(c.g), double(c.b)};
}

TriangleD corners_of(const LatticeMesh& mesh, std::size_t f) {
  TriangleD t;
  for (std::size_t k = 0; k < 3; ++k) {
    const LatticeCoord v = mesh.vertices[mesh.triangles[f][k]];
    t[k] = {double(v.x), double(v.y), double(v.z)};
  }
  return t;
}

/// A sample of a face: the weights of the corners, the area that it stands for, and the colour.
struct Sample {
  std::array<double, 3> w;
  double area;
  Rgb color;
};

/// area_of(sample): the area that it counts for.
template <class Area>
FaceColors sum_of(const std::vector<Sample>& samples, const Area& area_of) {
  FaceColors face;
  for (const Sample& s : samples) {
    const double area = area_of(s);
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = area * s.w[k];
      face.products[k] += weight * s.w[k];
      face.products[3 + k] += weight * s.w[(k + 1) % 3];
      face.mass[k] += weight;
      for (std::size_t i = 0; i < 3; ++i) face.sums[k][i] += weight * s.color[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      face.squares[i] += area * s.color[i] * s.color[i];
      face.low[i] = std::min(face.low[i], s.color[i]);
      face.high[i] = std::max(face.high[i], s.color[i]);
    }
  }
  return face;
}

/// The linear function that is nearest to a face's colours, without regard to its neighbours.
struct FaceFit {
  std::array<Rgb, 3> corners;  // by channel
  double variance = 0;         // of the colours around it, summed over the channels
};

FaceFit fit_of(const FaceColors& face) {
  const auto& m = face.products;
  const double area = face.area();
  std::array<Vec3d, 3> rows{Vec3d{m[0], m[3], m[5]}, {m[3], m[1], m[4]}, {m[5], m[4], m[2]}}, held = rows;
  for (std::size_t k = 0; k < 3; ++k) held[k][k] += kTowardsMean * face.mass[k];
  const std::array<Vec3d, 3> inverse{cross(held[1], held[2]), cross(held[2], held[0]), cross(held[0], held[1])};
  const double determinant = dot(held[0], inverse[0]);
  FaceFit fit;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d sums{face.sums[0][i], face.sums[1][i], face.sums[2][i]};
    const double mean = (sums[0] + sums[1] + sums[2]) / area;
    Vec3d x{};
    for (std::size_t k = 0; k < 3; ++k)
      x = x + (sums[k] + kTowardsMean * face.mass[k] * mean) / determinant * inverse[k];
    for (double& c : x) c = std::clamp(c, face.low[i], face.high[i]);
    fit.corners[i] = x;
    const Vec3d product{dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)};
    fit.variance += std::max(0.0, face.squares[i] - 2 * dot(sums, x) + dot(product, x)) / area;
  }
  return fit;
}

double squared_distance(const Sample& sample, const FaceFit& fit) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double here = 0;
    for (std::size_t k = 0; k < 3; ++k) here += sample.w[k] * fit.corners[i][k];
    sum += (sample.color[i] - here) * (sample.color[i] - here);
  }
  return sum;
}

/// Returns the area that a sample counts for: less if it is far from the fit.
double near_area(const Sample& sample, const FaceFit& fit) {
  return sample.area / (1 + squared_distance(sample, fit) / (kNear * kNear));
}

double near_area(const std::vector<Sample>& samples, const FaceFit& fit) {
  double sum = 0;
  for (const Sample& s : samples) sum += near_area(s, fit);
  return sum;
}

/// Returns a fit with one colour everywhere: the colour that most of the face is near to, of those tried.
FaceFit most_frequent(const std::vector<Sample>& samples) {
  FaceFit best;
  double most = -1;
  const std::size_t step = samples.size() / kColorsTried + 1;
  for (std::size_t n = step / 2; n < samples.size(); n += step) {
    FaceFit tried;
    for (std::size_t i = 0; i < 3; ++i) tried.corners[i].fill(samples[n].color[i]);
    const double near = near_area(samples, tried);
    if (near <= most) continue;
    most = near;
    best = tried;
  }
  return best;
}

struct Refined {
  FaceColors face;  // its area is that of all samples
  FaceFit fit;
};

/// Refines a fit in rounds. Samples far from the fit of the round before count less.
Refined refined(const std::vector<Sample>& samples, const FaceFit& start, double area) {
  Refined r{{}, start};
  for (int round = 0; round < kFitRounds; ++round) {
    r.face = sum_of(samples, [&](const Sample& s) { return near_area(s, r.fit); });
    r.face.scale(area / r.face.area());
    r.fit = fit_of(r.face);
  }
  return r;
}

/// Returns true if the part far from the fit is half of the face, or a quarter that lies all over it, as stripes do.
/// The colour of another surface lies at one side. The measure is the share of the variance of "far: 1, near: 0" that a
/// linear function over the triangle explains. With the moments of a triangle it is 12 p / (1 - p) times the squared
/// distance from the centre to the far part, which is p of the area, in weights of the corners. It is above 0.5 for a
/// band along an edge, and at most 0.2 for stripes.
bool is_pattern(const std::vector<Sample>& samples, const FaceFit& fit, double area) {
  Vec3d far{};  // by corner
  for (const Sample& s : samples)
    if (squared_distance(s, fit) > kNear * kNear) far = far + s.area / area * Vec3d(s.w);
  const double p = far[0] + far[1] + far[2];
  if (p <= kPatternFar || p > kMostFar) return p > kMostFar;
  const Vec3d off = far - p / 3 * Vec3d{1, 1, 1};
  return 12 * dot(off, off) < kOneSide * p * (1 - p);
}

/// Returns the colours of a face. Samples far from a fit count less: a band of another colour, such as the foot of a
/// wall, would tint the whole face. A colour that fades over the face fits, and counts as a whole. There are two
/// starts: the nearest fit to all samples, which stays between two colours, and the most frequent colour. The one that
/// ends nearer to more of the face is taken. A face with a pattern counts as a whole: its mean is what is seen from
/// afar.
FaceColors sampled(const TriangleD& corners, const NearbyColors& colors) {
  const double area = area_of(corners);
  const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double spacing = std::max(kSpacing, std::sqrt(2 * area / kMostSamples));
  std::vector<Sample> samples;
  for_each_sample(corners, spacing, kLeastRows, [&](const std::array<double, 3>& w, double share) {
    samples.push_back({w, area * share, rgb_of(colors.at(point_of(corners, w), normal))});
  });
  const FaceColors plain = sum_of(samples, [](const Sample& s) { return s.area; });
  if (!(area > 0)) return plain;
  const FaceFit fit = fit_of(plain);
  if (fit.variance < kLittle) return plain;
  const Refined sloped = refined(samples, fit, plain.area());
  const Refined even = refined(samples, most_frequent(samples), plain.area());
  const Refined& best = near_area(samples, even.fit) > near_area(samples, sloped.fit) ? even : sloped;
  return is_pattern(samples, best.fit, plain.area()) ? plain : best.face;
}

/// Returns whether two faces' colours differ in the middle of the edge that begins at these places in them.
bool differ(const FaceFit& a, std::size_t in_a, const FaceFit& b, std::size_t in_b) {
  double difference = 0, step = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double p = (a.corners[i][in_a] + a.corners[i][(in_a + 1) % 3]) / 2,
                 q = (b.corners[i][in_b] + b.corners[i][(in_b + 1) % 3]) / 2;
    difference += (p - q) * (p - q);
    step = std::max(step, std::abs(std::sqrt(p / 65535) - std::sqrt(q / 65535)));  // about as sRGB does
  }
  return step > kLeastStep && difference > kLeastDeviations * kLeastDeviations * (a.variance + b.variance);
}

}  // namespace

std::vector<FaceColors> face_colors(const LatticeMesh& mesh, const NearbyColors& colors) {
  std::vector<FaceColors> faces(mesh.triangles.size());
  parallel_ranges(std::int64_t(faces.size()), kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (auto f = std::size_t(begin); f < std::size_t(end); ++f) faces[f] = sampled(corners_of(mesh, f), colors);
  });
  return faces;
}

DisjointSets color_groups(const LatticeMesh& mesh, const std::vector<FaceColors>& faces) {
  std::vector<FaceFit> fits(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f].area() > 0) fits[f] = fit_of(faces[f]);
  DisjointSets groups(3 * faces.size());
  const auto next = [](std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; };
  const auto vertex = [&](std::uint32_t c) { return mesh.triangles[c / 3][c % 3]; };
  for_each_inner_edge(mesh.triangles, [&](std::uint32_t c, std::uint32_t d) {
    if (!(faces[c / 3].area() > 0) || !(faces[d / 3].area() > 0)) return;
    if (differ(fits[c / 3], c % 3, fits[d / 3], d % 3)) return;
    const bool same_way = vertex(c) == vertex(d);
    groups.unite(c, same_way ? d : next(d));
    groups.unite(next(c), same_way ? next(d) : d);
  });
  return groups;
}

}  // namespace bp
