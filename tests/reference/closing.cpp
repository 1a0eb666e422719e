#include "tests/reference/closing.h"

namespace bp::reference {

namespace {

template <class Body>
void for_each_voxel(const VoxelBox& box, const Body& body) {
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      for (std::int32_t x = box.min.x; x < box.max.x; ++x) body(VoxelCoord{x, y, z});
    }
  }
}

std::int64_t squared_distance(VoxelCoord p, VoxelCoord q) {
  const std::int64_t dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z;
  return dx * dx + dy * dy + dz * dz;
}

/// Chebyshev distance beyond which nothing at scale `s` reaches.
std::int32_t reach(Scale s) {
  return s / kScaleOne + 1;
}

VoxelBox around(VoxelCoord p, std::int32_t r) {
  return VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}}.grown(r);
}

bool in_dilation(const BitBox& solid, StructuringElement element, VoxelCoord p, Scale s) {
  bool met = solid.test(p);  // G is in D also where S = 0 leaves an empty ball
  for_each_voxel(intersect(around(p, reach(s)), solid.box()), [&](VoxelCoord g) {
    if (met || !solid.test(g)) return;
    const std::int32_t r = cube_radius(s);
    const bool in_cube = std::abs(p.x - g.x) <= r && std::abs(p.y - g.y) <= r && std::abs(p.z - g.z) <= r;
    met = element == StructuringElement::cube ? in_cube : squared_distance(p, g) < ball_bound(s);
  });
  return met;
}

bool in_contour(const BitBox& dilation, VoxelCoord q) {
  return !dilation.test(q) && (dilation.test({q.x - 1, q.y, q.z}) || dilation.test({q.x + 1, q.y, q.z}) ||
                               dilation.test({q.x, q.y - 1, q.z}) || dilation.test({q.x, q.y + 1, q.z}) ||
                               dilation.test({q.x, q.y, q.z - 1}) || dilation.test({q.x, q.y, q.z + 1}));
}

}  // namespace

BitBox cut(const BitBox& solid, const VoxelBox& box) {
  BitBox out(box);
  const VoxelBox both = intersect(solid.box(), box);
  for (std::int32_t z = both.min.z; z < both.max.z; ++z) {
    for (std::int32_t y = both.min.y; y < both.max.y; ++y) {
      for (std::int32_t x = both.min.x; x < both.max.x; ++x) {
        if (solid.test({x, y, z})) out.set({x, y, z});
      }
    }
  }
  return out;
}

BitBox dilate(const BitBox& solid, const ScaleLattice& scale, StructuringElement element, const VoxelBox& box) {
  BitBox out(box);
  for_each_voxel(box, [&](VoxelCoord p) {
    if (in_dilation(solid, element, p, scale.at(p))) out.set(p);
  });
  return out;
}

BitBox dilate_oriented(const BitBox& solid, const ScaleLattice& scale, const RotationLattice& rotations,
                       const VoxelBox& box) {
  BitBox out(box);
  for_each_voxel(box, [&](VoxelCoord p) {
    const Scale s = scale.at(p);
    bool met = solid.test(p);
    for_each_voxel(intersect(around(p, oriented_reach(s)), solid.box()), [&](VoxelCoord g) {
      met = met || (solid.test(g) && in_oriented_cube(rotations.at(p), s, p.x - g.x, p.y - g.y, p.z - g.z));
    });
    if (met) out.set(p);
  });
  return out;
}

namespace {

/// E from D, which is known over `box` grown by `far` + 1 voxels.
BitBox erode(const BitBox& solid, const BitBox& dilation, const ScaleLattice& scale, std::int32_t far,
             const VoxelBox& box) {
  BitBox contour(box.grown(far));
  for_each_voxel(box.grown(far), [&](VoxelCoord q) {
    if (in_contour(dilation, q)) contour.set(q);
  });
  BitBox out(box);
  for_each_voxel(box, [&](VoxelCoord p) {
    bool removed = false;
    for_each_voxel(around(p, far), [&](VoxelCoord q) {
      removed = removed || (contour.test(q) && squared_distance(p, q) < ball_bound(scale.at(q)));
    });
    if (solid.test(p) || (dilation.test(p) && !removed)) out.set(p);
  });
  return out;
}

}  // namespace

BitBox close(const BitBox& solid, const ScaleLattice& scale, StructuringElement element, const VoxelBox& box) {
  const std::int32_t far = reach(scale.max);
  return erode(solid, dilate(solid, scale, element, box.grown(far + 1)), scale, far, box);
}

BitBox close_oriented(const BitBox& solid, const ScaleLattice& scale, const RotationLattice& rotations,
                      const VoxelBox& box) {
  const std::int32_t far = reach(scale.max);
  return erode(solid, dilate_oriented(solid, scale, rotations, box.grown(far + 1)), scale, far, box);
}

}  // namespace bp::reference
