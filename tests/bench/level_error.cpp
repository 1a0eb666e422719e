// Measures how far a level is from its scene, by plain sampling: the error that bplod lists must not be below this.
//   level_error SCENE LEVEL [POINTS]
// One line: the largest distance of a point of LEVEL to SCENE, and of a point of SCENE to LEVEL, scene units. The
// points are all corners, and POINTS (a million by default) over the area. A level of OBJ is in the axes of its scene.
#include <cstdio>
#include <cstdlib>
#include <random>

#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/geometry/triangle_parts.h"

namespace {

using Triangles = std::vector<bp::TriangleD>;

Triangles read(const char* path) {
  Triangles all;
  const auto source = bp::open_scenes({path}, {});
  for (Triangles chunk; source->read(chunk);) all.insert(all.end(), chunk.begin(), chunk.end());
  return all;
}

double sampled(const Triangles& from, const Triangles& to, double points) {
  constexpr std::int64_t kGrain = 64;
  const bp::TriangleBvh tree(to);
  double area = 0;
  for (const bp::TriangleD& t : from) area += bp::area_of(t);
  std::vector<double> largest(from.size());
  bp::parallel_ranges(std::int64_t(from.size()), kGrain, [&](std::int64_t begin, std::int64_t end) {
    std::mt19937_64 random{std::uint64_t(begin)};
    std::uniform_real_distribution<double> uniform(0, 1);
    std::uint32_t guess = 0;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      const bp::TriangleD& t = from[i];
      const auto meet = [&](const bp::Vec3d& p) {
        const auto found = tree.nearest(p, guess);
        guess = found.item;
        largest[i] = std::max(largest[i], std::sqrt(found.distance_squared));
      };
      for (const bp::Vec3d& corner : t) meet(corner);
      const auto n = std::int64_t(std::ceil(points * bp::area_of(t) / area));
      for (std::int64_t k = 0; k < n; ++k) {
        double u = uniform(random), v = uniform(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        bp::Vec3d p;
        for (std::size_t a = 0; a < 3; ++a) p[a] = t[0][a] + u * (t[1][a] - t[0][a]) + v * (t[2][a] - t[0][a]);
        meet(p);
      }
    }
  });
  return *std::max_element(largest.begin(), largest.end());
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fprintf(stderr, "usage: level_error SCENE LEVEL [POINTS]\n");
    return 2;
  }
  const double points = argc > 3 ? std::atof(argv[3]) : 1e6;
  const Triangles scene = read(argv[1]), level = read(argv[2]);
  std::printf("%.6g from the level to the scene, %.6g back\n", sampled(level, scene, points),
              sampled(scene, level, points));
  return 0;
} catch (const bp::Error& e) {
  std::fprintf(stderr, "level_error: %s\n", e.what());
  return 1;
}
