// For any voxels, enclosed set and target: the proxy is closed, oriented, 2-manifold, embedded and strictly encloses
// the set, by the independent check.
#include <algorithm>
#include <cmath>

#include "lib/check/check_proxy.h"
#include "lib/closing/closing_scratch.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using reference::Random;

namespace {

/// Straddles seams between bricks on all axes.
constexpr VoxelBox kBox{{57, -6, 55}, {71, 7, 69}};
constexpr VoxelCoord kCentre{64, 0, 62};

/// Two triangles that span the open cube of each voxel with an empty neighbour: all but 1/128 of its width.
test::Triangles triangles_in(const BitBox& bits) {
  test::Triangles triangles;
  const VoxelBox& box = bits.box();
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z) {
    for (p.y = box.min.y; p.y < box.max.y; ++p.y) {
      for (p.x = box.min.x; p.x < box.max.x; ++p.x) {
        if (!bits.test(p)) continue;
        bool hidden = true;
        for (int axis = 0; axis < 3; ++axis) {
          VoxelCoord below = p, above = p;
          --below[axis];
          ++above[axis];
          hidden = hidden && bits.test(below) && bits.test(above);
        }
        if (hidden) continue;
        const double l = 1.0 / 128, h = 1 - l;
        const auto at = [&](double dx, double dy, double dz) { return Vec3d{p.x + dx, p.y + dy, p.z + dz}; };
        triangles.push_back({at(l, l, l), at(h, h, l), at(l, h, h)});
        triangles.push_back({at(h, l, h), at(h, l, l), at(l, l, h)});
      }
    }
  }
  return triangles;
}

BitBox closing_of(const BitBox& solid, const VoxelBox& box, StructuringElement element, Scale scale) {
  ScaleLattice lattice;
  const std::int32_t reach = scale / kScaleOne + 2;
  const VoxelBox around = box.grown(reach);
  for (int axis = 0; axis < 3; ++axis) {
    lattice.origin[axis] = floor_div(around.min[axis], kScaleStep);
    lattice.size[axis] = floor_div(around.max[axis] - 1, kScaleStep) + 2 - lattice.origin[axis];
  }
  lattice.samples.assign(std::size_t(lattice.size.x) * std::size_t(lattice.size.y) * std::size_t(lattice.size.z),
                         scale);
  lattice.min = lattice.max = scale;
  ClosingScratch scratch;
  BitBox closed;
  close_tile(solid, lattice, {reach, reach}, {element}, box, closed, scratch);
  return closed;
}

std::string name_of(const MeshParams& params) {
  const std::string enclose = params.enclose == Enclose::closing ? "closing"
                              : params.enclose == Enclose::input ? "input"
                                                                 : "scene";
  return params.tighten ? enclose : "not tightened";
}

void check_sound(const LatticeMesh& proxy, test::Triangles inner) {
  test::MemorySource scene(std::move(inner));
  CheckOptions options;
  options.distances = false;
  const CheckReport r = check_proxy(test::indexed(proxy), &scene, options);
  CAPTURE(r.triangles, r.boundary_edges.count, r.misoriented_edges.count, r.nonmanifold_edges.count,
          r.nonmanifold_vertices.count, r.degenerate_triangles.count, r.duplicate_triangles.count,
          r.inverted_components.count, r.self_intersections.count, r.touching.count, r.outside.count);
  CHECK(r.holds());
}

/// Meshes and checks: `inner` must stay inside each level, and each level inside the next.
void check_levels(const VoxelBox& box, const BitBox& solid, const BitBox& closing, const MeshParams& params,
                  const test::Triangles& inner) {
  test::VoxelSource source(
      box, [&](VoxelCoord p) { return solid.test(p); }, [&](VoxelCoord p) { return closing.test(p); });
  // Bounds of a larger scene, so that without a target the stop of [CB17] lets the surface move by two voxels.
  source.header().bounds.add({box.min.x + 200.0, double(box.min.y), double(box.min.z)});
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, test::memory_context(), params, counts);
  CAPTURE(name_of(params), params.faces, params.error_world);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    CAPTURE(i);
    check_sound(levels[i], inner);
    if (i > 0) check_sound(levels[i], world_triangles(levels[i - 1]));
  }
}

struct Target {
  std::vector<std::uint64_t> faces;
  double error_vox = 0;
};

/// Checks all enclosed sets, with and without tightening, to each target.
void check_all_modes(const BitBox& solid, const BitBox& closing, std::initializer_list<Target> targets) {
  if (solid.count() == 0) return;
  const test::Triangles in_solid = triangles_in(solid), in_closing = triangles_in(closing);
  MeshParams params;
  for (const Target& target : targets) {
    params.faces = target.faces;
    params.error_world = target.error_vox;  // a voxel is 1 wide
    params.tighten = false;
    params.enclose = Enclose::closing;
    check_levels(kBox, solid, closing, params, in_closing);
    params.tighten = true;
    check_levels(kBox, solid, closing, params, in_closing);
    params.enclose = Enclose::input;
    check_levels(kBox, solid, closing, params, in_solid);
    params.enclose = Enclose::scene;
    params.scene = in_solid;
    check_levels(kBox, solid, closing, params, in_solid);
    params.scene.clear();
  }
}

void add_voxels(const BitBox& from, const VoxelBox& box, BitBox& to) {
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z) {
    for (p.y = box.min.y; p.y < box.max.y; ++p.y) {
      for (p.x = box.min.x; p.x < box.max.x; ++p.x) {
        if (from.test(p)) to.set(p);
      }
    }
  }
}

struct Shape {
  const char* name;
  test::Solid inside;
};

std::int32_t squared(VoxelCoord d) {
  return d.x * d.x + d.y * d.y + d.z * d.z;
}
bool in_shell(VoxelCoord p, std::int32_t from, std::int32_t to) {
  const std::int32_t d = squared(p - kCentre);
  return d >= from * from && d < to * to;
}
bool odd(std::int32_t a) {
  return (a & 1) != 0;
}

/// Returns voxel shapes that are hard for a mesher.
std::vector<Shape> adversarial_shapes() {
  return {
      {"one voxel", [](VoxelCoord p) { return p == kCentre; }},
      {"the full box", [](VoxelCoord) { return true; }},
      {"single voxels", [](VoxelCoord p) { return p.x % 3 == 0 && p.y % 3 == 0 && p.z % 3 == 0; }},
      {"voxels that touch along edges", [](VoxelCoord p) { return odd(p.x) == odd(p.y) && odd(p.x) == odd(p.z); }},
      {"a checkerboard", [](VoxelCoord p) { return odd(p.x + p.y + p.z); }},
      {"a stair of pinches", [](VoxelCoord p) { return p.x - kBox.min.x == p.y - kBox.min.y && p.y == p.z - 61; }},
      {"blocks joined by one voxel",
       [](VoxelCoord p) {
         return p == kCentre || (p.x < kCentre.x && p.z < kCentre.z) || (p.x > kCentre.x && p.y > kCentre.y);
       }},
      {"parallel sheets", [](VoxelCoord p) { return p.y % 3 == 0; }},
      {"a sheet with holes", [](VoxelCoord p) { return p.y == 2 && (p.x % 4 != 0 || p.z % 4 != 0); }},
      {"a slanted sheet", [](VoxelCoord p) { return std::abs(3 * (p.x - 64) + 5 * p.y - 7 * (p.z - 62)) < 4; }},
      {"nested shells", [](VoxelCoord p) { return in_shell(p, 6, 7) || in_shell(p, 3, 4) || in_shell(p, 0, 1); }},
      {"shells one voxel apart", [](VoxelCoord p) { return squared(p - kCentre) % 32 < 16; }},
      {"a grid of bars: high genus",
       [](VoxelCoord p) { return (p.x % 4 == 0) + (p.y % 4 == 0) + (p.z % 4 == 0) >= 2; }},
      {"a sponge",
       [](VoxelCoord p) {
         return std::sin(p.x * 0.9) * std::cos(p.y * 0.8) + std::sin(p.y * 0.9) * std::cos(p.z * 0.8) > 0;
       }},
      {"needles on a plate", [](VoxelCoord p) { return p.z == 55 || (p.z > 55 && p.x % 3 == 0 && p.y % 3 == 0); }},
      {"a spiral corridor",
       [](VoxelCoord p) {
         const VoxelCoord d = p - kCentre;
         const double turns = std::atan2(d.y, d.x) / 6.283185307 + std::sqrt(double(d.x * d.x + d.y * d.y)) / 4;
         return turns - std::floor(turns) < 0.5;
       }},
  };
}

}  // namespace

TEST_CASE("a proxy of adversarial voxels is sound and encloses them", "[property][proxy]") {
  for (const Shape& shape : adversarial_shapes()) {
    DYNAMIC_SECTION(shape.name) {
      const BitBox solid = test::bits_of(kBox, shape.inside);
      check_all_modes(solid, solid, {{{200, 12}, 0}, {{}, 0}});
    }
    DYNAMIC_SECTION(shape.name << ", closed") {
      const BitBox solid = test::bits_of(kBox, shape.inside);
      check_all_modes(solid, closing_of(solid, kBox, StructuringElement::ball, 2 * kScaleOne), {{{12}, 0}});
    }
  }
}

TEST_CASE("a proxy of more than a thousand parts is sound and encloses them", "[property][proxy]") {
  const VoxelBox box{{52, 0, 50}, {73, 21, 71}};
  const BitBox solid = test::bits_of(box, [](VoxelCoord p) { return !odd(p.x) && !odd(p.y) && !odd(p.z); });
  REQUIRE(solid.count() == 11 * 11 * 11);
  MeshParams params;
  params.faces = {9000};
  params.enclose = Enclose::scene;
  params.scene = triangles_in(solid);
  check_levels(box, solid, solid, params, triangles_in(solid));
}

TEST_CASE("a proxy of a random closing is sound and encloses it", "[property][proxy]") {
  const int seed = GENERATE(range(0, 8));
  CAPTURE(seed);
  Random random(std::uint64_t(seed) + 1000);
  BitBox solid(kBox);
  for (int i = random.between(1, 3); i > 0; --i) {
    VoxelBox part = kBox;
    for (int axis = 0; axis < 3; ++axis) {
      part.min[axis] = random.between(kBox.min[axis], kBox.max[axis] - 6);
      part.max[axis] = random.between(part.min[axis] + 4, kBox.max[axis]);
    }
    add_voxels(reference::random_solid(random, part), part, solid);
  }
  const auto element = random.one_in(2) ? StructuringElement::cube : StructuringElement::ball;
  const BitBox closing = closing_of(solid, kBox, element, Scale(random.between(0, 4 * kScaleOne)));
  check_all_modes(solid, closing, {{{400, 40}, 0}, {{}, 0}});
}

// Parts over several bricks that the first collapses swallow.
TEST_CASE("a proxy whose parts grow into each other encloses them", "[property][proxy]") {
  const auto seed = GENERATE(17u, 22u);
  CAPTURE(seed);
  Random random(seed);
  const VoxelBox box{{-128, -64, 0}, {128, 128, 192}};
  BitBox solid(box);
  for (int i = random.between(1, 3); i > 0; --i) {
    const VoxelCoord corner{random.between(-70, 30), random.between(-20, 30), random.between(40, 90)};
    const VoxelCoord size{random.between(1, 60), random.between(1, 50), random.between(1, 50)};
    add_voxels(reference::random_solid(random, {corner, corner + size}), {corner, corner + size}, solid);
  }
  MeshParams params;
  params.tighten = GENERATE(false, true);
  check_levels(box, solid, solid, params, triangles_in(solid));
}
