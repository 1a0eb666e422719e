#include "tools/run/part_boxes.h"

#include <cmath>

#include "io/scene/part_names.h"
#include "lib/core/error.h"
#include "lib/geometry/triangle_parts.h"
#include "lib/volume/cell_boxes.h"
#include "tools/cli/help/nearest.h"
#include "tools/run/read_again.h"

namespace bp {

namespace {

constexpr double kCells = 256;  // cells along the scene's diagonal
constexpr std::size_t kMostBoxes = 2048;

/// The cells of a grid that triangles touch.
class TouchedCells {
 public:
  /// All triangles must lie within `bounds`.
  TouchedCells(const Bounds3d& bounds, double edge) : origin_(bounds.min), edge_(edge) {
    const VoxelCoord last = cell_of(bounds.max);
    cells_.reset({{0, 0, 0}, {last.x + 1, last.y + 1, last.z + 1}});
  }

  void add(const TriangleD& t) {
    for (const Vec3d& p : t) bounds_.add(p);
    std::vector<TriangleD> left{t};
    while (!left.empty()) {
      const TriangleD part = left.back();
      left.pop_back();
      add_or_cut(part, left);
    }
  }

  [[nodiscard]] bool empty() const { return bounds_.empty(); }

  /// Returns boxes around the cells; around larger cells if there would be too many boxes.
  [[nodiscard]] std::vector<Bounds3d> boxes() const {
    const FewBoxes few = few_boxes_of(cells_, kMostBoxes);
    std::vector<Bounds3d> boxes;
    for (const VoxelBox& box : few.boxes) boxes.push_back(bounds_of(box, edge_ * few.unit));
    return boxes;
  }

 private:
  void add_or_cut(const TriangleD& t, std::vector<TriangleD>& left) {
    Bounds3d b;
    for (const Vec3d& p : t) b.add(p);
    if (b.longest_side() > 2 * edge_) {
      for (const TriangleD& half : halves(t)) left.push_back(half);
      return;
    }
    const VoxelCoord low = cell_of(b.min), high = cell_of(b.max);
    for_each(VoxelBox{low, {high.x + 1, high.y + 1, high.z + 1}}, [&](VoxelCoord c) { cells_.set(c); });
  }

  [[nodiscard]] VoxelCoord cell_of(const Vec3d& p) const {
    VoxelCoord c;
    for (int i = 0; i < 3; ++i) c[i] = std::int32_t(std::floor((p[std::size_t(i)] - origin_[std::size_t(i)]) / edge_));
    return c;
  }

  /// Returns the box of cells, cut to the bounds of the triangles.
  [[nodiscard]] Bounds3d bounds_of(const VoxelBox& cells, double edge) const {
    Bounds3d box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.min[i] = std::max(origin_[i] + edge * cells.min[int(i)], bounds_.min[i]);
      box.max[i] = std::min(origin_[i] + edge * cells.max[int(i)], bounds_.max[i]);
      box.max[i] = std::max(box.min[i], box.max[i]);  // a flat part's cell may end before the part by a rounding
    }
    return box;
  }

  const Vec3d origin_;
  const double edge_;
  BitBox cells_;     // at most kCells + 1 along the scene's diagonal
  Bounds3d bounds_;  // bounds of all triangles
};

[[noreturn]] void refuse(const std::string& pattern, const std::set<std::string>& names) {
  std::string advice = "it names none";
  if (!names.empty()) {
    const std::string near = nearest_word(pattern, {names.begin(), names.end()});
    advice = near.empty() ? "bpinfo lists its names" : fmt::format("did you mean '{}'?", near);
  }
  fail(ErrorCode::bad_input, "no part of the scene has a name or a material that fits '{}'; {}", pattern, advice);
}

}  // namespace

std::vector<Bounds3d> part_boxes(const SceneFiles& scene, const Bounds3d& bounds, const std::string& pattern,
                                 SceneOptions options) {
  options.parts = pattern;
  options.part_names = std::make_shared<PartNames>();
  TouchedCells cells(bounds, std::max(bounds.diagonal() / kCells, 1e-300));
  read_again(scene, bounds, options, [&](const TriangleD& t) { cells.add(t); });
  if (cells.empty()) refuse(pattern, options.part_names->names);
  return cells.boxes();
}

}  // namespace bp
