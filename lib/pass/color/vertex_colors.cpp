#include "lib/pass/color/vertex_colors.h"

#include <algorithm>
#include <array>

#include "lib/pass/color/detail/face_colors.h"

// Source: [KBS11] Kavan, Bargteil and Sloan, Least squares vertex baking, 2011. It minimises the squared difference
// between the colours that are interpolated over the faces and those that were sampled there. We differ in three ways.
// The regularization pulls weakly towards each vertex's own weighted mean, not towards smoothness across edges; it also
// decides where samples are too few. Samples far from a face's fit are outliers and count little (face_colors.cpp),
// because a least squares fit of a step is a slope over the whole face. A vertex has a colour for each group of faces
// whose colours go on from one to the next. So the diagonal bounds the matrix, whatever the mesh is, and ten rounds of
// conjugate gradients are far below a step of 8 bits.

namespace bp {

namespace {

constexpr int kRounds = 10;

class Baker {
 public:
  Baker(LatticeMesh& mesh, const NearbyColors& colors)
      : mesh_(mesh), colors_(colors), faces_(face_colors(mesh, colors)), group_(faces_.size()) {
    number_groups();
  }

  void bake() {
    for (std::size_t f = 0; f < faces_.size(); ++f) add_face(f);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      Group& group = groups_[g];
      group.right = group.mean;
      for (std::size_t i = 0; i < 3; ++i) {
        group.mean[i] = group.mass > 0 ? group.mean[i] / group.mass : group.low[i];
        group.right[i] += kTowardsMean * group.mass * group.mean[i];
      }
      group.diagonal += kTowardsMean * group.mass;
    }
    mesh_.colors.assign(faces_.size(), {});
    for (std::size_t i = 0; i < 3; ++i) solve(i);
  }

 private:
  /// A set of corners of faces that get one common colour, as sums over these corners.
  struct Group {
    double mass = 0, diagonal = 0;
    Rgb mean{}, right{}, low{65535, 65535, 65535}, high{};
  };

  void number_groups() {
    DisjointSets sets = color_groups(mesh_, faces_);
    std::vector<std::uint32_t> number(sets.size());
    for (std::uint32_t c = 0; c < sets.size(); ++c) {
      const std::uint32_t root = sets.find(c);
      if (root == c) {
        number[c] = std::uint32_t(groups_.size());
        groups_.emplace_back();
      }
      group_[c / 3][c % 3] = number[root];
    }
  }

  void add_face(std::size_t f) {
    const FaceColors& face = faces_[f];
    for (std::size_t k = 0; k < 3; ++k) {
      Group& group = groups_[group_[f][k]];
      group.mass += face.mass[k];
      group.diagonal += face.products[k];
      const LatticeCoord v = mesh_.vertices[mesh_.triangles[f][k]];
      const bool has_area = face.area() > 0;
      const LinearColor here = has_area ? LinearColor{} : colors_.at({double(v.x), double(v.y), double(v.z)}, {});
      const Rgb own{double(here.r), double(here.g), double(here.b)};
      for (std::size_t i = 0; i < 3; ++i) {
        group.mean[i] += face.sums[k][i];
        group.low[i] = std::min(group.low[i], has_area ? face.low[i] : own[i]);
        group.high[i] = std::max(group.high[i], has_area ? face.high[i] : own[i]);
      }
    }
  }

  void multiply(const std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) y[g] = kTowardsMean * groups_[g].mass * x[g];
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto& t = group_[f];
      const auto& m = faces_[f].products;
      y[t[0]] += m[0] * x[t[0]] + m[3] * x[t[1]] + m[5] * x[t[2]];
      y[t[1]] += m[1] * x[t[1]] + m[3] * x[t[0]] + m[4] * x[t[2]];
      y[t[2]] += m[2] * x[t[2]] + m[4] * x[t[1]] + m[5] * x[t[0]];
    }
  }

  /// Runs conjugate gradients from the means on, with each equation divided by its diagonal.
  void solve(std::size_t channel) {
    const std::size_t n = groups_.size();
    std::vector<double> x(n), r(n), p(n), q(n);
    for (std::size_t g = 0; g < n; ++g) x[g] = groups_[g].mean[channel];
    multiply(x, q);
    for (std::size_t g = 0; g < n; ++g) r[g] = groups_[g].right[channel] - q[g];
    const auto preconditioned = [&](std::size_t g) { return groups_[g].diagonal > 0 ? r[g] / groups_[g].diagonal : 0; };
    double before = 0;
    for (int round = 0; round < kRounds; ++round) {
      double now = 0, along = 0;
      for (std::size_t g = 0; g < n; ++g) now += r[g] * preconditioned(g);
      if (!(now > 0)) break;
      for (std::size_t g = 0; g < n; ++g) p[g] = preconditioned(g) + (round > 0 ? now / before * p[g] : 0);
      multiply(p, q);
      for (std::size_t g = 0; g < n; ++g) along += p[g] * q[g];
      if (!(along > 0)) break;
      for (std::size_t g = 0; g < n; ++g) {
        x[g] += now / along * p[g];
        r[g] -= now / along * q[g];
      }
      before = now;
    }
    write(channel, x);
  }

  void write(std::size_t channel, const std::vector<double>& x) {
    constexpr std::array of{&LinearColor::r, &LinearColor::g, &LinearColor::b};
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Group& group = groups_[group_[f][k]];
        const double c = std::clamp(x[group_[f][k]], group.low[channel], group.high[channel]);
        mesh_.colors[f][k].*of[channel] = std::uint16_t(c + 0.5);
      }
    }
  }

  LatticeMesh& mesh_;
  const NearbyColors& colors_;
  const std::vector<FaceColors> faces_;
  std::vector<std::array<std::uint32_t, 3>> group_;  // by face: groups of its corners
  std::vector<Group> groups_;
};

}  // namespace

void color_vertices(LatticeMesh& mesh, const NearbyColors& colors) {
  Baker(mesh, colors).bake();
}

}  // namespace bp
