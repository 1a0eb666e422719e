#include "lib/check/detail/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/core/disjoint_sets.h"
#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"

namespace bp {

namespace {

using Index = std::uint32_t;

/// Returns, for each vertex of the input, the number of its position among the distinct ones, in the order of first
/// appearance; -0 equals 0.
std::vector<Index> merge_positions(const IndexedMesh& mesh, WeldedMesh& welded, CheckReport& report) {
  std::vector<Index> order;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (is_finite(mesh.vertices[i])) order.push_back(Index(i));
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Vec3d &p = mesh.vertices[a], &q = mesh.vertices[b];
    return p < q || (!(q < p) && a < b);
  });
  std::vector<Index> first(mesh.vertices.size());  // per vertex: the lowest vertex at the same position
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (mesh.vertices[order[i]] == mesh.vertices[order[i - 1]]) first[order[i]] = first[order[i - 1]];
  std::vector<Index> point(mesh.vertices.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      point[i] = Index(welded.points.size());
      welded.points.push_back(mesh.vertices[i]);
      welded.vertex.push_back(i);
    } else {
      point[i] = point[first[i]];
      ++report.merged_vertices;
    }
  }
  return point;
}

struct EdgeUse {
  Index to;        // the higher end of an edge; the lower end names the bucket
  Index triangle;  // number of the triangle
  int direction;   // +1 from the lower to the higher end
};

/// A table of all edges, sorted by lower end, then higher end, then triangle.
struct EdgeTable {
  std::vector<std::size_t> begin;  // per vertex
  std::vector<EdgeUse> uses;
};

bool has_repeated_corner(const std::array<Index, 3>& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

template <class F>
void for_each_edge(const WeldedMesh& mesh, F&& f) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    // A triangle with a repeated corner is an edge there and back: whether the rest is closed does not depend on it.
    if (has_repeated_corner(c)) continue;
    for (std::size_t e = 0; e < 3; ++e) f(Index(t), c[e], c[(e + 1) % 3]);
  }
}

EdgeTable collect_edges(const WeldedMesh& mesh) {
  EdgeTable table;
  table.begin.assign(mesh.points.size() + 1, 0);
  for_each_edge(mesh, [&](Index, Index a, Index b) { ++table.begin[std::min(a, b) + 1]; });
  std::partial_sum(table.begin.begin(), table.begin.end(), table.begin.begin());
  table.uses.resize(table.begin.back());
  std::vector<std::size_t> next(table.begin.begin(), table.begin.end() - 1);
  for_each_edge(mesh, [&](Index t, Index a, Index b) {
    table.uses[next[std::min(a, b)]++] = {std::max(a, b), t, a < b ? 1 : -1};
  });
  for (std::size_t v = 0; v + 1 < table.begin.size(); ++v)
    std::sort(table.uses.begin() + std::ptrdiff_t(table.begin[v]),
              table.uses.begin() + std::ptrdiff_t(table.begin[v + 1]), [](const EdgeUse& a, const EdgeUse& b) {
                if (a.to != b.to) return a.to < b.to;
                return a.triangle != b.triangle ? a.triangle < b.triangle : a.direction < b.direction;
              });
  return table;
}

/// Returns the midpoint without overflow.
Vec3d middle(const Vec3d& a, const Vec3d& b) {
  return {a[0] / 2 + b[0] / 2, a[1] / 2 + b[1] / 2, a[2] / 2 + b[2] / 2};
}

/// Judges each edge, unites the triangles around it, returns the number of edges.
std::uint64_t check_edges(const WeldedMesh& mesh, const EdgeTable& table, std::size_t max_examples, DisjointSets& sets,
                          CheckReport& report) {
  std::uint64_t edges = 0;
  for (Index v = 0; v < mesh.points.size(); ++v) {
    for (std::size_t i = table.begin[v]; i < table.begin[v + 1]; ++edges) {
      std::size_t end = i;
      int balance = 0;
      for (; end < table.begin[v + 1] && table.uses[end].to == table.uses[i].to; ++end) {
        balance += table.uses[end].direction;
        sets.unite(table.uses[end].triangle, table.uses[i].triangle);
      }
      const Index to = table.uses[i].to;
      const Example here{mesh.vertex[v], mesh.vertex[to], middle(mesh.points[v], mesh.points[to])};
      if (end - i == 1) report.boundary_edges.add(here, max_examples);
      if (end - i > 1 && balance != 0) report.misoriented_edges.add(here, max_examples);
      if (end - i > 2) report.nonmanifold_edges.add(here, max_examples);
      i = end;
    }
  }
  return edges;
}

/// Corners grouped by vertex: for each, the two other corners of its triangle, and the triangle.
struct CornerTable {
  std::vector<std::size_t> begin;
  std::vector<std::array<Index, 2>> others;
  std::vector<Index> triangle;
};

CornerTable collect_corners(const WeldedMesh& mesh) {
  CornerTable table;
  table.begin.assign(mesh.points.size() + 1, 0);
  for_each_edge(mesh, [&](Index, Index a, Index) { ++table.begin[a + 1]; });
  std::partial_sum(table.begin.begin(), table.begin.end(), table.begin.begin());
  table.others.resize(table.begin.back());
  table.triangle.resize(table.begin.back());
  std::vector<std::size_t> next(table.begin.begin(), table.begin.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    if (has_repeated_corner(c)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = next[c[k]]++;
      table.others[at] = {c[(k + 1) % 3], c[(k + 2) % 3]};
      table.triangle[at] = Index(t);
    }
  }
  return table;
}

/// Returns the components of the groups of triangles around a vertex that are connected by edges at it, sorted.
std::vector<Index> fans_at(const WeldedMesh& mesh, const CornerTable& table, std::size_t vertex,
                           std::vector<std::array<Index, 2>>& ends) {
  const std::size_t begin = table.begin[vertex], n = table.begin[vertex + 1] - begin;
  ends.clear();  // (other end of an edge, corner)
  for (std::size_t i = 0; i < n; ++i)
    for (const Index other : table.others[begin + i]) ends.push_back({other, Index(i)});
  std::sort(ends.begin(), ends.end());
  DisjointSets sets(n);
  for (std::size_t i = 1; i < ends.size(); ++i)
    if (ends[i][0] == ends[i - 1][0]) sets.unite(ends[i][1], ends[i - 1][1]);
  std::vector<Index> fans;
  for (std::size_t i = 0; i < n; ++i)
    if (sets.find(Index(i)) == i) fans.push_back(mesh.component[table.triangle[begin + i]]);
  std::sort(fans.begin(), fans.end());
  return fans;
}

/// Checks that the triangles around each vertex form one fan. Convex parts may touch at a vertex, since they may
/// overlap: there each part has its own fan. Returns the number of fans that parts have beyond the first at a vertex.
std::uint64_t check_fans(const WeldedMesh& mesh, std::size_t max_examples, CheckReport& report) {
  const CornerTable table = collect_corners(mesh);
  std::vector<std::array<Index, 2>> scratch;
  std::uint64_t more = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::vector<Index> fans = fans_at(mesh, table, v, scratch);
    report.vertices += !fans.empty();
    if (fans.size() < 2) continue;
    const bool own = std::adjacent_find(fans.begin(), fans.end()) == fans.end();
    if (report.wants_convex && own)
      more += fans.size() - 1;
    else
      report.nonmanifold_vertices.add({mesh.vertex[v], 0, mesh.points[v]}, max_examples);
  }
  return more;
}

void check_duplicates(const WeldedMesh& mesh, std::size_t max_examples, CheckReport& report) {
  std::vector<std::pair<std::array<Index, 3>, Index>> keys;  // sorted corners, triangle
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto key = mesh.triangles[t];
    std::sort(key.begin(), key.end());
    keys.emplace_back(key, Index(t));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::pair<Index, Index>> found;  // later, first
  for (std::size_t i = 1, first = 0; i < keys.size(); ++i) {
    if (keys[i].first != keys[first].first)
      first = i;
    else
      found.emplace_back(keys[i].second, keys[first].second);
  }
  std::sort(found.begin(), found.end());
  for (const auto& [later, first] : found)
    report.duplicate_triangles.add({mesh.number[later], mesh.number[first], mesh.corners(later)[0]}, max_examples);
}

void number_components(WeldedMesh& mesh, DisjointSets& sets, CheckReport& report) {
  mesh.component.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Index first = sets.find(Index(t));
    // A triangle with a repeated corner has no edges here; it is no component of its own.
    if (first == t && has_repeated_corner(mesh.triangles[t]))
      mesh.component[t] = Index(-1);
    else
      mesh.component[t] = first == t ? Index(report.components++) : mesh.component[first];
  }
}

}  // namespace

WeldedMesh weld(const IndexedMesh& mesh, std::size_t max_examples, CheckReport& report) {
  WeldedMesh welded;
  report.triangles = mesh.triangles.size();
  report.bad_faces.count = mesh.bad_faces, report.differing = mesh.differing, report.unfollowed = mesh.unfollowed;
  report.faces.add(mesh.inner_edges, mesh.triangles.size() - mesh.inner_edges.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3d& p = mesh.vertices[v];
    if (!is_finite(p))
      report.non_finite_vertices.add({v, 0, p}, max_examples);
    else if (!in_predicate_domain(p))
      report.undecidable_vertices.add({v, 0, p}, max_examples);
  }
  const std::vector<Index> point = merge_positions(mesh, welded, report);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    if (std::any_of(c.begin(), c.end(), [&](Index v) { return v >= mesh.vertices.size(); })) {
      report.bad_faces.add({t, 0, {}}, max_examples);
      continue;
    }
    if (!std::all_of(c.begin(), c.end(), [&](Index v) { return in_predicate_domain(mesh.vertices[v]); })) continue;
    welded.triangles.push_back({point[c[0]], point[c[1]], point[c[2]]});
    welded.number.push_back(t);
    const TriangleD corners = welded.corners(welded.triangles.size() - 1);
    welded.degenerate.push_back(collinear(corners[0], corners[1], corners[2]));
    if (welded.degenerate.back() != 0) report.degenerate_triangles.add({t, 0, corners[0]}, max_examples);
  }
  return welded;
}

void check_topology(WeldedMesh& mesh, std::size_t max_examples, CheckReport& report) {
  DisjointSets sets(mesh.triangles.size());
  const std::uint64_t edges = check_edges(mesh, collect_edges(mesh), max_examples, sets, report);
  number_components(mesh, sets, report);
  const std::uint64_t more_fans = check_fans(mesh, max_examples, report);
  check_duplicates(mesh, max_examples, report);
  const auto faces = std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                                   [](const auto& t) { return !has_repeated_corner(t); });
  report.euler = std::int64_t(report.vertices + more_fans) - std::int64_t(edges) + std::int64_t(faces);
  if (report.closed() && report.oriented() && report.manifold())
    report.genus = std::int64_t(report.components) - report.euler / 2;
}

}  // namespace bp
