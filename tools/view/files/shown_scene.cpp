#include "tools/view/files/shown_scene.h"

#include <algorithm>
#include <limits>

#include "io/scene/scene_format.h"
#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/geometry/triangle_bvh.h"
#include "tools/cli/report.h"
#include "tools/run/memory_shares.h"
#include "tools/run/scene_budget.h"
#include "tools/view/geometry/shown_mesh.h"

namespace bp {

namespace {

bool has_part_names(const ViewOptions& o) {
  return std::any_of(o.voxels.scenes.begin(), o.voxels.scenes.end(), [&](const std::string& scene) {
    return names_parts(o.voxels.format.empty() ? scene_format_of(scene) : o.voxels.format);
  });
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

SceneOptions scene_options(const ViewOptions& o) {
  SceneOptions scene{o.voxels.format, o.common.memory_bytes / 8, o.common.temp};
  scene.document = document_budget(o.common.memory_bytes, kVoxelProgram, 2);
  return scene;
}

ShownScene::ShownScene(const ViewOptions& options, const StreamHeader& header, const Vec3d& middle, std::uint64_t most,
                       const Events& events)
    : options_(options), header_(header), middle_(middle), most_(most), events_(events) {
  if (is_shown()) std::call_once(read_, [this] { read(); });
}

void ShownScene::read() {
  if (!is_shown() && !has_part_names(options_)) return;
  SceneOptions scene = scene_options(options_);
  scene.part_names = std::make_shared<PartNames>();
  const auto source = open_scenes(options_.voxels.scenes, scene);
  std::vector<TriangleD> all, some;
  if (is_shown()) all.reserve(header_.scene.triangles);
  while (!events_.ended() && source->read(some)) {
    if (is_shown() && all.size() + some.size() > most_)
      fail(ErrorCode::bad_input, "{}: has changed while it was read", source->name());
    if (is_shown()) all.insert(all.end(), some.begin(), some.end());
  }
  parts_ = *scene.part_names;
  if (is_shown()) bytes_ = shown_smooth(all, {-middle_[0], -middle_[1], -middle_[2]}).bytes();
}

/// Names of a scene that is not shown are read when a page asks: its closing comes first.
std::string ShownScene::part_names() {
  std::call_once(read_, [this] { read(); });
  Json names = Json::array();
  for (const std::string& name : parts_.names) {
    if (names.size() < kMostNames) names.push_back(name);
  }
  return text_of(names);
}

std::string ShownScene::part_at(const Vec3d& point) const {
  SceneOptions scene = scene_options(options_);
  scene.part_names = std::make_shared<PartNames>();
  double nearest = std::numeric_limits<double>::infinity();
  std::string part;
  scene.part_names->of_triangle = [&](const std::string& name, const TriangleD& t) {
    const double distance = distance_squared(point, t);
    if (distance < nearest) nearest = distance, part = name;
    return false;  // a later triangle of the part may be nearer
  };
  const auto source = open_scenes(options_.voxels.scenes, scene);
  std::uint64_t triangles = 0;
  for (std::vector<TriangleD> some; !events_.ended() && source->read(some);) triangles += some.size();
  if (!events_.ended() && triangles != header_.scene.triangles)
    fail(ErrorCode::bad_input, "{}: has changed since it was opened", source->name());
  return text_of({{"part", part}});
}

}  // namespace bp
