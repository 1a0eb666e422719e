#include "tools/check/verdict_steps.h"

#include <cmath>

#include "lib/core/error.h"
#include "lib/geometry/triangle_totals.h"
#include "lib/pass/voxelize/empty_scene.h"

namespace bp {

void add_origin(IndexedMesh& mesh, const Vec3d& by) {
  if (by == Vec3d{}) return;
  for (Vec3d& p : mesh.vertices) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double sum = p[i] + by[i], part = sum - by[i];
      if (std::isfinite(sum) && (sum - part != by[i] || part != p[i])) {
        fail(ErrorCode::bad_argument,
             "--origin: {} + {} is no exact double; give the origin that bpmesh or bplod was given", p[i], by[i]);
      }
      p[i] = sum;
    }
  }
}

double margin_world(const Length& margin, TriangleSource& scene) {
  if (!(margin.value > 0)) return 0;
  return margin.in_world(margin.unit == Length::Unit::percent ? bounds_of(scene).diagonal() : 0, 0);
}

Json counts_of(const CheckReport& verdict) {
  return {{"holds", verdict.holds()},
          {"answer", to_string(verdict.answer())},
          {"proxy_triangles", verdict.triangles},
          {"scene_triangles", verdict.scene_triangles},
          {"self_intersections", verdict.self_intersections.count},
          {"touching", verdict.touching.count},
          {"outside", verdict.outside.count}};
}

void refuse_empty_scene(const CheckReport& verdict) {
  if (!verdict.scene_name.empty() && !verdict.scene_counts.has_area())
    refuse_empty_scene(verdict.scene_name, verdict.scene_counts);
}

}  // namespace bp
