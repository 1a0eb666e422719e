#include "lib/check/detail/hidden.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "lib/closing/closing.h"
#include "lib/closing/closing_scratch.h"
#include "lib/core/parallel.h"
#include "lib/exact/predicates.h"
#include "lib/grid/brick_voxels.h"
#include "lib/volume/dilate.h"
#include "lib/volume/entered.h"
#include "lib/voxel/voxelize.h"

namespace bp {

namespace {

// Sets of voxels in memory at most: while R is found, the touched ones, the closing, O, its copy, what the closing
// adds, the rooms, and the gaps or a copy of a front; and one for the tiles of the closing.
constexpr std::int64_t kSetsAtOnce = 8;
constexpr std::int32_t kTile = 192;          // voxels; tiles of the closing
constexpr double kMostScaleVox = 4000;       // largest scale of a closing, voxels
constexpr double kMostWideVoxels = 1 << 20;  // along a side
constexpr double kMostFineVoxels = 1 << 12;  // as kMostWideVoxels, if vertices are no lattice points: 2^28 units

using Corners = std::array<LatticeCoord, 3>;

/// Sets a = f(a, b), word by word; the boxes must be equal.
void combine(BitBox& a, const BitBox& b, std::uint64_t (*f)(std::uint64_t, std::uint64_t)) {
  for (std::int64_t i = 0; i < a.word_count(); ++i) a.data()[i] = f(a.data()[i], b.data()[i]);
}
std::uint64_t both(std::uint64_t a, std::uint64_t b) {
  return a & b;
}
std::uint64_t either(std::uint64_t a, std::uint64_t b) {
  return a | b;
}
std::uint64_t less(std::uint64_t a, std::uint64_t b) {
  return a & ~b;
}
BitBox inverse(BitBox a) {
  for (std::int64_t i = 0; i < a.word_count(); ++i) a.data()[i] = ~a.data()[i];
  return a;
}

BitBox closing_of(const BitBox& voxels, const HidingRecipe& recipe) {
  ScaleField field;
  field.base = recipe.scale_world;
  const VoxelBox& box = voxels.box();
  BitBox all(box);
  const VoxelCoord size = box.size();
  const VoxelCoord tiles{ceil_div(size.x, kTile), ceil_div(size.y, kTile), ceil_div(size.z, kTile)};
  parallel_for(std::int64_t(tiles.x) * tiles.y * tiles.z, [&](std::int64_t i) {
    const VoxelCoord at{std::int32_t(i % tiles.x), std::int32_t(i / tiles.x % tiles.y),
                        std::int32_t(i / tiles.x / tiles.y)};
    const VoxelCoord min = box.min + at * kTile;
    const VoxelBox tile = intersect(box, VoxelBox{min, min + VoxelCoord{kTile, kTile, kTile}});
    const Halo halo = halo_of(tile, field, recipe.frame);
    BitBox around(tile.grown(halo.total_vox())), closed;
    copy_voxels(voxels, around);
    ClosingScratch scratch;
    close_tile(around, field.sample(recipe.frame, tile.grown(halo.erosion_vox)), halo, {recipe.element}, tile, closed,
               scratch);
    copy_voxels(closed, all);  // tiles consist of whole words
  });
  return all;
}

/// Returns the added voxels in gaps: in lines of at most `longest` of them along an axis, between two touched voxels.
BitBox gaps_of(const BitBox& added, const BitBox& touched, std::int32_t longest) {
  BitBox gaps(added.box());
  const VoxelBox& box = added.box();
  for (int axis = 0; axis < 3; ++axis) {
    VoxelBox lines = box;  // their first voxels
    lines.max[axis] = lines.min[axis] + 1;
    for_each(lines, [&](VoxelCoord p) {
      std::int32_t since = -1;  // voxels of the line since a touched one; negative: others lie between
      for (; p[axis] < box.max[axis]; ++p[axis]) {
        if (added.test(p)) {
          since += since >= 0;
          continue;
        }
        const bool is_wall = touched.test(p);
        VoxelCoord q = p;
        for (std::int32_t k = 0; is_wall && since <= longest && k < since; ++k) {
          --q[axis];
          gaps.set(q);
        }
        since = is_wall ? 0 : -1;
      }
    });
  }
  return gaps;
}

/// Returns the set R: what the closing adds nearer to the rooms than to `outside`, which is the set O.
BitBox behind_openings(const BitBox& closing, const BitBox& touched, BitBox outside, const HidingRecipe& recipe) {
  BitBox added = closing, rooms = closing;
  combine(added, touched, less);
  combine(rooms, outside, either);
  rooms = inverse(std::move(rooms));
  const double scale = recipe.scale_world / recipe.frame.voxel;
  combine(added, gaps_of(added, touched, std::int32_t(2 * std::sqrt(2.0) * scale)), less);
  const std::int32_t steps = 2 * std::int32_t(std::ceil(scale));
  for (std::int32_t step = 0; step < steps; ++step) {
    bool any = dilate_over_faces(added, outside);
    combine(added, outside, less);
    any |= dilate_over_faces(added, rooms);
    combine(added, rooms, less);
    if (!any) break;
  }
  combine(rooms, closing, both);
  return rooms;
}

/// Returns the hidden voxels by their definition, in a box with an empty border. `body`: reach of one that enters.
BitBox hidden_voxels(const BitBox& touched, const HidingRecipe& recipe, VoxelCoord body) {
  BitBox closing = closing_of(touched, recipe);
  BitBox reached(touched.box());
  reached.set(touched.box().min);
  std::optional<BitBox> entered;  // the set P
  if (recipe.body_world > 0) {
    entered = entered_voxels(touched, body);
    combine(reached, *entered, either);
    combine(reached, closing, less);
  }
  grow_within(inverse(closing), reached);  // the set O
  BitBox rooms = behind_openings(closing, touched, reached, recipe);
  BitBox open = std::move(closing);
  combine(open, reached, either);
  combine(open, touched, less);
  combine(open, rooms, less);
  rooms = {};
  for (BitBox* const set : {&open, &reached}) {
    if (entered) combine(*set, *entered, either);
  }
  grow_within(open, reached);  // the set O'
  BitBox seen = reached;
  for (int layer = 0; layer < 2; ++layer) {
    dilate(seen, 1);
    combine(seen, touched, both);
  }
  combine(seen, reached, either);
  return inverse(std::move(seen));
}

/// Returns whether the voxel, the scale and the body of a recipe are such that its sets can be made.
bool is_in_range(const HidingRecipe& r) {
  const auto may_be = [&](double length, double most_vox) { return length >= 0 && length <= most_vox * r.frame.voxel; };
  return r.frame.voxel > 0 && may_be(r.scale_world, kMostScaleVox) && may_be(r.body_world, kMostBodyVox);
}

class HiddenCheck {
 public:
  HiddenCheck(const WeldedMesh& mesh, const Surface& surface, TriangleSource& walls, const HidingRecipe& recipe,
              std::size_t max_examples)
      : mesh_(mesh), surface_(surface), walls_(walls), recipe_(recipe), max_examples_(max_examples) {}

  HiddenReport run(std::uint64_t memory_bytes) {
    if (!find_corners() || !find_box(memory_bytes)) return std::move(report_);
    const std::int64_t slack = fixed_slack(recipe_.frame, report_.off);
    check(slack);
    if (slack != kFixedSlack && report_.exposed.count > 0) {
      report_.exposed = {};
      check(kFixedSlack);
      if (report_.exposed.count == 0 && report_.undecided.empty())
        undecided(
            fmt::format("coordinates are read to within {:.2g}, and only as read is the proxy hidden", report_.off));
    }
    return std::move(report_);
  }

 private:
  /// `slack`: that voxels are grown by when they are tested for triangles.
  void check(std::int64_t slack) {
    const BitBox hidden = hidden_voxels(touched_voxels(slack), recipe_, body_);
    check_faces(hidden);
    check_swallowed(hidden);
  }

  bool undecided(std::string why) {
    report_.undecided = std::move(why);
    return false;
  }

  bool find_corners() {
    const GridFrame& frame = recipe_.frame;
    if (!is_in_range(recipe_)) return undecided("the voxel, scale or body that the file names is out of range");
    if (round_corners(kMostWideVoxels)) {
      const bool exact = std::equal(corners_.begin(), corners_.end(), mesh_.points.begin(),
                                    [&](const LatticeCoord& l, const Vec3d& p) { return frame.world(l) == p; });
      if (exact) return true;
      per_voxel_ = kFixedOne, slack_ = 1;
      if (round_corners(kMostFineVoxels)) return true;
    }
    return undecided("the proxy lies far from the voxels that the file names");
  }

  /// Rounds corners to the nearest unit: by half of a unit, and by less than 2^-10 of one in the double arithmetic
  /// before.
  bool round_corners(double most_voxels) {
    corners_.clear();
    for (const Vec3d& p : mesh_.points) {
      LatticeCoord l;
      for (int i = 0; i < 3; ++i) {
        const double x = p[std::size_t(i)] / recipe_.frame.voxel - double(recipe_.frame.origin[std::size_t(i)]);
        if (!(std::abs(x) < most_voxels)) return false;
        l[i] = std::llround(x * double(per_voxel_));
      }
      corners_.push_back(l);
    }
    return true;
  }

  /// Finds the box of the scene, with room for the closing and for the outside.
  bool find_box(std::uint64_t memory_bytes) {
    Bounds3d bounds;
    walls_.rewind();
    for (std::vector<TriangleD> chunk; walls_.read(chunk);) {
      report_.triangles += chunk.size();
      for (const TriangleD& t : chunk)
        for (const Vec3d& p : t) bounds.add(p);
    }
    if (bounds.empty()) return undecided("no triangle of the scene hides anything");
    report_.off = walls_.counts().rounding.of(bounds);
    if (fixed_slack(recipe_.frame, report_.off) > kMostFixedSlack)
      return undecided(fmt::format("coordinates are read to within {:.2g}, too much for these voxels", report_.off));
    for (const Vec3d& p : {bounds.min, bounds.max}) {
      for (const double x : recipe_.frame.to_voxels(p))
        if (!(std::abs(x) < kMostWideVoxels))
          return undecided("the scene reaches far beyond the voxels that the file names");
    }
    box_ = voxel_bounds(recipe_.frame, bounds);
    body_ = body_reach(recipe_.frame, recipe_.body_world, box_.size());
    box_ = box_for_bodies(box_, body_, std::int32_t(std::ceil(recipe_.scale_world / recipe_.frame.voxel)) + 2);
    box_.min.x = floor_div(box_.min.x, 64) * 64;  // whole words, as sets of voxels have them
    box_.max.x = ceil_div(box_.max.x, 64) * 64;
    const VoxelCoord size = box_.size();
    const double bytes = double(kSetsAtOnce + (recipe_.body_world > 0)) / 8 * size.x * size.y * size.z;
    if (bytes <= double(memory_bytes)) return true;
    report_.memory_bytes = std::uint64_t(bytes);
    return undecided(fmt::format("the voxels take {} MiB, and the limit on memory leaves {} MiB for them",
                                 std::uint64_t(bytes) / (1 << 20) + 1, memory_bytes >> 20));
  }

  BitBox touched_voxels(std::int64_t slack) {
    BitBox touched(box_);
    std::vector<FixedTriangle> fixed;
    walls_.rewind();
    for (std::vector<TriangleD> chunk; walls_.read(chunk);) {
      fixed.clear();
      for (const TriangleD& t : chunk) fixed.push_back(to_fixed(recipe_.frame, t));
      voxelize_surface(fixed, touched, slack);
    }
    return touched;
  }

  /// Checks that no face of the proxy has a point in the open cube of a voxel that is not hidden.
  void check_faces(const BitBox& hidden) {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      Corners corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = corners_[mesh_.triangles[t][k]];
      std::optional<VoxelCoord> met;
      for_each_near(corners, [&](VoxelCoord v) {
        if (met || hidden.test(v) || !meets_open_voxel(corners, v, per_voxel_, slack_)) return;
        if (meets_open_voxel(corners, v, per_voxel_, -slack_))
          met = v;
        else
          is_near_ = true;
      });
      if (met) report_.exposed.add({mesh_.number[t], 0, middle_of(*met)}, max_examples_);
    }
    if (is_near_ && report_.exposed.count == 0)
      undecided("the proxy comes as near to a voxel that is not hidden as its vertices are rounded");
  }

  /// Calls f for the voxels that the triangle may meet.
  void for_each_near(const Corners& t, const std::function<void(VoxelCoord)>& f) const {
    VoxelBox box;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t low = std::min({t[0][i], t[1][i], t[2][i]}), high = std::max({t[0][i], t[1][i], t[2][i]});
      box.min[i] = std::int32_t(floor_div<std::int64_t>(low, per_voxel_)) - 1;
      box.max[i] = std::int32_t(floor_div<std::int64_t>(high, per_voxel_)) + 2;
    }
    for (std::int32_t z = box.min.z; z < box.max.z; ++z) {  // layer by layer, as the box of a large triangle is large
      BitBox layer(VoxelBox{{box.min.x, box.min.y, z}, {box.max.x, box.max.y, z + 1}});
      const FixedTriangle one{fixed(t[0]), fixed(t[1]), fixed(t[2])};
      voxelize_surface({&one, 1}, layer);
      for_each_voxel(layer, f);
    }
  }

  /// Checks that no voxel that is not hidden lies within the proxy. The surface meets no such open cube. So two of
  /// these voxels that share a face lie on one side, unless a triangle lies in the plane of that face: such voxels are
  /// tested one by one. If vertices were rounded, the surface does not come near to such a face.
  void check_swallowed(const BitBox& hidden) {
    if (report_.exposed.count > 0 || is_near_) return;  // the sides are not known
    const BitBox others = inverse(hidden), along = beside_level_faces(others.box());
    BitBox open = others, outside(others.box());
    combine(open, along, less);
    const VoxelCoord corner = others.box().min;
    if (open.test(corner) && surface_.winding(middle_of(corner)) == 0) outside.set(corner);
    grow_within(open, outside);
    open = others;
    combine(open, outside, less);
    for_each_voxel(open, [&](VoxelCoord v) {
      if (report_.exposed.count > max_examples_) return;  // it is refuted
      const Vec3d middle = middle_of(v);
      if (surface_.winding(middle) != 0) report_.exposed.add({0, 0, middle}, max_examples_);
    });
  }

  /// Returns the voxels that share a point with a triangle in a plane between voxels.
  [[nodiscard]] BitBox beside_level_faces(const VoxelBox& box) const {
    BitBox beside(box);
    if (slack_ > 0) return beside;
    for (const auto& triangle : mesh_.triangles) {
      const LatticeCoord &a = corners_[triangle[0]], &b = corners_[triangle[1]], &c = corners_[triangle[2]];
      for (int i = 0; i < 3; ++i) {
        if (a[i] != b[i] || b[i] != c[i] || a[i] % kLatticePerVoxel != 0) continue;
        const FixedTriangle one{fixed(a), fixed(b), fixed(c)};
        voxelize_surface({&one, 1}, beside);
        break;
      }
    }
    return beside;
  }

  [[nodiscard]] FixedPoint fixed(const LatticeCoord& p) const {
    const std::int64_t unit = kFixedOne / per_voxel_;
    return {p.x * unit, p.y * unit, p.z * unit};
  }

  [[nodiscard]] Vec3d middle_of(VoxelCoord v) const {
    constexpr std::int64_t kUnit = kLatticePerVoxel;
    return recipe_.frame.world({v.x * kUnit + kUnit / 2, v.y * kUnit + kUnit / 2, v.z * kUnit + kUnit / 2});
  }

  const WeldedMesh& mesh_;
  const Surface& surface_;
  TriangleSource& walls_;
  const HidingRecipe& recipe_;
  VoxelCoord body_{};  ///< reach of the body that enters
  const std::size_t max_examples_;
  std::vector<LatticeCoord> corners_;  // per_voxel_ units are a voxel
  std::int64_t per_voxel_ = kLatticePerVoxel;
  std::int64_t slack_ = 0;  // error of corners, units
  bool is_near_ = false;    // a face may meet a voxel that is not hidden
  VoxelBox box_;
  HiddenReport report_;
};

using Wide = int128;

Wide lattice_dot(const LatticeCoord& a, const LatticeCoord& b) {
  return Wide(a.x) * b.x + Wide(a.y) * b.y + Wide(a.z) * b.z;
}
LatticeCoord lattice_cross(const LatticeCoord& a, const LatticeCoord& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns whether the triangle lies on one side of the open cube (-half, half)^3 along the axis.
bool parts(const Corners& t, const LatticeCoord& axis, std::int64_t half) {
  const Wide reach = half * (Wide(std::abs(axis.x)) + std::abs(axis.y) + std::abs(axis.z));
  if (reach == 0) return false;
  const Wide a = lattice_dot(t[0], axis), b = lattice_dot(t[1], axis), c = lattice_dot(t[2], axis);
  return std::min({a, b, c}) >= reach || std::max({a, b, c}) <= -reach;
}

}  // namespace

bool meets_open_voxel(const Corners& triangle, VoxelCoord voxel, std::int64_t per_voxel, std::int64_t grow) {
  const std::int64_t half = per_voxel + 2 * grow;  // half a unit is 1 here
  Corners t;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) t[k][i] = 2 * triangle[k][i] - (2 * std::int64_t(voxel[i]) + 1) * per_voxel;
  }
  const LatticeCoord units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const LatticeCoord& unit : units)
    if (parts(t, unit, half)) return false;
  const LatticeCoord edges[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  if (parts(t, lattice_cross(edges[0], edges[1]), half)) return false;
  for (const LatticeCoord& edge : edges) {
    for (const LatticeCoord& unit : units)
      if (parts(t, lattice_cross(edge, unit), half)) return false;
  }
  return true;
}

HiddenReport check_hidden(const WeldedMesh& mesh, const Surface& surface, TriangleSource& walls,
                          const HidingRecipe& recipe, std::size_t max_examples, std::uint64_t memory_bytes) {
  return HiddenCheck(mesh, surface, walls, recipe, max_examples).run(memory_bytes);
}

}  // namespace bp
