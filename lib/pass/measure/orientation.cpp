#include "lib/pass/measure/orientation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/triangle_parts.h"
#include "lib/pass/measure/detail/frame_smoothing.h"

namespace bp {

namespace {

using detail::Frame;
using detail::FrameLattice;
using detail::FrameTensor;

constexpr std::int32_t kMostCellsAlong = 32;  ///< cells along an axis
constexpr double kPlaceWeight = 1000;         ///< weight of a frame at a place; 1 is a cell's side full of surface
constexpr double kUpright = 0.99984769515639123915;  ///< cosine of a degree
constexpr double kMerged = 0.99939082701909573001;   ///< cosine of 2 degrees: a cube turned by them looks the same

/// Returns the edge of the smallest allowed cells.
std::int32_t cell_edge(const VoxelBox& voxels, double scale_vox) {
  std::int32_t edge = kScaleStep;
  const auto too_many = [&] {
    for (int axis = 0; axis < 3; ++axis) {
      if (ceil_div(voxels.max[axis], edge) - floor_div(voxels.min[axis], edge) > kMostCellsAlong) return true;
    }
    return false;
  };
  while (edge < scale_vox || too_many()) edge *= 2;
  return edge;
}

FixedQuaternion fixed(const std::array<double, 4>& q) {
  const auto part = [](double x) { return std::int16_t(std::lround(x * (1 << kRotationBits))); };
  return {part(q[0]), part(q[1]), part(q[2]), part(q[3])};
}

/// Adds a little of the whole scene's tensor, for cells with walls of one direction only.
void add_mean(const FrameLattice& lattice, std::vector<FrameTensor>& tensors) {
  constexpr double kShare = 0.02;
  FrameTensor mean;
  double weights = 0;
  for (std::size_t i = 0; i < lattice.count(); ++i) {
    weights += lattice.weight[i];
    for (std::size_t k = 0; k < FrameTensor::kParts; ++k) mean.m[k] += lattice.weight[i] * lattice.known[i].m[k];
  }
  if (!(weights > 0)) return;
  for (FrameTensor& t : tensors) {
    for (std::size_t k = 0; k < FrameTensor::kParts; ++k) t.m[k] += kShare * mean.m[k] / weights;
  }
}

/// Replaces an axis within a degree of one of the grid's by that one: upright parts are closed faster.
Frame upright(Frame frame) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t g = 0; g < 3; ++g) {
      if (std::abs(frame[i][g]) < kUpright) continue;
      Vec3d &axis = frame[i], &next = frame[(i + 1) % 3];
      const double sign = axis[g] < 0 ? -1 : 1;
      axis = {};
      axis[g] = sign;
      next[g] = 0;
      next = (1 / length(next)) * next;
      frame[(i + 2) % 3] = cross(axis, next);
      return frame;
    }
  }
  return frame;
}

/// Gives cells of like frames one rotation: that of the cell with the largest weight.
class Palette {
 public:
  Palette() { add({Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}); }

  /// Returns the number of the nearest rotation within kMerged, or of a new one. Cost: a look at the rotations nearby.
  std::uint16_t index(const Frame& frame) {
    const Place at = place(detail::least_turn(frame));
    double best = kMerged;
    std::size_t found = frames_.size();
    for (int i = 0; i < 27; ++i) {
      const auto near = places_.find({at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1});
      if (near == places_.end()) continue;
      for (const std::uint16_t k : near->second) {
        const double alike = detail::likeness(frame, frames_[k]);
        if (alike < best || (alike == best && k > found)) continue;
        best = alike;
        found = k;
      }
    }
    if (found == frames_.size()) add(frame);
    return std::uint16_t(found);
  }
  [[nodiscard]] const std::vector<FixedQuaternion>& rotations() const { return rotations_; }

 private:
  /// A cell for the last three parts of a quaternion. Rotations within kMerged are in the same cell, or in one next to
  /// it.
  using Place = std::array<int, 3>;
  static Place place(const std::array<double, 4>& q) {
    constexpr double kEdge = 0.022;  // rotations that move each axis by 2 degrees at most are 2.45 degrees apart
    Place p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = int(std::floor(q[i + 1] / kEdge));
    return p;
  }
  void add(const Frame& frame) {
    constexpr double kLeast = 0.8;  // the least turn of any frame has more than 0.85, by a turn of 63 degrees
    for (const auto& q : detail::turns_of(frame)) {
      if (q[0] > kLeast) places_[place(q)].push_back(std::uint16_t(frames_.size()));
    }
    rotations_.push_back(fixed(detail::least_turn(frame)));
    frames_.push_back(frame);
  }

  std::vector<Frame> frames_;
  std::vector<FixedQuaternion> rotations_;
  /// Rotations by place: each is listed for whichever of the 24 turns comes near.
  std::map<Place, std::vector<std::uint16_t>> places_;
};

}  // namespace

struct OrientationMaker::Sums {
  GridFrame frame;
  OrientationField field;  ///< its lattice
  FrameLattice lattice;    ///< `known` holds sums until make() is called

  [[nodiscard]] std::size_t cell_of(const Vec3d& p) const {
    const Vec3d at = frame.to_voxels(p);
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const double cell = std::floor(at[std::size_t(axis)] / field.cell_vox) - field.origin[axis];
      index = index * std::size_t(field.size[axis]) + std::size_t(std::clamp(cell, 0.0, field.size[axis] - 1.0));
    }
    return index;
  }
};

std::int32_t orientation_cell_vox(const StreamHeader& header, double scale_world) {
  if (header.bounds.empty()) fail(ErrorCode::bad_input, "the stream has no scene whose orientation could be made");
  return cell_edge(voxel_bounds(header.frame, header.bounds), scale_world / header.frame.voxel);
}

OrientationMaker::OrientationMaker(const StreamHeader& header, double scale_world) : sums_(std::make_unique<Sums>()) {
  const std::int32_t edge = orientation_cell_vox(header, scale_world);
  const VoxelBox voxels = voxel_bounds(header.frame, header.bounds);
  sums_->frame = header.frame;
  OrientationField& f = sums_->field;
  f.cell_vox = edge;
  for (int axis = 0; axis < 3; ++axis) {
    f.origin[axis] = floor_div(voxels.min[axis], f.cell_vox);
    f.size[axis] = ceil_div(voxels.max[axis], f.cell_vox) - f.origin[axis];
    sums_->lattice.size[std::size_t(axis)] = f.size[axis];
  }
  sums_->lattice.known.resize(sums_->lattice.count());
  sums_->lattice.weight.resize(sums_->lattice.count());
}

OrientationMaker::~OrientationMaker() = default;

void OrientationMaker::add(const TriangleD& triangle) {
  const double edge = sums_->field.cell_vox * sums_->frame.voxel;
  const Vec3d normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double twice = length(normal);
  if (!(twice > 0) || !std::isfinite(twice)) return;
  FrameTensor whole;
  whole.add((1 / twice) * normal, 1);
  struct Part {
    TriangleD corners;
    double weight;  ///< area, in sides of cells
  };
  std::vector<Part> left{{triangle, twice / 2 / (edge * edge)}};
  while (!left.empty()) {
    const auto [t, weight] = left.back();
    left.pop_back();
    const std::size_t apex = apex_of(t);
    if (length_squared(t[(apex + 1) % 3], t[(apex + 2) % 3]) > edge * edge) {
      for (const TriangleD& half : halves(t)) left.push_back({half, weight / 2});
      continue;
    }
    const std::size_t cell = sums_->cell_of((1.0 / 3) * (t[0] + t[1] + t[2]));
    sums_->lattice.weight[cell] += weight;
    for (std::size_t i = 0; i < FrameTensor::kParts; ++i) sums_->lattice.known[cell].m[i] += weight * whole.m[i];
  }
}

void OrientationMaker::add(const Vec3d& at, const std::array<Vec3d, 3>& axes) {
  const std::size_t cell = sums_->cell_of(at);
  sums_->lattice.places = true;
  sums_->lattice.known[cell].add(axes, kPlaceWeight);
  sums_->lattice.weight[cell] += kPlaceWeight;
}

OrientationField OrientationMaker::make() const {
  FrameLattice lattice = sums_->lattice;
  for (std::size_t i = 0; i < lattice.count(); ++i) {
    if (!(lattice.weight[i] > 0)) continue;
    for (double& part : lattice.known[i].m) part /= lattice.weight[i];
  }
  std::vector<FrameTensor> tensors = detail::smoothed(lattice);
  if (!lattice.places) add_mean(lattice, tensors);
  std::vector<Frame> frames(lattice.count());
  parallel_for(std::int64_t(lattice.count()),
               [&](std::int64_t i) { frames[std::size_t(i)] = upright(detail::best_frame(tensors[std::size_t(i)])); });
  std::vector<std::size_t> order(lattice.count());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lattice.weight[a] > lattice.weight[b]; });
  Palette palette;
  OrientationField field = sums_->field;
  field.cells.resize(lattice.count());
  for (const std::size_t i : order) field.cells[i] = palette.index(frames[i]);
  field.rotations = palette.rotations();
  if (std::find(field.cells.begin(), field.cells.end(), 0) == field.cells.end()) {  // all cubes are turned
    field.rotations.erase(field.rotations.begin());
    for (std::uint16_t& cell : field.cells) --cell;
  }
  return field;
}

}  // namespace bp
