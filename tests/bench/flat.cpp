// How flat levels are where their scene is flat.
//   flat SCENE LEVEL...
// One JSON line for each LEVEL, and one for meshopt_simplify of the scene at the same count of faces.
//   flat       share of the level's area within 2 degrees of a plane of the scene nearby
//   on_plane   share that lies on that plane as well, to 0.1 % of the scene's diagonal
//   has_plane  share that has a plane of the scene nearby: what could be flat
//   to_scene, from_scene   mean distances, % of the diagonal
// A plane of the scene is a set of coplanar triangles (1 degree, 0.05 % of the diagonal) with at least the area of a
// mean face of the level. Nearby: 1 % of the diagonal, or REACH % from the environment.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numeric>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/surface_distance.h"
#include "tests/support/simplified.h"

namespace {

using bp::operator+, bp::operator-, bp::operator*;
using bp::test::read_triangles, bp::test::simplified;
using Triangles = std::vector<bp::TriangleD>;

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kSamples = 200000;

bp::Vec3d area_vector(const bp::TriangleD& t) {
  return 0.5 * bp::cross(t[1] - t[0], t[2] - t[0]);
}

double total_area(const Triangles& mesh) {
  return std::accumulate(mesh.begin(), mesh.end(), 0.0,
                         [](double sum, const bp::TriangleD& t) { return sum + bp::length(area_vector(t)); });
}

struct Plane {
  bp::Vec3d normal{};
  double offset = 0, area = 0;
};

/// The plane of each triangle: planes of large triangles take small ones in.
struct Planes {
  std::vector<Plane> planes;
  std::vector<std::uint32_t> of;  // per triangle

  Planes(const Triangles& scene, const bp::Vec3d& middle, double tolerance) : of(scene.size(), 0) {
    std::vector<double> areas(scene.size());
    for (std::size_t i = 0; i < scene.size(); ++i) areas[i] = bp::length(area_vector(scene[i]));
    std::vector<std::uint32_t> order(scene.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return areas[a] > areas[b]; });
    planes.push_back({});  // of triangles without an area
    for (const std::uint32_t i : order) {
      if (!(areas[i] > 0)) continue;
      of[i] = find(scene[i], middle, areas[i], tolerance);
      planes[of[i]].area += areas[i];
    }
  }

 private:
  using Key = std::array<long, 4>;
  std::map<Key, std::vector<std::uint32_t>> cells;

  std::uint32_t find(const bp::TriangleD& t, const bp::Vec3d& middle, double area, double tolerance) {
    bp::Vec3d n = (1 / area) * area_vector(t);
    std::size_t main = 0;
    for (std::size_t k = 1; k < 3; ++k) main = std::abs(n[k]) > std::abs(n[main]) ? k : main;
    if (n[main] < 0) n = -1.0 * n;
    const double offset = bp::dot(n, t[0] - middle);
    constexpr double kCell = 0.02;
    const auto key_of = [&](const bp::Vec3d& m, double d) {
      return Key{std::lround(m[0] / kCell), std::lround(m[1] / kCell), std::lround(m[2] / kCell),
                 std::lround(d / (8 * tolerance))};
    };
    const Key key = key_of(n, offset);
    for (long a = -1; a <= 1; ++a)
      for (long b = -1; b <= 1; ++b)
        for (long c = -1; c <= 1; ++c)
          for (long d = -1; d <= 1; ++d) {
            const auto at = cells.find({key[0] + a, key[1] + b, key[2] + c, key[3] + d});
            if (at == cells.end()) continue;
            for (const std::uint32_t p : at->second) {
              const Plane& plane = planes[p];
              const bool fits = std::abs(bp::dot(plane.normal, n)) > std::cos(kDegree) &&
                                std::all_of(t.begin(), t.end(), [&](const bp::Vec3d& q) {
                                  return std::abs(bp::dot(plane.normal, q - middle) - plane.offset) < tolerance;
                                });
              if (fits) return p;
            }
          }
    planes.push_back({n, offset, 0});
    cells[key].push_back(std::uint32_t(planes.size() - 1));
    return std::uint32_t(planes.size() - 1);
  }
};

struct Scene {
  Triangles triangles;
  bp::Bounds3d bounds;
  bp::Vec3d middle;
  double diagonal;
  Planes planes;
  bp::TriangleBvh tree;

  explicit Scene(Triangles all)
      : triangles(std::move(all)),
        bounds(bounds_of_all(triangles)),
        middle(0.5 * (bounds.min + bounds.max)),
        diagonal(bp::length(bounds.max - bounds.min)),
        planes(triangles, middle, 5e-4 * diagonal),
        tree(triangles) {}

  static bp::Bounds3d bounds_of_all(const Triangles& all) {
    bp::Bounds3d b;
    for (const bp::TriangleD& t : all)
      for (const bp::Vec3d& p : t) b.add(p);
    return b;
  }
};

struct Shares {
  double flat = 0, on_plane = 0, has_plane = 0;
};

/// Returns the shares of one face's samples; each sample has `weight`.
Shares shares_of(const Scene& scene, const bp::TriangleD& face, double least_area, double reach, int samples) {
  Shares sum;
  const bp::Vec3d v = area_vector(face), n = (1 / bp::length(v)) * v;
  for (int i = 0; i < samples; ++i) {
    double a = std::fmod(0.5 + 0.7548776662466927 * i, 1), b = std::fmod(0.5 + 0.5698402909980532 * i, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const bp::Vec3d p = face[0] + a * (face[1] - face[0]) + b * (face[2] - face[0]);
    bp::Bounds3d box;
    box.add(p - bp::Vec3d{reach, reach, reach});
    box.add(p + bp::Vec3d{reach, reach, reach});
    bool flat = false, on = false, has = false;
    static_cast<void>(scene.tree.visit(box, [&](const bp::TriangleBvh::Item& item) {
      const Plane& plane = scene.planes.planes[scene.planes.of[item.id]];
      if (plane.area < least_area || bp::distance_squared(p, item.corners) > reach * reach) return false;
      has = true;
      if (std::abs(bp::dot(plane.normal, n)) < std::cos(2 * kDegree)) return false;
      flat = true;
      on = on || std::abs(bp::dot(plane.normal, p - scene.middle) - plane.offset) < 1e-3 * scene.diagonal;
      return on;
    }));
    sum.flat += flat;
    sum.on_plane += on;
    sum.has_plane += has;
  }
  return sum;
}

void print(const char* what, const Scene& scene, const Triangles& mesh) {
  const char* reach_text = std::getenv("REACH");
  const double area = total_area(mesh), least = total_area(scene.triangles) / double(mesh.size());
  const double reach = (reach_text != nullptr ? std::atof(reach_text) : 1.0) / 100 * scene.diagonal;
  std::vector<Shares> each(mesh.size());
  bp::parallel_ranges(std::int64_t(mesh.size()), 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto f = std::size_t(begin); f < std::size_t(end); ++f) {
      const double own = bp::length(area_vector(mesh[f]));
      if (!(own > 0)) continue;
      const int samples = 1 + int(own / area * kSamples);
      const Shares s = shares_of(scene, mesh[f], least, reach, samples);
      const double w = own / area / samples;
      each[f] = {w * s.flat, w * s.on_plane, w * s.has_plane};
    }
  });
  Shares all;
  for (const Shares& s : each) all.flat += s.flat, all.on_plane += s.on_plane, all.has_plane += s.has_plane;
  const bp::TriangleBvh tree(mesh);
  std::printf(
      "{\"mesh\": \"%s\", \"faces\": %zu, \"flat\": %.3f, \"on_plane\": %.3f, \"has_plane\": %.3f, \"to_scene\": %.4f, "
      "\"from_scene\": %.4f}\n",
      what, mesh.size(), all.flat, all.on_plane, all.has_plane,
      100 * bp::surface_distance(mesh, scene.tree, 0.01 * scene.diagonal).mean / scene.diagonal,
      100 * bp::surface_distance(scene.triangles, tree, 0.01 * scene.diagonal).mean / scene.diagonal);
  std::fflush(stdout);
}

void run(int argc, char** argv) {
  const Scene scene(read_triangles(argv[1]));
  std::map<std::size_t, bool> counts;
  for (int i = 2; i < argc; ++i) {
    const Triangles level = read_triangles(argv[i]);
    print(std::filesystem::path(argv[i]).filename().c_str(), scene, level);
    counts.try_emplace(level.size());
  }
  for (const auto& [faces, unused] : counts)
    if (faces < scene.triangles.size())
      print("meshopt of the scene", scene, simplified(scene.triangles, scene.middle, faces));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fprintf(stderr, "usage: flat SCENE LEVEL...\n");
    return 2;
  }
  run(argc, argv);
  return 0;
} catch (const bp::Error& e) {
  std::fprintf(stderr, "flat: %s\n", e.what());
  return bp::exit_code(e.code());
}
