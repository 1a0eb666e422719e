#include "tools/run/read_again.h"

#include "lib/core/error.h"
#include "tools/run/scene_files.h"

namespace bp {

namespace {

/// Throws bad_input if a triangle lies outside the bounds. Code that takes the triangles might otherwise cut it into
/// parts without an end.
void check_within(const TriangleD& t, const Bounds3d& bounds, const std::string& name) {
  for (const Vec3d& p : t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(p[i] >= bounds.min[i] && p[i] <= bounds.max[i]))
        fail(ErrorCode::bad_input, "{}: has changed since the stream was made; run bpvox again", name);
    }
  }
}

}  // namespace

void read_again(const SceneFiles& scene, const Bounds3d& bounds, SceneOptions options,
                const std::function<void(const TriangleD&)>& take) {
  if (const auto fault = fault_of(scene))
    fail(ErrorCode::bad_input, "{}; {}", fault->fact,
         fault->changed ? "run bpvox again" : "give bpvox a file that stays");
  options.format = scene.format;
  const auto source = open_scenes(names_of(scene), options);
  for (std::vector<TriangleD> chunk; source->read(chunk);) {
    for (const TriangleD& t : chunk) {
      check_within(t, bounds, source->name());
      take(t);
    }
  }
}

}  // namespace bp
