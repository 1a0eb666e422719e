#include "lib/grid/orientation_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace bp {

Rotation rotation_of(double w, double x, double y, double z) {
  const double n = w * w + x * x + y * y + z * z;
  const double m[3][3] = {{n - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                          {2 * (x * y + z * w), n - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                          {2 * (x * z - y * w), 2 * (y * z + x * w), n - 2 * (x * x + y * y)}};
  Rotation r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r.row[i][j] = std::int16_t(std::lround(m[i][j] / n * (1 << kRotationBits)));
  }
  return r;
}

Rotation rotation_of(const FixedQuaternion& q) {
  return rotation_of(q.w, q.x, q.y, q.z);
}

Rotation canonical(const Rotation& r) {
  std::array<std::array<int, 3>, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rows[i][j] = r.row[i][j];
    const auto first = std::find_if(rows[i].begin(), rows[i].end(), [](int x) { return x != 0; });
    if (first != rows[i].end() && *first < 0) {
      for (int& x : rows[i]) x = -x;
    }
  }
  std::sort(rows.begin(), rows.end(), std::greater<>());
  Rotation out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out.row[i][j] = std::int16_t(rows[i][j]);
  }
  return out;
}

std::size_t OrientationField::index_at(VoxelCoord p) const {
  std::size_t at = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const std::int32_t i = std::clamp(floor_div(p[axis], cell_vox) - origin[axis], 0, size[axis] - 1);
    at = at * std::size_t(size[axis]) + std::size_t(i);
  }
  return cells[at];
}

OrientationField each_cube_once(const OrientationField& field) {
  OrientationField out = field;
  out.rotations.clear();
  std::map<Rotation, std::uint16_t> cubes;
  std::vector<std::uint16_t> of_rotation;
  for (const FixedQuaternion& q : field.rotations) {
    const auto [found, fresh] = cubes.try_emplace(canonical(rotation_of(q)), std::uint16_t(out.rotations.size()));
    if (fresh) out.rotations.push_back(q);
    of_rotation.push_back(found->second);
  }
  for (std::uint16_t& cell : out.cells) cell = of_rotation[cell];
  return out;
}

const char* orientation_fault(const OrientationField& f) {
  if (f.cell_vox < kScaleStep || f.cell_vox % kScaleStep != 0 || f.cell_vox > 1 << 26)
    return "the cells of the orientation are no multiple of 8 voxels";
  std::uint64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (f.size[axis] < 1 || std::uint32_t(f.size[axis]) > OrientationField::kMostCells)
      return "the orientation has too few or too many cells";
    if (std::abs(std::int64_t(f.origin[axis])) > (std::int64_t(1) << 28)) return "the orientation lies beyond the grid";
    count *= std::uint64_t(f.size[axis]);
    if (count > OrientationField::kMostCells) return "the orientation has too few or too many cells";
  }
  if (f.cells.size() != count) return "the orientation has too few or too many cells";
  if (f.rotations.empty() || f.rotations.size() > OrientationField::kMostRotations)
    return "the orientation has no rotation, or too many";
  for (const FixedQuaternion& q : f.rotations) {
    const auto n =
        std::int64_t(q.w) * q.w + std::int64_t(q.x) * q.x + std::int64_t(q.y) * q.y + std::int64_t(q.z) * q.z;
    if (n < (std::int64_t(1) << (2 * kRotationBits - 1))) return "a quaternion of the orientation is shorter than 0.7";
  }
  if (std::any_of(f.cells.begin(), f.cells.end(), [&](std::uint16_t i) { return i >= f.rotations.size(); }))
    return "a cell of the orientation names a rotation that is not there";
  return nullptr;
}

}  // namespace bp
