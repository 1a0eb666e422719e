#include "tools/run/part_boxes.h"

#include <cmath>
#include <set>

#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "tools/run/read_again.h"

namespace bp {

namespace {

constexpr double kCells = 256;  // along the scene's diagonal
constexpr std::size_t kMostBoxes = 2048;

using Cell = std::array<std::int64_t, 3>;  // z, y, x

/// Cells of the space that triangles touch.
class TouchedCells {
 public:
  TouchedCells(const Vec3d& origin, double edge) : origin_(origin), edge_(edge) {}

  void add(const TriangleD& t) {
    for (const Vec3d& p : t) bounds_.add(p);
    std::vector<TriangleD> left{t};
    while (!left.empty()) {
      const TriangleD part = left.back();
      left.pop_back();
      add_or_cut(part, left);
    }
  }

  [[nodiscard]] bool empty() const { return cells_.empty(); }

  /// Boxes of the cells; larger cells where these would be too many.
  [[nodiscard]] std::vector<Bounds3d> boxes() {
    std::vector<Bounds3d> found = merged();
    while (found.size() > kMostBoxes) {
      std::set<Cell> larger;
      for (const Cell& c : cells_) larger.insert({c[0] >> 1, c[1] >> 1, c[2] >> 1});
      cells_ = std::move(larger);
      edge_ *= 2;
      found = merged();
    }
    return found;
  }

 private:
  void add_or_cut(const TriangleD& t, std::vector<TriangleD>& left) {
    Bounds3d b;
    for (const Vec3d& p : t) b.add(p);
    const Cell low = cell_of(b.min), high = cell_of(b.max);
    if (b.longest_side() > 2 * edge_) {
      std::size_t k = 0;
      const auto edge = [&](std::size_t i) { return length(t[(i + 1) % 3] - t[i]); };
      for (std::size_t i = 1; i < 3; ++i) {
        if (edge(i) > edge(k)) k = i;
      }
      const Vec3d middle = 0.5 * (t[k] + t[(k + 1) % 3]);
      left.push_back({t[k], middle, t[(k + 2) % 3]});
      left.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
      return;
    }
    for (Cell c = low; c[0] <= high[0]; ++c[0]) {
      for (c[1] = low[1]; c[1] <= high[1]; ++c[1]) {
        for (c[2] = low[2]; c[2] <= high[2]; ++c[2]) cells_.insert(c);
      }
    }
  }

  [[nodiscard]] Cell cell_of(const Vec3d& p) const {
    Cell c{};
    for (std::size_t i = 0; i < 3; ++i) c[2 - i] = std::int64_t(std::floor((p[i] - origin_[i]) / edge_));
    return c;
  }

  /// Rows of cells, rows beside each other as plates, plates on each other as boxes.
  [[nodiscard]] std::vector<Bounds3d> merged() const {
    std::set<Cell> left = cells_;
    std::vector<Bounds3d> boxes;
    while (!left.empty()) {
      const Cell first = *left.begin();
      Cell size{1, 1, 1};
      for (const std::size_t axis : {2, 1, 0}) {
        while (holds_next(left, first, size, axis)) ++size[axis];
      }
      for_each(first, size, [&](const Cell& c) { left.erase(c); });
      boxes.push_back(box_of(first, size));
    }
    return boxes;
  }

  template <class Body>
  static void for_each(const Cell& first, const Cell& size, const Body& body) {
    for (std::int64_t z = 0; z < size[0]; ++z) {
      for (std::int64_t y = 0; y < size[1]; ++y) {
        for (std::int64_t x = 0; x < size[2]; ++x) body({first[0] + z, first[1] + y, first[2] + x});
      }
    }
  }

  static bool holds_next(const std::set<Cell>& cells, Cell first, Cell size, std::size_t axis) {
    first[axis] += size[axis];
    size[axis] = 1;
    bool all = true;
    for_each(first, size, [&](const Cell& c) { all = all && cells.contains(c); });
    return all;
  }

  /// Not beyond the triangles.
  [[nodiscard]] Bounds3d box_of(const Cell& first, const Cell& size) const {
    Bounds3d box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.min[i] = std::max(origin_[i] + edge_ * double(first[2 - i]), bounds_.min[i]);
      box.max[i] = std::min(origin_[i] + edge_ * double(first[2 - i] + size[2 - i]), bounds_.max[i]);
      box.max[i] = std::max(box.min[i], box.max[i]);  // of a flat part, whose cell may end before it by a rounding
    }
    return box;
  }

  const Vec3d origin_;
  double edge_;
  std::set<Cell> cells_;
  Bounds3d bounds_;  // of all triangles
};

}  // namespace

std::vector<Bounds3d> part_boxes(const SceneFiles& scene, const Bounds3d& bounds, const std::string& pattern) {
  TouchedCells cells(bounds.min, std::max(bounds.diagonal() / kCells, 1e-300));
  read_again(scene, bounds, pattern, [&](const TriangleD& t) { cells.add(t); });
  if (cells.empty())
    fail(ErrorCode::bad_input, "no part of the scene has a name or a material that fits '{}'", pattern);
  return cells.boxes();
}

}  // namespace bp
