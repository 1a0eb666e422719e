// The scale field of a grid, as bpscale adds it.
#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/measure/orientation_rules.h"
#include "tools/api/call.h"
#include "tools/api/grid.h"
#include "tools/api/structs.h"
#include "tools/notes/scale_notes.h"
#include "tools/pipe/close_step.h"
#include "tools/pipe/field_step.h"
#include "tools/run/read_again.h"

namespace bp::api {

namespace {

/// Returns a reader of the grid's scene; grid and options stay alive.
TriangleReader scene_again(const VoxelGrid& grid, const SceneOptions& options) {
  return [&](const std::function<void(const TriangleD&)>& take) {
    const auto source = grid.open_arrays(options);
    if (!source) return read_again(grid.header.scene, grid.header.bounds, options, take);
    for (std::vector<TriangleD> chunk; source->read(chunk);) {
      for (const TriangleD& t : chunk) take(t);
    }
  };
}

std::shared_ptr<const VoxelGrid> field(const VoxelGrid& grid, const char* rules, Call& call) {
  const RulesText text{&needed(rules, "rules"), "rules"};
  const StreamHeader& header = grid.header;
  if (header.has_closing) fail(ErrorCode::bad_argument, "the grid is closed already; a field comes before the closing");
  call.begin("reading rules");
  PassContext context = close_options(call.common(), false, false, 0, call.progress()).context;
  context.stop = call.stop();
  ShelfSource voxels = grid.open();
  RuledSource source(voxels, context, call.common().memory_bytes, call.common().temp);
  const ScalePlan plan = source.read_rules(text, true);
  OrientationField orientation;
  if (!plan.orientation.empty())
    orientation = make_orientation(parse_orientation(plan.orientation, text.name), header, plan.field.base,
                                   scene_again(grid, source.scene_options()));
  for (const std::string& note : scale_notes(plan, header)) call.report().note(note, call.common());
  auto out = std::make_shared<VoxelGrid>();
  out->header = field_header(header, plan, orientation);
  out->solid = grid.solid;
  out->scene = grid.scene;
  return out;
}

Vec3d point_at(const double* points, std::size_t i) {
  constexpr double kFarthest = 1e150;  // the square of a distance is a double
  const Vec3d p{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
  for (const double x : p) {
    if (!(std::abs(x) <= kFarthest)) fail(ErrorCode::bad_input, "point {} is not finite, or too far away", i);
  }
  return p;
}

void read_scales(const VoxelGrid& grid, const double* points, std::size_t count, double* scales) {
  constexpr std::size_t kBlock = 256;
  if (grid.rules().empty())
    fail(ErrorCode::bad_argument, "the grid has no scales; bp_field() and bp_close() give it some");
  if (count == 0) return;
  (void)needed(points, "points");
  (void)needed(scales, "the result");
  for (std::size_t i = 0; i < count; ++i) (void)point_at(points, i);  // the first fault is told
  parallel_for(std::int64_t((count + kBlock - 1) / kBlock), [&](std::int64_t block) {
    const std::size_t first = std::size_t(block) * kBlock;
    for (std::size_t i = first; i < std::min(first + kBlock, count); ++i)
      scales[i] = grid.header.scale.evaluate(point_at(points, i));
  });
}

}  // namespace

}  // namespace bp::api

using namespace bp::api;

extern "C" {

bp_status bp_field(const bp_grid* grid, const char* rules, const bp_run* run, bp_grid** out) {
  return guarded_result(run, out, [&](Call& call) { return field(*needed(grid, "grid").grid, rules, call); });
}

bp_status bp_grid_scales(const bp_grid* grid, const double* points, size_t count, const bp_run* run, double* scales) {
  return guarded_call(run, [&](Call& call) {
    call.begin("reading scales");
    read_scales(*needed(grid, "grid").grid, points, count, scales);
  });
}

}  // extern "C"
