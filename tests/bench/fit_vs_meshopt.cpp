// Levels of detail against meshoptimizer's simplifier at the same count of faces, by distances to the closing's
// surface.
//   fit_vs_meshopt CLOSED.bpv FINER.bpv SCENE FIT...
// One JSON line for each FIT, a file of bpmesh --mode fit, and for each count of faces among them: meshopt_simplify of
// the scene itself, and of the closing's dense surface. Distances in voxels, means over the area, both ways; to the
// surface of the closing's voxels, and to the scene.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/geometry/surface_distance.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/simplify/flatten.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"
#include "tests/support/simplified.h"

namespace {

using Triangles = std::vector<bp::TriangleD>;
using bp::test::read_triangles;

bp::LatticeMesh closing_surface(const std::string& path) {
  bp::BrickReader source(path);
  const auto shelf = bp::make_shelf_factory(std::uint64_t(1) << 30, "/tmp")();
  for (bp::Brick brick; source.read(brick);) {
    if (brick.layer == bp::Layer::closing) shelf->put(brick.coord, brick.fill, brick.bits);
  }
  bp::repair_contacts(*shelf);
  return bp::dense_surface(*shelf, source.header().frame);
}

Triangles simplified(const Triangles& in, std::size_t faces) {
  bp::Bounds3d bounds;
  for (const bp::TriangleD& t : in) {
    for (const bp::Vec3d& p : t) bounds.add(p);
  }
  bp::Vec3d middle;
  for (std::size_t i = 0; i < 3; ++i) middle[i] = (bounds.min[i] + bounds.max[i]) / 2;
  return bp::test::simplified(in, middle, faces);
}

/// The surface of a closing with few triangles.
struct Reference {
  Triangles triangles;
  bp::TriangleBvh tree;
  explicit Reference(const bp::LatticeMesh& dense) : triangles(merged(dense)), tree(triangles) {}

  static Triangles merged(const bp::LatticeMesh& dense) {
    bp::HalfEdgeMesh mesh(dense);
    bp::merge_flat_regions(mesh);
    return bp::world_triangles(mesh.compact(dense.frame));
  }
};

void print(const char* what, const Triangles& mesh, const Reference& closing, const Reference& finer, double voxel) {
  const bp::TriangleBvh tree(mesh);
  const auto mean = [&](const Triangles& from, const bp::TriangleBvh& to) {
    return bp::surface_distance(from, to).mean / voxel;
  };
  std::printf(
      "{\"mesh\": \"%s\", \"faces\": %zu, \"to_closing\": %.3f, \"from_closing\": %.3f, \"to_finer\": %.3f, "
      "\"from_finer\": %.3f}\n",
      what, mesh.size(), mean(mesh, closing.tree), mean(closing.triangles, tree), mean(mesh, finer.tree),
      mean(finer.triangles, tree));
}

void run(int argc, char** argv) {
  const bp::LatticeMesh dense = closing_surface(argv[1]);
  const double voxel = dense.frame.voxel;
  const Reference closing(dense), finer(closing_surface(argv[2]));
  const Triangles scene = read_triangles(argv[3]), surface = bp::world_triangles(dense);
  std::set<std::size_t> counts;
  for (int i = 4; i < argc; ++i) {
    const Triangles fit = read_triangles(argv[i]);
    print(std::filesystem::path(argv[i]).stem().stem().c_str(), fit, closing, finer, voxel);
    if (!counts.insert(fit.size()).second) continue;
    print("meshopt of the scene", simplified(scene, fit.size()), closing, finer, voxel);
    print("meshopt of the closing", simplified(surface, fit.size()), closing, finer, voxel);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 5) {
    std::fprintf(stderr, "usage: fit_vs_meshopt CLOSED.bpv FINER.bpv SCENE FIT...\n");
    return 2;
  }
  run(argc, argv);
  return 0;
} catch (const bp::Error& e) {
  std::fprintf(stderr, "fit_vs_meshopt: %s\n", e.what());
  return bp::exit_code(e.code());
}
