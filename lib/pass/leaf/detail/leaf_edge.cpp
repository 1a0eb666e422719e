#include "lib/pass/leaf/detail/leaf_edge.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

using Index = LeafMesh::Index;
using Change = LeafMesh::Change;

/// A face turns by less than 78 degrees in one collapse.
constexpr double kLeastCosine = 0.2;

LeafMesh::Look between(const LeafMesh::Look& a, const LeafMesh::Look& b, double t) {
  if (t == 0 || t == 1) return t == 0 ? a : b;  // points that stay keep their looks to the last bit
  const auto mix = [t](double x, double y) { return x + t * (y - x); };
  LeafMesh::Look out = a;
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    out.normal[i] = float(mix(a.normal[i], b.normal[i]));
    length += double(out.normal[i]) * out.normal[i];
  }
  for (float& x : out.normal)
    x = length > 1e-6 ? float(x / std::sqrt(length)) : a.normal[std::size_t(&x - &out.normal[0])];
  for (std::size_t i = 0; i < 2; ++i) {
    out.uv[i] = float(mix(a.uv[i], b.uv[i]));
    out.second_uv[i] = float(mix(a.second_uv[i], b.second_uv[i]));
  }
  const auto mixed = [&](std::uint16_t x, std::uint16_t y) { return std::uint16_t(mix(x, y) + 0.5); };
  out.color = {mixed(a.color.r, b.color.r), mixed(a.color.g, b.color.g), mixed(a.color.b, b.color.b)};
  return out;
}

/// Twice the area of a triangle of texture coordinates, with its sign.
double turn_of(const std::array<float, 2>& a, const std::array<float, 2>& b, const std::array<float, 2>& c) {
  return (double(b[0]) - a[0]) * (double(c[1]) - a[1]) - (double(c[0]) - a[0]) * (double(b[1]) - a[1]);
}

/// Returns whether an edge from a point is a border. `neighbours`: of the point, in order.
bool is_border(const std::vector<Index>& neighbours) {
  for (auto at = neighbours.begin(); at != neighbours.end();) {
    const auto next = std::upper_bound(at, neighbours.end(), *at);
    if (next - at == 1) return true;
    at = next;
  }
  return false;
}

/// Returns whether the face would turn over if its point `end` moves.
bool turns(const LeafMesh& mesh, const SceneLeaf& whole, Index f, Index end, const Vec3d& to,
           const std::vector<Change>& changes) {
  const std::size_t k = mesh.place_in(f, end);
  const Index a = mesh.face(f)[k], b = mesh.face(f)[(k + 1) % 3], c = mesh.face(f)[(k + 2) % 3];
  const Vec3d& pb = mesh.at(mesh.corner(b).point);
  const Vec3d& pc = mesh.at(mesh.corner(c).point);
  const Vec3d before = cross(pb - mesh.at(end), pc - mesh.at(end)), after = cross(pb - to, pc - to);
  const double both = length(before) * length(after);
  if (!(length(after) > 1) || dot(before, after) < kLeastCosine * both) return true;
  if (whole.parts[mesh.corner(a).look.part].material == TriangleTexture::kNoMaterial) return false;
  const auto found = std::find_if(changes.begin(), changes.end(), [&](const Change& x) { return x.corner == a; });
  const auto &uv_b = mesh.corner(b).look.uv, &uv_c = mesh.corner(c).look.uv;
  const double turn = turn_of(mesh.corner(a).look.uv, uv_b, uv_c), turned = turn_of(found->look.uv, uv_b, uv_c);
  return turn * turned < 0;
}

}  // namespace

std::vector<Index> thirds_of(const LeafMesh& mesh, Index u, Index v) {
  std::vector<Index> thirds;
  for (const Index f : mesh.faces_of(u)) {
    const std::size_t at_u = mesh.place_in(f, u), at_v = mesh.place_in(f, v);
    if (at_v < 3) thirds.push_back(mesh.point_of(f, 3 - at_u - at_v));
  }
  std::sort(thirds.begin(), thirds.end());
  thirds.erase(std::unique(thirds.begin(), thirds.end()), thirds.end());
  return thirds;
}

bool keeps_parts(const LeafMesh& mesh, Index u, Index v) {
  const std::vector<Index> of_u = mesh.neighbours(u), of_v = mesh.neighbours(v), thirds = thirds_of(mesh, u, v);
  if (is_border(of_u) && is_border(of_v) && std::count(of_u.begin(), of_u.end(), v) > 1) return false;
  for (std::size_t i = 0; i < of_u.size(); ++i) {
    const Index w = of_u[i];
    if (w == v || (i > 0 && w == of_u[i - 1]) || !std::binary_search(of_v.begin(), of_v.end(), w)) continue;
    if (!std::binary_search(thirds.begin(), thirds.end(), w) && thirds_of(mesh, u, w) != thirds_of(mesh, v, w))
      return false;
  }
  return true;
}

EdgeCorners corners_of_edge(const LeafMesh& mesh, Index u, Index v) {
  EdgeCorners out;
  for (const Index f : mesh.faces_of(u)) {
    const std::size_t at_v = mesh.place_in(f, v);
    if (at_v == 3) continue;
    const std::pair<Index, Index> pair{mesh.face(f)[mesh.place_in(f, u)], mesh.face(f)[at_v]};
    const bool is_known = std::any_of(out.pairs.begin(), out.pairs.end(),
                                      [&](const auto& p) { return p.first == pair.first || p.second == pair.second; });
    if (!is_known) out.pairs.push_back(pair);
  }
  for (const bool first : {true, false}) {
    for (const Index c : mesh.corners_of(first ? u : v)) {
      const auto own = [&](const auto& p) { return first ? p.first : p.second; };
      if (std::any_of(out.pairs.begin(), out.pairs.end(), [&](const auto& p) { return own(p) == c; })) continue;
      (first ? out.others_u : out.others_v).push_back(c);
      const bool joins = std::any_of(out.pairs.begin(), out.pairs.end(), [&](const auto& p) {
        return mesh.corner(own(p)).look.joins(mesh.corner(c).look);
      });
      if (!joins) (first ? out.holds_u : out.holds_v) = true;
    }
  }
  return out;
}

std::vector<Change> changes_of(const LeafMesh& mesh, const EdgeCorners& corners, double share) {
  std::vector<Change> changes;
  for (const auto& [u, v] : corners.pairs) {
    const LeafMesh::Look look = between(mesh.corner(u).look, mesh.corner(v).look, share);
    changes.push_back({u, u, look});
    changes.push_back({v, u, look});
  }
  for (const bool first : {true, false}) {
    for (const Index c : first ? corners.others_u : corners.others_v) {
      LeafMesh::Look look = mesh.corner(c).look;
      for (const auto& [u, v] : corners.pairs) {  // it keeps its normal alone where it joins a corner that moves
        if (!mesh.corner(first ? u : v).look.joins(look)) continue;
        const LeafMesh::Look moved = between(mesh.corner(u).look, mesh.corner(v).look, share);
        look.uv = moved.uv;
        look.second_uv = moved.second_uv;
        look.color = moved.color;
        break;
      }
      changes.push_back({c, c, look});
    }
  }
  return changes;
}

bool turns_faces(const LeafMesh& mesh, const SceneLeaf& whole, Index u, Index v, const Vec3d& to,
                 const std::vector<Change>& changes) {
  for (const Index end : {u, v}) {
    for (const Index f : mesh.faces_of(end)) {
      if (mesh.place_in(f, end == u ? v : u) != 3) continue;
      if (turns(mesh, whole, f, end, to, changes)) return true;
    }
  }
  return false;
}

}  // namespace bp
