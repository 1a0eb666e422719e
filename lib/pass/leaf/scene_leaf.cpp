#include "lib/pass/leaf/scene_leaf.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>

#include "lib/core/vec3.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/bake/textured_triangle.h"
#include "lib/pass/leaf/detail/corner_normals.h"
#include "lib/pass/leaf/detail/cut_triangle.h"
#include "lib/pass/leaf/detail/growing_part.h"
#include "lib/tileset/tile_tree.h"

namespace bp {

namespace {

constexpr std::size_t kMostDeep = 12;  // octants within octants, at most
constexpr double kAround = 0.125;      // of a box's side: normals of faces within this distance are joined

Bounds3d grown(const Bounds3d& box) {
  Bounds3d out = box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double by = kAround * (box.max[i] - box.min[i]);
    out.min[i] -= by;
    out.max[i] += by;
  }
  return out;
}

/// Returns the triangles in an order that depends only on their content.
std::vector<TexturedTriangle> triangles_in(const SceneLooks& looks, const Bounds3d& box) {
  std::vector<TexturedTriangle> all;
  looks.visit(box, [&](const TexturedTriangle& t) { all.push_back(t); });
  const auto bits = [](const std::array<std::array<float, 2>, 3>& uv) {
    return std::bit_cast<std::array<std::array<std::uint32_t, 2>, 3>>(uv);
  };
  const auto key = [&](const TriangleTexture& t) { return looks.key_of(t.material); };
  std::sort(all.begin(), all.end(), [&](const TexturedTriangle& a, const TexturedTriangle& b) {
    const auto sorted_by = [&](const TexturedTriangle& t) {
      return std::tuple(t.corners, key(t.texture), t.colors, bits(t.texture.uv), t.texture.normals,
                        bits(t.texture.second_uv));
    };
    return sorted_by(a) < sorted_by(b);
  });
  return all;
}

class LeafCutter {
 public:
  LeafCutter(const SceneLooks& looks, const Bounds3d& box, double unit) : looks_(looks), box_(box) {
    leaf_.origin = middle_of(box);
    leaf_.unit = unit;
  }

  SceneLeaf run() {
    const Bounds3d around = grown(box_);
    const std::vector<TexturedTriangle> all = triangles_in(looks_, around);
    std::vector<TriangleD> corners;
    corners.reserve(all.size());
    for (const TexturedTriangle& t : all) corners.push_back(t.corners);
    const std::vector<std::array<Vec3d, 3>> normals = corner_normals(corners, around);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (overlap(bounds_of(all[i].corners), box_)) add(all[i], normals[i]);
    }
    for (auto& [key, growing] : parts_) {
      if (!growing.part.triangles.empty()) leaf_.parts.push_back(std::move(growing.part));
    }
    return std::move(leaf_);
  }

 private:
  void add(const TexturedTriangle& t, const std::array<Vec3d, 3>& normals) {
    const bool textured = t.texture.material != TriangleTexture::kNoMaterial;
    std::array<CutPoint, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool own = t.texture.normals[k] != 0;
      triangle[k] = {t.corners[k],
                     own ? unpack_normal(t.texture.normals[k]) : normals[k],
                     {},
                     {},
                     {double(t.colors[k].r), double(t.colors[k].g), double(t.colors[k].b)}};
      for (std::size_t i = 0; i < 2 && textured; ++i) {
        const auto finite = [](float x) { return std::isfinite(x) ? double(x) : 0; };
        triangle[k].uv[i] = finite(t.texture.uv[k][i]);
        triangle[k].second_uv[i] = finite(t.texture.second_uv[k][i]);
      }
    }
    const std::vector<CutPoint> polygon = cut_triangle(triangle, box_);
    if (polygon.empty()) return;
    GrowingPart& growing = parts_[looks_.key_of(t.texture.material)];
    growing.part.material = t.texture.material;
    std::vector<LeafVertex> corners;
    for (const CutPoint& p : polygon) corners.push_back(vertex_of(p));
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) add_face(growing, corners[0], corners[i], corners[i + 1]);
  }

  void add_face(GrowingPart& growing, const LeafVertex& a, const LeafVertex& b, const LeafVertex& c) {
    std::array<std::int64_t, 3> u{}, v{};
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = std::int64_t(b.at[i]) - a.at[i];
      v[i] = std::int64_t(c.at[i]) - a.at[i];
    }
    const bool flat = u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
    if (flat) return;
    growing.part.triangles.push_back({growing.number_of(a), growing.number_of(b), growing.number_of(c)});
    for (const LeafVertex* p : {&a, &b, &c}) add_to_bounds(*p);
  }

  /// Adds a vertex, which is relative to the leaf's origin. If the sum of both is rounded, the doubles around it are
  /// added.
  void add_to_bounds(const LeafVertex& v) {
    Vec3d low, high;
    for (std::size_t i = 0; i < 3; ++i) {
      const double origin = leaf_.origin[i], by = leaf_.unit * v.at[i], sum = origin + by, part = sum - origin;
      const bool exact = origin - (sum - part) == 0 && by - part == 0;
      low[i] = exact ? sum : std::nextafter(sum, -HUGE_VAL);
      high[i] = exact ? sum : std::nextafter(sum, HUGE_VAL);
    }
    leaf_.bounds.add(low);
    leaf_.bounds.add(high);
  }

  [[nodiscard]] LeafVertex vertex_of(const CutPoint& p) const {
    LeafVertex v;
    const double l = length(p.normal);
    for (std::size_t i = 0; i < 3; ++i) {
      v.at[i] = std::int32_t(std::nearbyint(p.at[i] / leaf_.unit) - std::nearbyint(leaf_.origin[i] / leaf_.unit));
      v.normal[i] = float(l > 0 ? p.normal[i] / l : double(i == 2));
    }
    v.uv = {float(p.uv[0]), float(p.uv[1])};
    v.second_uv = {float(p.second_uv[0]), float(p.second_uv[1])};
    const auto rounded = [](double c) { return std::uint16_t(std::clamp(c, 0.0, 65535.0) + 0.5); };
    v.color = {rounded(p.color[0]), rounded(p.color[1]), rounded(p.color[2])};
    return v;
  }

  const SceneLooks& looks_;
  const Bounds3d box_;
  SceneLeaf leaf_;
  std::map<ResultKey, GrowingPart> parts_;  // by everything that decides how the part looks
};

LeafBox counted(const SceneLooks& looks, const Bounds3d& box, std::string path) {
  LeafBox out{box, std::move(path)};
  looks.visit(box, [&](const TexturedTriangle&) { ++out.triangles; });
  return out;
}

/// Divides a box into octants if that helps: if few triangles reach into several of them.
void divide(const SceneLooks& looks, std::uint64_t most, LeafTree& at) {
  if (at.box.triangles <= most || at.box.path.size() >= kMostDeep) return;
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    LeafBox octant = counted(looks, octant_of(at.box.box, int(k)), at.box.path + char('0' + k));
    sum += octant.triangles;
    if (octant.triangles > 0) at.octants.push_back({std::move(octant), {}});
  }
  if (sum > 2 * at.box.triangles) return at.octants.clear();
  for (LeafTree& octant : at.octants) divide(looks, most, octant);
}

void collect(const LeafTree& at, std::vector<LeafBox>& out) {
  if (at.octants.empty() && at.box.triangles > 0) out.push_back(at.box);
  for (const LeafTree& octant : at.octants) collect(octant, out);
}

}  // namespace

std::uint64_t SceneLeaf::triangles() const {
  std::uint64_t n = 0;
  for (const LeafPart& part : parts) n += part.triangles.size();
  return n;
}

std::vector<TriangleD> world_triangles(const SceneLeaf& leaf) {
  std::vector<TriangleD> all;
  all.reserve(leaf.triangles());
  for (const LeafPart& part : leaf.parts) {
    const auto at = [&](std::uint32_t v) {
      Vec3d p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = leaf.origin[i] + leaf.unit * part.vertices[v].at[i];
      return p;
    };
    for (const auto& t : part.triangles) all.push_back({at(t[0]), at(t[1]), at(t[2])});
  }
  return all;
}

std::vector<LeafBox> leaf_boxes(const SceneLooks& looks, const Bounds3d& cell) {
  std::vector<LeafBox> boxes;
  collect(leaf_tree(looks, cell, kMostLeafTriangles), boxes);
  return boxes;
}

LeafTree leaf_tree(const SceneLooks& looks, const Bounds3d& cell, std::uint64_t most) {
  LeafTree root{counted(looks, cell, ""), {}};
  divide(looks, most, root);
  return root;
}

double leaf_unit(double voxel, std::int32_t edge_vox) {
  constexpr int kFloatBits = 24;
  const auto half = std::uint32_t(edge_vox + 1) / 2;
  return std::ldexp(voxel, int(std::bit_width(half - 1)) - kFloatBits);
}

double leaf_error(double unit) {
  return unit * 0.87;  // half a diagonal, and the rounding of doubles
}

void add_leaf_to(KeyHash& hash, const SceneLooks& looks, const Bounds3d& box) {
  hash.add(box);
  looks.add_triangles_to(hash, grown(box));
}

SceneLeaf cut_leaf(const SceneLooks& looks, const Bounds3d& box, double unit) {
  return LeafCutter(looks, box, unit).run();
}

}  // namespace bp
