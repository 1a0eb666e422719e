// Measures how good levels are, as a viewer sees them and a builder counts them, by means that share nothing with the
// search for levels: pictures and nearest points.
//   measure SCENE LEVEL...
// One JSON line for each LEVEL. Lengths are shares of the diagonal of the scene's bounds.
//   faces        triangles
//   volume       of the level, scene units cubed; null: open
//   error        largest distance of a seen point of one to the other, both ways
//   to_scene     mean distance of seen points of the level to the scene
//   from_scene   mean distance of seen points of the scene to the level
//   thin         share of faces with an angle below 5 degrees
//   crumple      mean angle between the level and the scene where it lies nearest, degrees, over seen points
//   silhouette   intersection over union, mean of 36 views
//   sticks_out   largest distance of a corner beyond the scene's bounds
// A point is seen if one of 50 orthographic views of 300 x 300 pixels shows it.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/signed_volume.h"
#include "lib/geometry/triangle_bvh.h"
#include "tests/quality/views.h"

namespace {

using Triangles = std::vector<bp::TriangleD>;
using bp::operator-;
using bp::quality::Picture;

Triangles read(const std::string& path) {
  Triangles all;
  const auto source = bp::open_scenes({path}, {});
  for (Triangles chunk; source->read(chunk);) all.insert(all.end(), chunk.begin(), chunk.end());
  return all;
}

bp::Bounds3d bounds_of(const Triangles& mesh) {
  bp::Bounds3d bounds;
  for (const bp::TriangleD& t : mesh)
    for (const bp::Vec3d& p : t) bounds.add(p);
  return bounds;
}

bp::Vec3d normal_of(const bp::TriangleD& t) {
  return bp::unit(bp::cross(t[1] - t[0], t[2] - t[0]), {0, 0, 0});
}

constexpr double kDegree = 3.14159265358979323846 / 180;

/// Sums over seen points of one mesh: the distance to the other mesh, and the angle to it there.
struct Seen {
  double points = 0, distance = 0, angle = 0, largest = 0;
  void add(const Seen& s) {
    points += s.points, distance += s.distance, angle += s.angle, largest = std::max(largest, s.largest);
  }
};

Seen look(const Picture& picture, const Triangles& from, const bp::TriangleBvh& to) {
  Seen seen;
  std::uint32_t guess = 0;
  for (int y = 0; y < Picture::kSide; y += 2) {
    for (int x = 0; x < Picture::kSide; x += 2) {
      if (!picture.covered(x, y)) continue;
      const auto found = to.nearest(picture.point(x, y), guess);
      guess = found.item;
      const double distance = std::sqrt(found.distance_squared);
      const double cosine =
          std::abs(bp::dot(normal_of(from[picture.triangle(x, y)]), normal_of(to.item(guess).corners)));
      seen.add({1, distance, std::acos(std::min(1.0, cosine)) / kDegree, distance});
    }
  }
  return seen;
}

/// Pixels of two silhouettes that both cover, over those that one of them covers.
double overlap_of(const Picture& a, const Picture& b) {
  double both = 0, any = 0;
  for (int y = 0; y < Picture::kSide; ++y) {
    for (int x = 0; x < Picture::kSide; ++x) {
      both += a.covered(x, y) && b.covered(x, y);
      any += a.covered(x, y) || b.covered(x, y);
    }
  }
  return any > 0 ? both / any : 1;
}

double least_angle(const bp::TriangleD& t) {
  double least = 180;
  for (std::size_t i = 0; i < 3; ++i) {
    const bp::Vec3d u = bp::unit(t[(i + 1) % 3] - t[i], {1, 0, 0}), v = bp::unit(t[(i + 2) % 3] - t[i], {1, 0, 0});
    least = std::min(least, std::acos(std::clamp(bp::dot(u, v), -1.0, 1.0)) / kDegree);
  }
  return least;
}

double beyond(const Triangles& mesh, const bp::Bounds3d& bounds) {
  double most = 0;
  for (const bp::TriangleD& t : mesh)
    for (const bp::Vec3d& p : t) most = std::max(most, std::sqrt(bp::distance_squared(p, bounds)));
  return most;
}

struct Scene {
  explicit Scene(const std::string& path) : triangles(read(path)), tree(triangles), bounds(bounds_of(triangles)) {}
  Triangles triangles;
  bp::TriangleBvh tree;
  bp::Bounds3d bounds;
};

struct Compared {
  Seen level, scene;
  double silhouette = 0;
};

Compared compare(const Scene& scene, const Triangles& level) {
  const bp::TriangleBvh tree(level);
  const auto views = bp::quality::all_views();
  const std::size_t silhouettes = bp::quality::silhouette_views().size();
  std::vector<Compared> each(views.size());
  bp::parallel_for(std::int64_t(views.size()), [&](std::int64_t i) {
    Picture of_scene(views[std::size_t(i)], scene.bounds), of_level(views[std::size_t(i)], scene.bounds);
    of_scene.draw(scene.triangles);
    of_level.draw(level);
    each[std::size_t(i)] = {look(of_level, level, scene.tree), look(of_scene, scene.triangles, tree),
                            overlap_of(of_scene, of_level)};
  });
  Compared all;
  for (std::size_t i = 0; i < each.size(); ++i) {
    all.level.add(each[i].level);
    all.scene.add(each[i].scene);
    if (i >= silhouettes) continue;
    all.silhouette += each[i].silhouette / double(silhouettes);
  }
  return all;
}

std::string line_of(const Scene& scene, const std::string& path) {
  const Triangles level = read(path);
  const Compared c = compare(scene, level);
  const double diagonal = scene.bounds.diagonal();
  bp::SignedVolume volume(scene.bounds.min);
  double thin = 0;
  constexpr double kThin = 5;
  for (const bp::TriangleD& t : level) {
    volume.add(t);
    thin += least_angle(t) < kThin;
  }
  const std::optional<double> cubic = volume.value();
  return fmt::format(
      "{{\"level\": \"{}\", \"faces\": {}, \"volume\": {}, \"error\": {:.6g}, \"to_scene\": {:.6g}, \"from_scene\": "
      "{:.6g}, \"thin\": {:.4g}, "
      "\"crumple\": {:.5g}, \"silhouette\": {:.5g}, \"sticks_out\": {:.5g}}}\n",
      path, level.size(), cubic ? fmt::format("{:.8g}", *cubic) : "null",
      std::max(c.level.largest, c.scene.largest) / diagonal, c.level.distance / c.level.points / diagonal,
      c.scene.distance / c.scene.points / diagonal, thin / double(level.size()), c.level.angle / c.level.points,
      c.silhouette, beyond(level, scene.bounds) / diagonal);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) {
    fmt::print(stderr, "usage: measure SCENE LEVEL...\n");
    return 2;
  }
  const Scene scene(argv[1]);
  for (int i = 2; i < argc; ++i) fmt::print("{}", line_of(scene, argv[i]));
  return 0;
} catch (const bp::Error& e) {
  fmt::print(stderr, "measure: {}\n", e.what());
  return 1;
}
