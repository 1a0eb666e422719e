#include "lib/pass/mesh/mesh_pass.h"
#include "tests/catch.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kAround{{-100, -100, -100}, {100, 100, 100}};
constexpr Vec3d kHalf{60.3, 40.2, 20.1};
constexpr double kVolume = 8 * kHalf[0] * kHalf[1] * kHalf[2];

/// Axes of a box that is turned about x, y and z.
const std::array<Vec3d, 3> kAxes{Vec3d{0.7307, 0.6154, -0.2955}, {-0.4570, 0.7625, 0.4580}, {0.5072, -0.1997, 0.8384}};

std::vector<TriangleD> turned_box() {
  const auto at = [](int i) {
    Vec3d p{};
    for (std::size_t k = 0; k < 3; ++k) p = p + (i >> k & 1 ? kHalf[k] : -kHalf[k]) * kAxes[k];
    return p;
  };
  std::vector<TriangleD> out;
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    out.push_back({at(a), at(b), at(c)});
    out.push_back({at(a), at(c), at(d)});
  }
  return out;
}

/// Voxels that may touch the box, and those of `more` around them.
bool in_box(VoxelCoord v, double more) {
  const Vec3d p{v.x + 0.5, v.y + 0.5, v.z + 0.5};
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(dot(p, kAxes[k])) > kHalf[k] + 0.87 + more) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("more faces asked make no proxy of flat sides worse", "[meshing]") {
  enum class Knows { scene, header };
  const auto [knows, faces] = GENERATE(table<Knows, std::uint64_t>(
      {{Knows::scene, 64}, {Knows::scene, 100}, {Knows::scene, 200}, {Knows::scene, 300}, {Knows::header, 100}}));
  CAPTURE(int(knows), faces);
  VoxelSource source(
      kAround, [](VoxelCoord v) { return in_box(v, 0); }, [](VoxelCoord v) { return in_box(v, 10); });
  source.header().scale.base = 16;
  MeshParams params;
  params.faces = {faces};
  params.near_world = 16;
  params.enclose = knows == Knows::scene ? Enclose::scene : Enclose::input;
  if (knows == Knows::scene) params.scene = turned_box();
  source.header().scene.triangles = 12;
  MeshCounts counts;
  const LatticeMesh proxy = mesh_stream(source, memory_context(), params, counts).front();
  const double volume = double(volume6_of(proxy)) / 6 / std::pow(double(kLatticePerVoxel), 3) / kVolume;
  CAPTURE(volume);
  CHECK(proxy.triangles.size() < 20);
  CHECK(volume < (knows == Knows::scene ? 1.002 : 1.2));
}
