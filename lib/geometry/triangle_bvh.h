#pragma once
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "lib/core/box.h"

/// A bounding volume hierarchy over triangles of doubles. A box is the exact bounds of its triangles, since minima and
/// maxima of doubles are not rounded. So no triangle is ever missed.
namespace bp {

[[nodiscard]] inline Bounds3d bounds_of(const TriangleD& t) {
  Bounds3d b;
  for (const Vec3d& p : t) b.add(p);
  return b;
}
[[nodiscard]] inline Bounds3d bounds_of(std::span<const TriangleD> triangles) {
  Bounds3d box;
  for (const TriangleD& t : triangles) box.merge(bounds_of(t));
  return box;
}
/// Returns whether two closed boxes meet; touching counts.
[[nodiscard]] inline bool overlap(const Bounds3d& a, const Bounds3d& b) {
  return a.min[0] <= b.max[0] && b.min[0] <= a.max[0] && a.min[1] <= b.max[1] && b.min[1] <= a.max[1] &&
         a.min[2] <= b.max[2] && b.min[2] <= a.max[2];
}

class TriangleBvh {
 public:
  struct Item {
    TriangleD corners;
    std::uint32_t id;  ///< position in the vector that the hierarchy was built from
  };
  struct Hit {
    double along;        ///< the place is start + along * direction; along is in [0, 1]
    std::uint32_t item;  ///< number for item()
  };
  struct Nearest {
    double distance_squared;
    std::uint32_t item;  ///< number for item()
  };

  /// Builds the tree: O(n log n), parallel, the same tree for any number of threads. Coordinates must be finite; at
  /// most 2^31 triangles.
  explicit TriangleBvh(const std::vector<TriangleD>& triangles);

  [[nodiscard]] bool empty() const { return items_.empty(); }
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  /// Returns triangle i in an order of spatial neighbours.
  [[nodiscard]] const Item& item(std::size_t i) const { return items_[i]; }
  [[nodiscard]] std::uint64_t bytes() const { return items_.size() * sizeof(Item) + nodes_.size() * sizeof(Node); }

  /// Calls f(item) for each triangle whose bounds meet `box`, until f returns true. Returns whether it did.
  template <class F>
  bool visit(const Bounds3d& box, F&& f) const {
    return walk([&](const Bounds3d& b) { return overlap(b, box); }, f);
  }
  /// Calls f(item) for each triangle whose bounds meet the ray from p upwards (+z).
  template <class F>
  void visit_above(const Vec3d& p, F&& f) const {
    const auto meets = [&](const Bounds3d& b) {
      return b.min[0] <= p[0] && p[0] <= b.max[0] && b.min[1] <= p[1] && p[1] <= b.max[1] && b.max[2] >= p[2];
    };
    walk(meets, [&](const Item& item) { return f(item), false; });
  }
  /// Returns the first triangle on the ray from `start` to start + most * direction (`most` is at most 1) that
  /// accept(item, along) takes. If several are at one place, it is the one that is before(item, item) the others. In
  /// floating point; triangles count from both sides. accept() may also be asked about triangles behind the answer.
  template <class Accept, class Before>
  [[nodiscard]] std::optional<Hit> first_along(const Vec3d& start, const Vec3d& direction, double most,
                                               const Accept& accept, const Before& before) const;
  /// Returns the nearest triangle whose squared distance is at most `most` and that accept(item) takes. If there are
  /// several, it is the one that is before(item, item) the others. In floating point.
  template <class Accept, class Before>
  [[nodiscard]] std::optional<Nearest> nearest_within(const Vec3d& p, double most, const Accept& accept,
                                                      const Before& before) const;
  /// Returns the nearest triangle (one of them), in floating point. The search starts at item `guess`: the answer for a
  /// point close by makes it fast. The distance does not depend on it. The tree must not be empty.
  [[nodiscard]] Nearest nearest(const Vec3d& p, std::uint32_t guess = 0) const { return near_enough(p, -1, guess); }
  /// Returns the first triangle found whose squared distance is at most `enough`; if there is none, the nearest one.
  [[nodiscard]] Nearest near_enough(const Vec3d& p, double enough, std::uint32_t guess) const;

  /// Returns an upper bound of the bytes of a hierarchy over n triangles, the build included.
  [[nodiscard]] static std::uint64_t bytes_needed(std::uint64_t n);
  /// Returns the sum of these and of the bytes of the triangles.
  [[nodiscard]] static std::uint64_t bytes_with_triangles(std::uint64_t n) {
    return n * sizeof(TriangleD) + bytes_needed(n);
  }

 private:
  static constexpr int kLeaf = 4;    // triangles in a leaf, at most
  static constexpr int kStack = 96;  // depth of the tree is limited to 90

  struct Node {
    Bounds3d box;
    std::uint32_t first;  // of a leaf: its first item; else its first child, which the second one follows
    std::uint32_t count;  // of a leaf: the number of its items; else 0
  };
  struct Builder;

  template <class Meets, class F>
  bool walk(const Meets& meets, F&& f) const {
    if (items_.empty() || !meets(nodes_[0].box)) return false;
    std::uint32_t stack[kStack];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& n = nodes_[stack[--top]];
      for (std::uint32_t i = n.first; i < n.first + n.count; ++i)
        if (meets(bounds_of(items_[i].corners)) && f(items_[i])) return true;
      if (n.count != 0) continue;
      for (std::uint32_t child = n.first + 2; child-- > n.first;)
        if (meets(nodes_[child].box)) stack[top++] = child;
    }
    return false;
  }

  std::vector<Node> nodes_;
  std::vector<Item> items_;
};

/// Return the squared distances from p to the closed triangle and to the closed box, in floating point.
[[nodiscard]] double distance_squared(const Vec3d& p, const TriangleD& t);
[[nodiscard]] double distance_squared(const Vec3d& p, const Bounds3d& b);

/// Returns where the segment from `start` to start + direction meets the triangle: 0 at its start, 1 at its end.
/// Returns NaN if it does not meet it, or runs along it. In floating point.
[[nodiscard]] double along_segment(const Vec3d& start, const Vec3d& direction, const TriangleD& t);

/// Returns where the segment from `start` along `direction` enters the box, if it does so up to `most`, at most 1; else
/// 2. In floating point, with some room.
[[nodiscard]] inline double enters_along(const Vec3d& start, const Vec3d& direction, const Bounds3d& box, double most) {
  double from = 0, to = most;
  for (std::size_t i = 0; i < 3; ++i) {
    if (direction[i] == 0) {
      if (start[i] < box.min[i] || start[i] > box.max[i]) return 2;
      continue;
    }
    double a = (box.min[i] - start[i]) / direction[i], z = (box.max[i] - start[i]) / direction[i];
    if (a > z) std::swap(a, z);
    from = std::max(from, a - 1e-12);
    to = std::min(to, z + 1e-12);
  }
  return from <= to ? from : 2;
}

template <class Accept, class Before>
std::optional<TriangleBvh::Hit> TriangleBvh::first_along(const Vec3d& start, const Vec3d& direction, double most,
                                                         const Accept& accept, const Before& before) const {
  struct Entry {
    double along;
    std::uint32_t node;
  };
  Hit best{most, ~std::uint32_t(0)};
  bool found = false;
  const auto enters = [&](const Bounds3d& b) { return enters_along(start, direction, b, best.along); };
  Entry stack[kStack];
  int top = 0;
  if (!items_.empty()) stack[top++] = {enters(nodes_[0].box), 0};
  while (top > 0) {
    const Entry e = stack[--top];
    if (e.along > best.along) continue;
    const Node& n = nodes_[e.node];
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
      const double along = along_segment(start, direction, items_[i].corners);
      if (!(along <= best.along)) continue;
      if (found && along == best.along && !before(i, best.item)) continue;
      if (accept(i, along)) best = {along, i}, found = true;
    }
    if (n.count != 0) continue;
    Entry near{enters(nodes_[n.first].box), n.first}, far{enters(nodes_[n.first + 1].box), n.first + 1};
    if (far.along < near.along) std::swap(near, far);
    if (far.along <= best.along) stack[top++] = far;
    if (near.along <= best.along) stack[top++] = near;
  }
  return found ? std::optional(best) : std::nullopt;
}

template <class Accept, class Before>
std::optional<TriangleBvh::Nearest> TriangleBvh::nearest_within(const Vec3d& p, double most, const Accept& accept,
                                                                const Before& before) const {
  constexpr double kRounding = 1 - 1e-12;  // boxes of flat triangles are not farther away than the triangles
  struct Entry {
    double distance;
    std::uint32_t node;
  };
  const auto distance_to = [&](std::uint32_t node) { return kRounding * distance_squared(p, nodes_[node].box); };
  Nearest best{most, ~std::uint32_t(0)};
  Entry stack[kStack];
  int top = 0;
  if (!items_.empty()) stack[top++] = {distance_to(0), 0};
  while (top > 0) {
    const Entry e = stack[--top];
    if (e.distance > best.distance_squared) continue;
    const Node& n = nodes_[e.node];
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
      const double d = distance_squared(p, items_[i].corners);
      const bool is_none = best.item == ~std::uint32_t(0);
      const bool is_nearer =
          d < best.distance_squared || (d == best.distance_squared && (is_none || before(i, best.item)));
      if (is_nearer && accept(i)) best = {d, i};
    }
    if (n.count != 0) continue;
    Entry near{distance_to(n.first), n.first}, far{distance_to(n.first + 1), n.first + 1};
    if (far.distance < near.distance) std::swap(near, far);
    if (far.distance <= best.distance_squared) stack[top++] = far;
    if (near.distance <= best.distance_squared) stack[top++] = near;
  }
  return best.item == ~std::uint32_t(0) ? std::nullopt : std::optional(best);
}

/// Returns the point of the closed triangle nearest to p, in floating point.
[[nodiscard]] Vec3d nearest_point(const Vec3d& p, const TriangleD& t);
/// Returns the barycentric coordinates of a point of the triangle, in floating point; those of the first corner if the
/// triangle has no area.
[[nodiscard]] std::array<double, 3> barycentric(const TriangleD& t, const Vec3d& p);

}  // namespace bp
