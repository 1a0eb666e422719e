// The build goes top down. The surface area heuristic over bins chooses the splits (docs/references.md: [Wald07]). The
// upper levels are split one after the other. Then the subtrees are built in parallel and appended in order. Their
// places depend on n alone, so the tree does not depend on the number of threads.
#include "lib/geometry/triangle_bvh.h"

#include <algorithm>
#include <numeric>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr int kBins = 16;
constexpr int kMaxHeuristicDepth = 58;  // below it the median halves the count, which adds 31 levels at most

double half_area(const Bounds3d& b) {
  if (b.empty()) return 0;
  const Vec3d s = b.max - b.min;
  return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
}

typedef double DoublePair __attribute__((vector_size(16)));

/// The edges of a triangle seen from a point. T is double for one triangle, DoublePair for two at once.
template <class T>
struct Edges {
  using Vec = std::array<T, 3>;
  Vec along, to_point;  // edge vectors, and vectors from the start of each edge to the point

  static T dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  /// Returns 0 or more if the point is on the triangle's side of the plane along the edge. `n`: the triangle's normal.
  [[nodiscard]] T inwards(const Vec3d& n) const {
    const auto& [x, y, z] = along;
    const auto& [u, v, w] = to_point;
    const Vec turn = {y * w - z * v, z * u - x * w, x * v - y * u};
    return turn[0] * n[0] + turn[1] * n[1] + turn[2] * n[2];
  }
  [[nodiscard]] T distance_squared() const {
    const T length = dot(along, along);
    T share = dot(to_point, along) / length;
    share = share < 0 ? T{} : share;
    share = share > 1 ? T{} + 1 : share;
    share = length > 0 ? share : T{};
    const Vec d{to_point[0] - share * along[0], to_point[1] - share * along[1], to_point[2] - share * along[2]};
    return dot(d, d);
  }
};

double distance_squared_inline(const Vec3d& p, const TriangleD& t) {
  Edges<DoublePair> first;
  Edges<double> last;
  for (std::size_t i = 0; i < 3; ++i) {
    const DoublePair from = {t[0][i], t[1][i]}, to = {t[1][i], t[2][i]};
    first.along[i] = to - from;
    first.to_point[i] = p[i] - from;
    last.along[i] = t[0][i] - t[2][i];
    last.to_point[i] = p[i] - t[2][i];
  }
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
  const double nn = dot(n, n);
  const DoublePair inwards = first.inwards(n);
  if (nn > 0 && inwards[0] >= 0 && inwards[1] >= 0 && last.inwards(n) >= 0) {
    const double height = dot(p - t[0], n);
    return height * height / nn;
  }
  const DoublePair two = first.distance_squared();
  return std::min(std::min(two[0], two[1]), last.distance_squared());
}

}  // namespace

double distance_squared(const Vec3d& p, const Bounds3d& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = std::max(std::max(b.min[i] - p[i], p[i] - b.max[i]), 0.0);
    sum += d * d;
  }
  return sum;
}

double distance_squared(const Vec3d& p, const TriangleD& t) {
  return distance_squared_inline(p, t);
}

Vec3d nearest_point(const Vec3d& p, const TriangleD& t) {
  const auto along = [](const Vec3d& a, const Vec3d& d, double s) {
    return Vec3d{a[0] + s * d[0], a[1] + s * d[1], a[2] + s * d[2]};
  };
  const Vec3d u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double det = uu * vv - uv * uv, s = vv * uw - uv * vw, r = uu * vw - uv * uw;
  if (det > 0 && s >= 0 && r >= 0 && s + r <= det) return along(along(t[0], u, s / det), v, r / det);
  Vec3d best = t[0];
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &a = t[k], d = t[(k + 1) % 3] - a;
    const double l = dot(d, d);
    const Vec3d q = l > 0 ? along(a, d, std::clamp(dot(p - a, d) / l, 0.0, 1.0)) : a;
    const double far = dot(p - q, p - q);
    if (far < least) least = far, best = q;
  }
  return best;
}

double along_segment(const Vec3d& start, const Vec3d& direction, const TriangleD& t) {
  constexpr double kSlack = 1e-9;  // of a side, so that no ray passes between two triangles
  const Vec3d u = t[1] - t[0], v = t[2] - t[0], p = cross(direction, v);
  const double det = dot(u, p);
  if (det == 0) return NAN;
  const Vec3d s = start - t[0], q = cross(s, u);
  const double a = dot(s, p) / det, b = dot(direction, q) / det, along = dot(v, q) / det;
  const bool inside = a >= -kSlack && b >= -kSlack && a + b <= 1 + kSlack && along >= 0 && along <= 1;
  return inside ? along : NAN;
}

std::array<double, 3> barycentric(const TriangleD& t, const Vec3d& p) {
  const Vec3d u = t[1] - t[0], v = t[2] - t[0], n = cross(u, v);
  const double nn = dot(n, n);
  if (!(nn > 0)) return {1, 0, 0};
  const double s = dot(n, cross(p - t[0], v)) / nn, r = dot(n, cross(u, p - t[0])) / nn;
  return {1 - s - r, s, r};
}

struct TriangleBvh::Builder {
  struct Primitive {
    Bounds3d box;
    std::uint32_t id;
    [[nodiscard]] double centre(std::size_t axis) const { return box.min[axis] + box.max[axis]; }  // doubled
  };
  struct Task {
    std::uint32_t begin, end, node;
    int depth;
  };
  struct Bin {
    Bounds3d box;
    std::uint32_t count = 0;
  };

  std::vector<Primitive> primitives;

  explicit Builder(const std::vector<TriangleD>& triangles) : primitives(triangles.size()) {
    parallel_ranges(std::int64_t(triangles.size()), 1 << 14, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
        primitives[std::size_t(i)] = {bounds_of(triangles[std::size_t(i)]), std::uint32_t(i)};
    });
  }

  [[nodiscard]] Bounds3d bounds(std::uint32_t begin, std::uint32_t end) const {
    Bounds3d b;
    for (std::uint32_t i = begin; i < end; ++i) b.merge(primitives[i].box);
    return b;
  }

  /// Divides [begin, end), which is reordered, and returns the place, strictly inside.
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, int depth) {
    Vec3d low, high;
    centre_range(begin, end, low, high);
    const Vec3d extent = high - low;
    const std::size_t axis = std::size_t(std::max_element(extent.begin(), extent.end()) - extent.begin());
    // The extent may be zero (all centres are equal) or not finite.
    if (depth >= kMaxHeuristicDepth || !(extent[axis] > 0) || !(kBins / extent[axis] < HUGE_VAL))
      return median(begin, end, axis);
    const double factor = kBins / extent[axis];
    const auto bin_of = [&](const Primitive& p) {
      return std::clamp(int((p.centre(axis) - low[axis]) * factor), 0, kBins - 1);
    };
    Bin bins[kBins];
    for (std::uint32_t i = begin; i < end; ++i) {
      Bin& b = bins[bin_of(primitives[i])];
      b.box.merge(primitives[i].box);
      ++b.count;
    }
    const int cut = best_cut(bins);
    const auto first = primitives.begin() + begin, last = primitives.begin() + end;
    const auto middle = std::stable_partition(first, last, [&](const Primitive& p) { return bin_of(p) < cut; });
    return middle == first || middle == last ? median(begin, end, axis) : std::uint32_t(middle - primitives.begin());
  }

  void centre_range(std::uint32_t begin, std::uint32_t end, Vec3d& low, Vec3d& high) const {
    Bounds3d b;
    for (std::uint32_t i = begin; i < end; ++i)
      b.add({primitives[i].centre(0), primitives[i].centre(1), primitives[i].centre(2)});
    low = b.min, high = b.max;
  }

  std::uint32_t median(std::uint32_t begin, std::uint32_t end, std::size_t axis) {
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(primitives.begin() + begin, primitives.begin() + middle, primitives.begin() + end,
                     [&](const Primitive& a, const Primitive& b) {
                       return a.centre(axis) != b.centre(axis) ? a.centre(axis) < b.centre(axis) : a.id < b.id;
                     });
    return middle;
  }

  /// Returns the bin that starts the right side, so that the sum of area times count is least.
  static int best_cut(const Bin (&bins)[kBins]) {
    double right_cost[kBins] = {};
    Bounds3d box;
    std::uint32_t count = 0;
    for (int i = kBins - 1; i > 0; --i) {
      box.merge(bins[i].box);
      right_cost[i] = half_area(box) * (count += bins[i].count);
    }
    box = {}, count = 0;
    int best = kBins / 2;
    double least = HUGE_VAL;
    for (int i = 1; i < kBins; ++i) {
      box.merge(bins[i - 1].box);
      count += bins[i - 1].count;
      const double cost = half_area(box) * count + right_cost[i];
      if (cost < least) least = cost, best = i;
    }
    return best;
  }

  /// Builds below `tasks`, and leaves those of at most `stop` triangles undone. Returns these in the order of their
  /// triangles.
  std::vector<Task> build(std::vector<Node>& nodes, std::vector<Task> tasks, std::uint32_t stop) {
    std::vector<Task> left;
    while (!tasks.empty()) {
      const Task t = tasks.back();
      tasks.pop_back();
      if (t.end - t.begin <= stop && stop > kLeaf) {
        left.push_back(t);
        continue;
      }
      nodes[t.node].box = bounds(t.begin, t.end);
      if (t.end - t.begin <= std::uint32_t(kLeaf)) {
        nodes[t.node].first = t.begin, nodes[t.node].count = t.end - t.begin;
        continue;
      }
      const std::uint32_t middle = split(t.begin, t.end, t.depth), child = std::uint32_t(nodes.size());
      nodes[t.node].first = child, nodes[t.node].count = 0;
      nodes.resize(nodes.size() + 2);
      tasks.push_back({middle, t.end, child + 1, t.depth + 1});
      tasks.push_back({t.begin, middle, child, t.depth + 1});
    }
    return left;
  }
};

TriangleBvh::TriangleBvh(const std::vector<TriangleD>& triangles) {
  if (triangles.empty()) return;
  const auto n = std::uint32_t(triangles.size());
  Builder builder(triangles);
  nodes_.resize(1);
  const auto subtrees = builder.build(nodes_, {{0, n, 0, 0}}, std::max(2048u, n / 64));
  std::vector<std::vector<Node>> built(subtrees.size());
  parallel_for(std::int64_t(subtrees.size()), [&](std::int64_t i) {
    Builder::Task task = subtrees[std::size_t(i)];
    task.node = 0;
    built[std::size_t(i)].resize(1);
    (void)builder.build(built[std::size_t(i)], {task}, 0);
  });
  for (std::size_t i = 0; i < subtrees.size(); ++i) {  // the root replaces its placeholder, the rest is appended
    const auto shift = std::uint32_t(nodes_.size()) - 1;
    for (Node& node : built[i])
      if (node.count == 0) node.first += shift;
    nodes_[subtrees[i].node] = built[i][0];
    nodes_.insert(nodes_.end(), built[i].begin() + 1, built[i].end());
    built[i] = {};
  }
  items_.resize(n);
  parallel_ranges(n, 1 << 14, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const std::uint32_t id = builder.primitives[std::size_t(i)].id;
      items_[std::size_t(i)] = {triangles[id], id};
    }
  });
}

std::uint64_t TriangleBvh::bytes_needed(std::uint64_t n) {
  return n * (sizeof(Item) + 2 * sizeof(Node) + sizeof(Builder::Primitive));
}

TriangleBvh::Nearest TriangleBvh::near_enough(const Vec3d& p, double enough, std::uint32_t guess) const {
  struct Entry {
    double distance;
    std::uint32_t node;
  };
  Entry stack[kStack];
  int top = 0;
  stack[top++] = {distance_squared(p, nodes_[0].box), 0};
  Nearest best{bp::distance_squared(p, items_[guess].corners), guess};
  while (top > 0 && best.distance_squared > enough) {
    const Entry e = stack[--top];
    if (e.distance >= best.distance_squared) continue;
    const Node& n = nodes_[e.node];
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
      const double d = distance_squared_inline(p, items_[i].corners);
      if (d < best.distance_squared) best = {d, i};
    }
    if (n.count != 0) continue;
    Entry near{distance_squared(p, nodes_[n.first].box), n.first};
    Entry far{distance_squared(p, nodes_[n.first + 1].box), n.first + 1};
    if (far.distance < near.distance) std::swap(near, far);
    if (far.distance < best.distance_squared) stack[top++] = far;
    if (near.distance < best.distance_squared) stack[top++] = near;
  }
  return best;
}

}  // namespace bp
