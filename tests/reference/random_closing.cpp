#include "tests/reference/random_closing.h"

#include <algorithm>

namespace bp::reference {

namespace {

VoxelCoord random_voxel(Random& random, const VoxelBox& box) {
  return {random.between(box.min.x, box.max.x - 1), random.between(box.min.y, box.max.y - 1),
          random.between(box.min.z, box.max.z - 1)};
}

template <class Inside>
void set_where(BitBox& bits, const VoxelBox& box, const Inside& inside) {
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      for (std::int32_t x = box.min.x; x < box.max.x; ++x) {
        if (inside(VoxelCoord{x, y, z})) bits.set({x, y, z});
      }
    }
  }
}

void add_shape(Random& random, const VoxelBox& box, BitBox& bits) {
  const VoxelCoord c = random_voxel(random, box);
  const std::int32_t r = random.between(1, 5), axis = random.between(0, 2);
  switch (random.between(0, 3)) {
    case 0:  // ball
      return set_where(bits, box, [&](VoxelCoord p) {
        const VoxelCoord d = p - c;
        return d.x * d.x + d.y * d.y + d.z * d.z <= r * r;
      });
    case 1:  // sheet, one voxel thin
      return set_where(bits, box, [&](VoxelCoord p) { return p[axis] == c[axis]; });
    case 2:  // bar, one voxel thick
      return set_where(bits, box, [&](VoxelCoord p) {
        return p[(axis + 1) % 3] == c[(axis + 1) % 3] && p[(axis + 2) % 3] == c[(axis + 2) % 3];
      });
    default:  // two blocks that share a corner only
      return set_where(bits, box, [&](VoxelCoord p) {
        const bool low = p.x < c.x && p.y < c.y && p.z < c.z, high = p.x >= c.x && p.y >= c.y && p.z >= c.z;
        return low || high;
      });
  }
}

}  // namespace

VoxelBox random_box(Random& random, std::int32_t longest) {
  const VoxelCoord min{random.between(-140, 140), random.between(-40, 40), random.between(-40, 40)};
  return {min, min + VoxelCoord{random.between(1, longest), random.between(1, longest), random.between(1, longest)}};
}

BitBox random_solid(Random& random, const VoxelBox& box) {
  BitBox bits(box);
  const std::int32_t kind = random.between(0, 9);
  if (kind == 0) {
    if (random.one_in(2)) set_where(bits, box, [](VoxelCoord) { return true; });
  } else if (kind <= 4) {
    const std::int32_t sparse = 1 << random.between(1, 9);
    set_where(bits, box, [&](VoxelCoord) { return random.one_in(sparse); });
  } else {
    for (std::int32_t i = random.between(1, 4); i > 0; --i) add_shape(random, box, bits);
  }
  return bits;
}

ScaleLattice random_lattice(Random& random, const VoxelBox& box, Scale largest) {
  ScaleLattice lattice;
  for (int axis = 0; axis < 3; ++axis) {
    lattice.origin[axis] = floor_div(box.min[axis], kScaleStep);
    lattice.size[axis] = floor_div(box.max[axis] - 1, kScaleStep) + 2 - lattice.origin[axis];
  }
  const std::int32_t kind = random.between(0, 4), base = random.between(0, largest), other = random.between(0, largest),
                     axis = random.between(0, 2), cut = random.between(0, lattice.size[axis]);
  for (std::int32_t z = 0; z < lattice.size.z; ++z) {
    for (std::int32_t y = 0; y < lattice.size.y; ++y) {
      for (std::int32_t x = 0; x < lattice.size.x; ++x) {
        const std::int32_t at = VoxelCoord{x, y, z}[axis];
        std::int32_t s = base;
        if (kind == 2) s = base + (other - base) * at / lattice.size[axis];
        if (kind == 3) s = at < cut ? base : other;
        if (kind == 4) s = random.between(0, largest);
        lattice.samples.push_back(Scale(s));
      }
    }
  }
  const auto [low, high] = std::minmax_element(lattice.samples.begin(), lattice.samples.end());
  lattice.min = *low;
  lattice.max = *high;
  return lattice;
}

ScaleField random_field(Random& random, const VoxelBox& box, double largest) {
  const VoxelBox around = box.grown(random.between(0, 16));
  const auto length = [&] { return largest * random.between(0, 64) / 64; };
  const auto point = [&] {
    const VoxelCoord p = random_voxel(random, around);
    return Vec3d{p.x + 0.5, p.y + 0.5, p.z + 0.5};
  };
  ScaleField field;
  field.base = length() / 2;
  for (std::int32_t i = random.between(0, 2); i > 0; --i) {
    const Vec3d a = point(), b = point();
    Vec3d min{}, max{};
    for (std::size_t k = 0; k < 3; ++k) {
      min[k] = std::min(a[k], b[k]);
      max[k] = std::max(a[k], b[k]);
    }
    field.rules.push_back(box_rule(min, max, length()));
  }
  for (std::int32_t i = random.between(0, 3); i > 0; --i) {
    const auto mode = ScaleMode(random.between(1, 3));
    field.rules.push_back(stroke_rule(mode, point(), double(random.between(0, 20)), length(), field.base));
  }
  for (std::int32_t i = random.between(0, 2); i > 0; --i) {
    ScaleRule rule;
    rule.mode = ScaleMode(random.between(0, 3));
    for (std::int32_t k = random.between(1, 3); k > 0; --k) rule.points.push_back(point());
    rule.radius = random.between(0, 12);
    rule.scale = length();
    if (random.between(0, 3) == 0) {
      rule.shape = ScaleShape::view;
      if (rule.mode == ScaleMode::erase) rule.mode = ScaleMode::increase;
      rule.per_distance = field.slope * random.between(0, 8) / 8;
    }
    field.rules.push_back(rule);
  }
  return field;
}

RotationLattice random_rotations(Random& random, const VoxelBox& box) {
  RotationLattice r;
  for (int axis = 0; axis < 3; ++axis) {
    r.origin[axis] = floor_div(box.min[axis], kScaleStep);
    r.size[axis] = floor_div(box.max[axis] - 1, kScaleStep) + 1 - r.origin[axis];
  }
  const std::int32_t kind = random.between(0, 3), finest = kind == 1 ? 1 : 100;
  const auto any = [&] {
    const auto part = [&] { return double(random.between(-finest, finest)); };
    return rotation_of(part() + 0.01, part(), part(), part());
  };
  const Rotation one = kind == 0 ? Rotation{} : any();
  for (std::int32_t i = r.size.x * r.size.y * r.size.z; i > 0; --i) r.cells.push_back(kind == 3 ? any() : one);
  return r;
}

OrientationField random_orientation(Random& random, const VoxelBox& box) {
  OrientationField f;
  f.cell_vox = random.one_in(2) ? 8 : 16;
  for (int axis = 0; axis < 3; ++axis) {
    f.origin[axis] = floor_div(box.min[axis], f.cell_vox) + (random.one_in(4) ? 1 : 0);
    f.size[axis] = std::max(1, ceil_div(box.max[axis], f.cell_vox) - f.origin[axis]);
  }
  const std::int32_t count = f.size.x * f.size.y * f.size.z, kind = random.between(0, 6);
  for (std::int32_t i = kind < 3 ? 1 : random.between(2, 9); i > 0; --i) {
    const std::int32_t finest = kind == 0 ? 1 : 12000;  // 1: near a turn of the cube onto itself
    const auto part = [&] { return std::int16_t(random.between(-finest, finest) * (12000 / finest)); };
    FixedQuaternion q{std::int16_t(16000), part(), part(), part()};
    if (kind == 1 || kind >= 5) q.x = 0, (kind == 6 ? q.z : q.y) = 0;  // about y or z alone
    f.rotations.push_back(q);
  }
  for (std::int32_t i = 0; i < count; ++i)
    f.cells.push_back(std::uint16_t(random.between(0, std::int32_t(f.rotations.size()) - 1)));
  return f;
}

}  // namespace bp::reference
