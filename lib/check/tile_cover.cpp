#include "lib/check/tile_cover.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cmath>
#include <memory>

#include "lib/check/detail/surface.h"
#include "lib/core/parallel.h"
#include "lib/core/triangle_intersection.h"

namespace bp {

namespace {

constexpr double kGrowth = 1e-9;       // of a cell, in its edges
constexpr double kRounding = 0x1p-50;  // of a point in doubles beside one of the triangle, in its coordinates
constexpr double kNear = 1e-12;        // the same, in edges of the cell

/// The determinant of orient3d and a bound of its error (predicates.h, "Filter").
struct Side {
  double value, error;
};
Side side_of(const TriangleD& t, const Vec3d& p) {
  Vec3d u, v, w;
  for (std::size_t i = 0; i < 3; ++i) u[i] = t[1][i] - t[0][i], v[i] = t[2][i] - t[0][i], w[i] = p[i] - t[0][i];
  double value = 0, permanent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double l = u[j] * v[k], r = u[k] * v[j];
    value += (l - r) * w[i];
    permanent += (std::abs(l) + std::abs(r)) * std::abs(w[i]);
  }
  return {std::abs(value), 16 * 0x1p-53 * permanent};
}

/// The hull of boxes, relative to a corner of the cell.
using Hull = std::vector<Bounds3d>;

/// Bounds of where segment pq, which meets triangle t, crosses the plane of t: by the ratio of the distances of its
/// ends. All of pq if it lies in the plane.
void add_crossing(const Vec3d& p, const Vec3d& q, const TriangleD& t, const Vec3d& corner, Hull& hull) {
  const Side a = side_of(t, p), b = side_of(t, q);
  const double a_lo = std::max(a.value - a.error, 0.0), a_hi = a.value + a.error;
  const double b_lo = std::max(b.value - b.error, 0.0), b_hi = b.value + b.error;
  const double lo = a_lo + b_hi > 0 ? a_lo / (a_lo + b_hi) * (1 - 1e-15) : 0;
  const double hi = a_hi + b_lo > 0 ? std::min(a_hi / (a_hi + b_lo) * (1 + 1e-15), 1.0) : 1;
  for (const double s : {lo, hi}) {
    Bounds3d& box = hull.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = p[i] + s * (q[i] - p[i]) - corner[i], error = 0x1p-50 * (std::abs(p[i]) + std::abs(q[i]));
      box.min[i] = x - error, box.max[i] = x + error;
    }
  }
}

void add_crossings(const TriangleD& a, const TriangleD& b, const Vec3d& corner, Hull& hull) {
  for (std::size_t e = 0; e < 3; ++e) {
    if (segment_meets_triangle(a[e], a[(e + 1) % 3], b.data())) {
      add_crossing(a[e], a[(e + 1) % 3], b, corner, hull);
    }
  }
}

/// The least and the largest value of x·a on a box, or a bit beyond.
std::array<double, 2> extent(const Bounds3d& box, const Vec3d& a) {
  double lo = 0, hi = 0, sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = box.min[i] * a[i], y = box.max[i] * a[i];
    lo += std::min(x, y), hi += std::max(x, y);
    sum += std::abs(x) + std::abs(y);
  }
  return {lo - 0x1p-50 * sum, hi + 0x1p-50 * sum};
}

bool separated(const Hull& hull, const Bounds3d& box, const Vec3d& axis) {
  const auto [lo, hi] = extent(box, axis);
  bool below = true, above = true;
  for (const Bounds3d& part : hull) {
    const auto [a, b] = extent(part, axis);
    below = below && b < lo, above = above && a > hi;
  }
  return below || above;
}

/// True unless an axis surely tells the hull from the box. There is one for every segment that misses the box: an axis
/// of the box, or one across the segment and an axis of the box.
bool may_meet(const Hull& hull, const Bounds3d& box) {
  if (hull.empty()) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3d axis{};
    axis[i] = 1;
    if (separated(hull, box, axis)) return false;
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (auto p = hull.begin(); p != hull.end(); ++p) {
      for (auto q = hull.begin(); q != p; ++q) {
        Vec3d across{};
        across[j] = p->min[k] - q->min[k], across[k] = q->min[j] - p->min[j];
        if (separated(hull, box, across)) return false;
      }
    }
  }
  return true;
}

/// True unless what two triangles have in common, the hull of where edges of one meet the other, surely misses the box.
bool may_meet_within(const TriangleD& a, const TriangleD& b, const Bounds3d& box) {
  Hull hull;
  add_crossings(a, b, box.min, hull);
  add_crossings(b, a, box.min, hull);
  Bounds3d here;
  for (std::size_t i = 0; i < 3; ++i) here.min[i] = 0, here.max[i] = (box.max[i] - box.min[i]) * (1 + 0x1p-50);
  return may_meet(hull, here);
}

double edge_of(const Bounds3d& box) {
  return std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
}

double largest(const Vec3d& p) {
  return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
}

/// How far a point in doubles may lie from the point of the triangle that it stands for.
double rounding_of(const Bounds3d& cell, const TriangleD& t) {
  double most = std::max(largest(cell.min), largest(cell.max));
  for (const Vec3d& p : t) most = std::max(most, largest(p));
  return std::max(kNear * edge_of(cell), kRounding * most);
}

/// By how much a cell is grown where the triangle is looked at: far more than rounding, wherever the origin is.
double growth_for(const Bounds3d& cell, const TriangleD& t) {
  return std::max(kGrowth * edge_of(cell), 16 * rounding_of(cell, t));
}

Bounds3d grown(const Bounds3d& box, double by) {
  Bounds3d out = box;
  for (std::size_t i = 0; i < 3; ++i) out.min[i] -= by, out.max[i] += by;
  return out;
}

/// Triangle ∩ box, a convex polygon; in doubles, relative to the box's corner, so that errors are small beside it.
class ClippedTriangle {
 public:
  ClippedTriangle(const TriangleD& t, const Bounds3d& box) {
    Vec3d size;
    for (std::size_t i = 0; i < 3; ++i) size[i] = box.max[i] - box.min[i];
    for (const Vec3d& p : t) points_.push_back({p[0] - box.min[0], p[1] - box.min[1], p[2] - box.min[2]});
    for (std::size_t i = 0; i < 3 && !points_.empty(); ++i) {
      cut([&](const Vec3d& p) { return p[i]; });
      cut([&](const Vec3d& p) { return size[i] - p[i]; });
    }
    origin_ = box.min;
  }
  [[nodiscard]] bool empty() const { return points_.empty(); }
  /// The middle, and points between it and the corners.
  [[nodiscard]] std::vector<Vec3d> points_within() const {
    if (empty()) return {};
    Vec3d middle{};
    for (const Vec3d& p : points_)
      for (std::size_t i = 0; i < 3; ++i) middle[i] += p[i] / double(points_.size());
    std::vector<Vec3d> all{at(middle)};
    for (const Vec3d& p : points_)
      all.push_back(at({(p[0] + middle[0]) / 2, (p[1] + middle[1]) / 2, (p[2] + middle[2]) / 2}));
    return all;
  }

 private:
  [[nodiscard]] Vec3d at(const Vec3d& p) const { return {origin_[0] + p[0], origin_[1] + p[1], origin_[2] + p[2]}; }
  /// Keeps where height() is not negative (Sutherland and Hodgman).
  template <class Height>
  void cut(const Height& height) {
    std::vector<Vec3d> kept;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec3d &p = points_[k], &q = points_[(k + 1) % points_.size()];
      const double hp = height(p), hq = height(q);
      if (hp >= 0) kept.push_back(p);
      if ((hp >= 0) == (hq >= 0)) continue;
      const double s = hp / (hp - hq);
      kept.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
    }
    points_ = std::move(kept);
  }
  std::vector<Vec3d> points_;
  Vec3d origin_{};
};

enum class Verdict { fine, touching, outside, undecided };

/// The content of a tile as a surface, and the triangles of the scene that it fails.
struct Body {
  WeldedMesh mesh;
  std::unique_ptr<Surface> surface;
  bool closed = false, sound = true;
  void drop() {
    surface.reset();
    mesh = {};
  }
};

struct Counts {
  std::atomic<std::uint64_t> touching{0}, outside{0}, undecided{0}, uncovered{0}, bare{0};
};

class Checker {
 public:
  Checker(const std::vector<CoverTile>& tiles, const CoverContents& content_of)
      : tiles_(tiles), content_of_(content_of), bodies_(tiles.size()), counts_(tiles.size()), below_(tiles.size()) {
    find_below(0);
  }

  std::vector<CoverFinding> run(TriangleSource& scene, std::uint64_t memory_bytes) {
    for (begin_ = 0; begin_ < tiles_.size(); begin_ = end_) {
      end_ = end_of_share(memory_bytes);
      parallel_for(std::int64_t(end_ - begin_), [&](std::int64_t i) { load(begin_ + std::size_t(i)); });
      pass(scene);
      for (std::size_t i = begin_; i < end_; ++i) bodies_[i].drop();
    }
    for (std::size_t i = 0; i < tiles_.size(); ++i) say_of_tile(i);
    if (astray_ > 0)
      findings_.push_back(
          {fmt::format("{}: {} triangles of the scene leave its cell", tiles_[0].place, astray_.load())});
    for (std::size_t i = 0; i < tiles_.size(); ++i) say_of_scene(i);
    return std::move(findings_);
  }

 private:
  /// Least and largest of some tiles.
  struct Numbers {
    std::size_t first = 0, last = 0;
  };

  const Numbers& find_below(std::size_t i) {
    Numbers& all = below_[i] = {i, i};
    for (const std::size_t child : tiles_[i].children) {
      const Numbers& some = find_below(child);
      all = {std::min(all.first, some.first), std::max(all.last, some.last)};
    }
    return all;
  }

  [[nodiscard]] std::size_t end_of_share(std::uint64_t memory_bytes) const {
    std::uint64_t bytes = 0;
    std::size_t end = begin_;
    while (end < tiles_.size()) {
      bytes += tiles_[end].triangles.value_or(0) * kCoverBytesPerTriangle;
      if (bytes > memory_bytes && end > begin_) break;
      ++end;
    }
    return end;
  }

  void load(std::size_t i) {
    if (!tiles_[i].triangles) return;
    Body& body = bodies_[i];
    CheckReport report;
    body.mesh = weld(content_of_(i), 1, report);
    check_topology(body.mesh, 1, report);
    body.surface = std::make_unique<Surface>(body.mesh);
    report.self_intersections = body.surface->self_intersections(1);
    body.closed = report.closed() && report.oriented();
    if (body.closed) report.inverted_components = inverted_components(body.mesh, *body.surface, 1);
    body.sound = report.holds();
  }

  void pass(TriangleSource& scene) {
    scene.rewind();
    pipeline<std::vector<TriangleD>>(
        2 * thread_count(), [&](std::vector<TriangleD>& chunk) { return scene.read(chunk); },
        [&](std::vector<TriangleD>& chunk) {
          for (const TriangleD& t : chunk) {
            if (in_root(t)) {
              visit(0, t);
            } else if (begin_ == 0) {
              ++astray_;
            }
          }
        },
        [](std::vector<TriangleD>&) {});
  }

  [[nodiscard]] bool fits(std::size_t parent, std::size_t child) const {
    const auto &p = tiles_[parent].cell, &c = tiles_[child].cell;
    if (p == c) return tiles_[parent].children.size() == 1;
    if (!p || !c) return false;
    for (int k = 0; k < 8; ++k) {
      if (octant(*p, k) == *c) return true;
    }
    return false;
  }

  static Bounds3d octant(const Bounds3d& box, int k) {
    Bounds3d out = box;
    for (std::size_t i = 0; i < 3; ++i) {
      const double middle = box.min[i] + (box.max[i] - box.min[i]) / 2;
      ((k >> i & 1) != 0 ? out.min[i] : out.max[i]) = middle;
    }
    return out;
  }

  [[nodiscard]] bool in_root(const TriangleD& t) const {
    if (!tiles_[0].cell) return true;
    const Bounds3d& cell = *tiles_[0].cell;
    for (const Vec3d& p : t) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (!(p[i] >= cell.min[i] && p[i] <= cell.max[i])) return false;
      }
    }
    return true;
  }

  /// True unless t surely avoids the closed cell.
  [[nodiscard]] static bool meets(const TriangleD& t, const std::optional<Bounds3d>& cell) {
    if (!cell) return true;
    const Bounds3d box = grown(*cell, growth_for(*cell, t) / 2);
    return overlap(bounds_of(t), box) && !ClippedTriangle(t, box).empty();
  }

  /// t meets the cell of tile i. What counts are the tiles of this share.
  void visit(std::size_t i, const TriangleD& t) {
    if (below_[i].first >= end_ || below_[i].last < begin_) return;
    const CoverTile& tile = tiles_[i];
    const bool mine = i >= begin_ && i < end_;
    if (mine && !tile.triangles && tile.children.empty()) ++counts_[i].bare;
    if (mine && tile.triangles) {
      const Verdict verdict = examine(i, t);
      counts_[i].touching += verdict == Verdict::touching;
      counts_[i].outside += verdict == Verdict::outside;
      counts_[i].undecided += verdict == Verdict::undecided;
    }
    if (tile.children.empty()) return;
    if (tile.children.size() == 1 && tiles_[tile.children[0]].cell == tile.cell) return visit(tile.children[0], t);
    if (!tile.cell) return;
    for (int k = 0; k < 8; ++k) {
      const Bounds3d box = octant(*tile.cell, k);
      if (!meets(t, box)) continue;
      const std::size_t child = child_at(tile, box);
      if (child != 0) {
        visit(child, t);
      } else if (mine) {
        ++counts_[i].uncovered;
      }
    }
  }

  [[nodiscard]] std::size_t child_at(const CoverTile& tile, const Bounds3d& box) const {
    for (const std::size_t child : tile.children) {
      if (tiles_[child].cell == box) return child;
    }
    return 0;
  }

  [[nodiscard]] Verdict examine(std::size_t i, const TriangleD& t) const {
    const Body& body = bodies_[i];
    if (!body.closed) return Verdict::undecided;
    for (const Vec3d& p : t) {
      if (!in_predicate_domain(p)) return Verdict::undecided;
    }
    const std::optional<Bounds3d>& cell = tiles_[i].cell;
    if (!cell) {
      if (body.surface->touched_by(t) != Surface::kNone) return Verdict::touching;
      return body.surface->winding(t[0]) < 1 ? Verdict::outside : Verdict::fine;
    }
    const double growth = growth_for(*cell, t);
    const Bounds3d box = grown(*cell, growth);
    if (touches_within(body, t, box)) return Verdict::touching;
    // No face meets t in the grown cell, so all of t there lies on the side of any point of it.
    for (const Vec3d& p : t) {
      if (contains(*cell, p)) return body.surface->winding(p) < 1 ? Verdict::outside : Verdict::fine;
    }
    for (const Vec3d& p : ClippedTriangle(t, grown(*cell, growth / 2)).points_within()) {
      const Verdict verdict = side_near(body, p, rounding_of(*cell, t));
      if (verdict != Verdict::undecided) return verdict;
    }
    return Verdict::undecided;
  }

  [[nodiscard]] static bool contains(const Bounds3d& box, const Vec3d& p) { return overlap(box, Bounds3d{p, p}); }

  [[nodiscard]] static bool touches_within(const Body& body, const TriangleD& t, const Bounds3d& box) {
    Bounds3d reach = bounds_of(t);
    for (std::size_t i = 0; i < 3; ++i) {
      reach.min[i] = std::max(reach.min[i], box.min[i]);
      reach.max[i] = std::min(reach.max[i], box.max[i]);
    }
    return body.surface->bvh().visit(reach, [&](const TriangleBvh::Item& face) {
      return triangles_intersect(t.data(), face.corners.data()) && may_meet_within(t, face.corners, box);
    });
  }

  /// The side of a point of the triangle that lies within `radius` of `p`: the same, if the surface is farther.
  [[nodiscard]] static Verdict side_near(const Body& body, const Vec3d& p, double radius) {
    if (body.surface->bvh().nearest(p).distance_squared <= 16 * radius * radius) return Verdict::undecided;
    return body.surface->winding(p) < 1 ? Verdict::outside : Verdict::fine;
  }

  void say_of_tile(std::size_t i) {
    const CoverTile& tile = tiles_[i];
    if (!bodies_[i].sound)
      findings_.push_back({fmt::format("{}: {} is no closed, oriented, embedded 2-manifold", tile.place, tile.uri)});
    for (const std::size_t child : tile.children) {
      if (!fits(i, child))
        findings_.push_back(
            {fmt::format("{}: its cell is neither its parent's nor an octant of it", tiles_[child].place)});
    }
  }

  void say_of_scene(std::size_t i) {
    const CoverTile& tile = tiles_[i];
    const Counts& c = counts_[i];
    const auto add = [&](std::uint64_t n, const char* what, Answer answer = Answer::refuted) {
      if (n == 0) return;
      findings_.push_back({fmt::format("{}: {} {} {} triangles of the scene", tile.place, tile.uri, what, n), answer});
    };
    add(c.touching, "is touched by");
    add(c.outside, "leaves outside");
    add(c.undecided, "cannot be decided for", Answer::undecided);
    add(c.bare, "draws nothing for");
    add(c.uncovered, "has no child where there are");
  }

  const std::vector<CoverTile>& tiles_;
  const CoverContents& content_of_;
  std::vector<Body> bodies_;  ///< of the tiles of this share
  std::vector<Counts> counts_;
  std::vector<Numbers> below_;       ///< of each tile, itself included
  std::size_t begin_ = 0, end_ = 0;  ///< tiles of this share
  std::atomic<std::uint64_t> astray_{0};
  std::vector<CoverFinding> findings_;
};

}  // namespace

std::vector<CoverFinding> check_cover(const std::vector<CoverTile>& tiles, const CoverContents& content_of,
                                      TriangleSource& scene, std::uint64_t memory_bytes) {
  return Checker(tiles, content_of).run(scene, memory_bytes);
}

}  // namespace bp
