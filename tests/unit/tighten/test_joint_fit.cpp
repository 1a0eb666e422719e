#include "lib/core/vec3.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/simplify/flatten.h"
#include "lib/surface/surface.h"
#include "lib/tighten/joint_fit.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"

using namespace bp;
using namespace bp::test;

namespace {

/// The voxels of a box, inside of four bricks.
void fill_box(MemoryShelf& shelf, const VoxelBox& box) {
  BitBox bits({{0, 0, 0}, {128, 64, 128}});
  load_voxels(shelf, bits);
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      for (std::int32_t x = box.min.x; x < box.max.x; ++x) bits.row(y, z)[x / 64] |= std::uint64_t(1) << (x & 63);
    }
  }
  store_voxels(bits, shelf);
}

/// A slab of two voxels with a column on it: large faces with no corner of a voxel under their middle.
struct Slab : MemoryShelf {
  Slab() {
    fill_box(*this, {{3, 3, 3}, {120, 5, 117}});
    fill_box(*this, {{40, 5, 3}, {61, 30, 31}});
  }
};

GridFrame unit_voxels() {
  GridFrame frame;
  frame.voxel = 1;
  return frame;
}

HalfEdgeMesh merged_surface(const BrickShelf& shelf) {
  HalfEdgeMesh mesh(dense_surface(shelf, unit_voxels()));
  merge_flat_regions(mesh);
  return mesh;
}

/// A fit with points on a slab's surface.
struct OnSlab {
  Slab shelf;
  HalfEdgeMesh mesh = merged_surface(shelf);
  EnclosedVoxels enclosed{shelf};
  ContactPoints contacts{enclosed, mesh, FaceTree(mesh)};
  ContactForces forces;
  JointFit fit{mesh, contacts, forces};

  [[nodiscard]] double farthest() const {
    double far = 0;
    for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
      if (mesh.vertex_alive(v)) far = std::max(far, length(fit.shift(v)));
    }
    return far;
  }
};

}  // namespace

TEST_CASE("a proxy that lies on flat sides everywhere is asked to stay", "[quick][meshing]") {
  OnSlab slab;
  const HalfEdgeMesh& mesh = slab.mesh;
  slab.fit.solve(0.25);  // with nothing in its way a corner would go some thousand units
  const double farthest = slab.farthest();
  double growth = 0;
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
    if (mesh.vertex_alive(v)) growth += slab.fit.growth(v);
  }
  CAPTURE(farthest, growth, mesh.face_count());
  CHECK(farthest < kLatticePerVoxel);
  CHECK(growth > -0.01 * double(mesh.volume6()) / 6);
}

TEST_CASE("a second joint program begins with the forces of the first, and changes little", "[quick][meshing]") {
  OnSlab slab;
  const HalfEdgeMesh& mesh = slab.mesh;
  slab.fit.solve(0.25);
  const double first = slab.farthest();
  CHECK_FALSE(slab.forces.empty());
  slab.fit.solve(0.25);  // some rounds more
  CHECK(slab.farthest() < 1.01 * first);
  JointFit other(mesh, slab.contacts, slab.forces);
  other.solve(0.25);
  double apart = 0;
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
    if (mesh.vertex_alive(v)) apart = std::max(apart, length(other.shift(v) - slab.fit.shift(v)));
  }
  CAPTURE(first, slab.farthest(), apart);
  CHECK(apart < 0.1 * kLatticePerVoxel);
}

TEST_CASE("contact points of voxels lie on their boundary: all convex corners, samples of edges and sides",
          "[quick][meshing]") {
  MemoryShelf shelf;
  fill_box(shelf, {{3, 3, 3}, {30, 12, 20}});
  std::size_t corners = 0, on_edges = 0, on_sides = 0;
  for (const Vec3d& p : EnclosedVoxels(shelf).contact_points({}, kEverywhere)) {
    const Vec3d low{3 * 64.0, 3 * 64.0, 3 * 64.0}, high{30 * 64.0, 12 * 64.0, 20 * 64.0};
    int at_ends = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK((p[i] >= low[i] && p[i] <= high[i]));
      at_ends += p[i] == low[i] || p[i] == high[i];
    }
    CHECK(at_ends > 0);
    corners += at_ends == 3;
    on_edges += at_ends == 2;
    on_sides += at_ends == 1;
  }
  CHECK(corners == 8);
  CHECK(on_edges == 4 * (3 + 1 + 2));  // x at 8, 16, 24; y at 8; z at 8, 16
  CHECK(on_sides == 2 * (3 * 1 + 1 * 2 + 2 * 3));
}

TEST_CASE("beside corners that stay no vertex is asked to go far for a margin", "[quick][meshing]") {
  OnSlab slab;
  HalfEdgeMesh& mesh = slab.mesh;
  VertexId free = kNoId;
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
    if (!mesh.vertex_alive(v)) continue;
    if (free == kNoId) {
      free = v;
    } else {
      mesh.lock(v);
    }
  }
  slab.fit.solve(0.25);
  CAPTURE(slab.fit.shift(free));
  CHECK(length(slab.fit.shift(free)) < 1);  // it lies on voxels
}
