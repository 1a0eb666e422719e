#include "lib/mesh/shaded_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "lib/core/disjoint_sets.h"
#include "lib/core/vec3.h"
#include "lib/mesh/inner_edges.h"

namespace bp {

namespace {

constexpr double kPi = 3.14159265358979323846;

using Corner = std::uint32_t;  // 3 * triangle + place in it

Vec3d direction(LatticeCoord from, LatticeCoord to) {
  const LatticeCoord d = to - from;
  return {double(d.x), double(d.y), double(d.z)};
}

class Shader {
 public:
  explicit Shader(const LatticeMesh& mesh) : mesh_(mesh), groups_(3 * mesh.triangles.size()) {
    faces_.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles)
      faces_.push_back(cross(direction(mesh.vertices[t[0]], mesh.vertices[t[1]]),
                             direction(mesh.vertices[t[0]], mesh.vertices[t[2]])));
  }

  ShadedMesh run() {
    for_each_inner_edge(mesh_.triangles, [this](Corner a, Corner b) { join_across(a, b); });
    number_groups();
    set_normals();
    return std::move(out_);
  }

 private:
  static Corner next(Corner c) { return c % 3 == 2 ? c - 2 : c + 1; }
  [[nodiscard]] std::uint32_t vertex_of(Corner c) const { return mesh_.triangles[c / 3][c % 3]; }

  void join_across(Corner a, Corner b) {
    static const double least = std::cos(kCreaseDegrees * kPi / 180);
    if (vertex_of(a) != vertex_of(next(b))) return;  // the faces are turned against each other
    const Vec3d &m = faces_[a / 3], &n = faces_[b / 3];
    if (!(dot(m, n) >= least * length(m) * length(n))) return;
    groups_.unite(a, next(b));
    groups_.unite(next(a), b);
  }

  /// Returns what makes a corner a separate copy: its group, chart and colour.
  [[nodiscard]] std::array<std::uint64_t, 2> kind_of(Corner c) {
    const std::uint64_t chart = mesh_.texture ? mesh_.texture->chart[c / 3] : 0;
    const LinearColor color = mesh_.colors.empty() ? kWhite : mesh_.colors[c / 3][c % 3];
    return {chart << 32 | groups_.find(c),
            std::uint64_t(color.r) << 32 | std::uint64_t(color.g) << 16 | std::uint64_t(color.b)};
  }

  void number_groups() {
    const auto hash = [](const std::array<std::uint64_t, 2>& k) {
      return std::size_t(k[0] * 0x9E3779B97F4A7C15 ^ k[1] * 0xC2B2AE3D27D4EB4F);
    };
    std::unordered_map<std::array<std::uint64_t, 2>, std::uint32_t, decltype(hash)> number(16, hash);
    out_.triangles.resize(faces_.size());
    for (Corner c = 0; c < 3 * faces_.size(); ++c) {
      const auto [copy, is_new] = number.try_emplace(kind_of(c), std::uint32_t(out_.vertex.size()));
      out_.triangles[c / 3][c % 3] = copy->second;
      if (!is_new) continue;
      out_.vertex.push_back(vertex_of(c));
      group_of_copy_.push_back(groups_.find(c));
      if (mesh_.texture) out_.uv.push_back(mesh_.texture->uv[c / 3][c % 3]);
      if (!mesh_.colors.empty()) out_.colors.push_back(mesh_.colors[c / 3][c % 3]);
    }
  }

  void set_normals() {
    std::vector<Vec3d> sums(3 * faces_.size(), Vec3d{});  // by the first corner of a group
    for (Corner c = 0; c < 3 * faces_.size(); ++c) {
      const LatticeCoord at = mesh_.vertices[vertex_of(c)];
      const Vec3d u = direction(at, mesh_.vertices[vertex_of(next(c))]),
                  v = direction(at, mesh_.vertices[vertex_of(next(next(c)))]);
      const double area = length(faces_[c / 3]);
      if (!(area > 0)) continue;
      const double weight = std::atan2(area, dot(u, v)) / area;
      for (std::size_t i = 0; i < 3; ++i) sums[groups_.find(c)][i] += weight * faces_[c / 3][i];
    }
    for (const Corner group : group_of_copy_) {
      const Vec3d& s = sums[group];
      const double l = length(s);
      out_.normals.push_back(l > 0 ? std::array<float, 3>{float(s[0] / l), float(s[1] / l), float(s[2] / l)}
                                   : std::array<float, 3>{0, 0, 1});
    }
  }

  const LatticeMesh& mesh_;
  std::vector<Vec3d> faces_;  // normals, as long as twice the area
  std::vector<Corner> group_of_copy_;
  DisjointSets groups_;  ///< corners of one vertex that share a normal
  ShadedMesh out_;
};

}  // namespace

ShadedMesh shaded(const LatticeMesh& mesh) {
  return Shader(mesh).run();
}

}  // namespace bp
