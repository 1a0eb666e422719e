// The steps of the pipe that make voxels, as bpvox and bpclose do them.
#include <algorithm>
#include <cstring>

#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "tools/api/call.h"
#include "tools/api/grid.h"
#include "tools/api/structs.h"
#include "tools/notes/estimate.h"
#include "tools/notes/proportion.h"
#include "tools/pipe/close_step.h"
#include "tools/pipe/voxelize_step.h"
#include "tools/run/make_backend.h"
#include "tools/run/scene_budget.h"

namespace bp::api {

namespace {

SceneOptions reading_options(const Scene& scene, const CommonOptions& common, std::uint64_t memory,
                             const VoxelizeBudget& budget) {
  SceneOptions options{scene.format, budget.reader, common.temp};
  options.document = document_budget(memory, kVoxelProgram, std::max<std::size_t>(scene.files.size(), 1));
  options.keep_degenerate = true;
  return options;
}

/// The closing of a grid, which is told to begin with.
class Closing {
 public:
  Closing(const VoxelGrid& grid, const bp_close_options& options, Call& call)
      : grid_(grid), call_(call), opening_(opens(grid.header)), source_(grid.open()) {
    step_.closing.element = options.element == BP_CUBE ? StructuringElement::cube : StructuringElement::ball;
    if (options.element != BP_CUBE && options.element != BP_BALL)
      fail(ErrorCode::bad_argument, "element: {} is none of its values", options.element);
    step_.keep_cavities = options.keep_cavities != 0;
    if (opening_ && step_.keep_cavities)
      fail(ErrorCode::bad_argument, "keep_cavities means nothing for a grid of BP_FILL_INSIDE; leave it out");
    const Length scale = length_of(options.scale, "scale");
    if (scale.value > 0 || options.no_scale != 0) step_.closing.scale = scale;
    if (options.rules != nullptr) rules_ = options.rules;
    if (step_.closing.scale && !rules_.empty()) fail(ErrorCode::bad_argument, "scale and rules exclude each other");
    if (grid.header.has_field && (step_.closing.scale || !rules_.empty()))
      fail(ErrorCode::bad_argument, "the grid has a field, which says the scales; leave out scale and rules");
    if (!step_.closing.scale && rules_.empty() && !grid.header.has_field) step_.closing.scale = kDefaultScale;
    if (step_.closing.scale)
      question_scale("--scale", *step_.closing.scale, grid.header.bounds, grid.header.frame.voxel);
  }

  [[nodiscard]] std::shared_ptr<const VoxelGrid> run() {
    CloseOptions options = pass_options(0);
    RuledSource source(source_, options.context, call_.common().memory_bytes, call_.common().temp);
    const ScalePlan plan = plan_of(source);
    note_scales(call_.report(), call_.common(), step_, grid_.header, plan);
    const ClosingParams params = closing_params(step_.closing.element, grid_.header);
    const Estimate estimate = estimate_close(grid_.header, plan.field);
    Backends backends = make_backends(call_.common(), params.turned() ? 0 : estimate.core_seconds, &call_.report());
    if (const std::uint64_t pinned = pinned_bytes(backends); pinned > 0) options = pass_options(pinned);
    auto out = std::make_shared<VoxelGrid>();
    out->header = closed_header(params, step_, grid_.header, plan);
    out->scene = grid_.scene;
    out->solid = opening_ ? options.context.make_shelf() : grid_.solid;
    out->closing = options.context.make_shelf();
    ShelfSink sink(opening_ ? out->solid.get() : nullptr, out->closing.get());
    (void)(opening_ ? open_stream : close_stream)(source, sink, backends, plan.field, params, options);
    return out;
  }

 private:
  [[nodiscard]] CloseOptions pass_options(std::uint64_t pinned) {
    CloseOptions options = close_options(call_.common(), step_.keep_cavities, opening_, pinned, call_.progress());
    options.context.stop = call_.stop();
    return options;
  }
  [[nodiscard]] ScalePlan plan_of(RuledSource& source) const {
    if (!rules_.empty()) return source.read_rules({rules_, "rules"});
    return plan_without_rules(step_, grid_.header);
  }

  const VoxelGrid& grid_;
  Call& call_;
  const bool opening_;
  ShelfSource source_;
  CloseStep step_;
  std::string rules_;
};

}  // namespace

VoxelOptions voxel_options(const Scene& scene, const bp_voxelize_options* given) {
  const bp_voxelize_options o = take_struct(given, bp_voxelize_options{}, "bp_voxelize_options");
  VoxelOptions v;
  v.scenes = scene.files;
  v.format = scene.format;
  if (const Length length = length_of(o.voxel, "voxel"); length.value > 0) v.voxel = length;
  if (v.voxel && v.voxel->unit == Length::Unit::voxels)
    fail(ErrorCode::bad_argument, "voxel: a voxel is not measured in voxels");
  if (o.resolution < 0) fail(ErrorCode::bad_argument, "resolution: {} is below 1", o.resolution);
  if (o.resolution > 0) v.resolution = o.resolution;
  if (v.voxel && v.resolution) fail(ErrorCode::bad_argument, "voxel and resolution exclude each other");
  v.fill = choice<FillMode>(o.fill, 4, "fill");
  v.up = up_of(o.up);
  return v;
}

std::shared_ptr<const VoxelGrid> voxelize(const std::shared_ptr<const Scene>& scene, const bp_voxelize_options* given,
                                          Call& call) {
  const VoxelOptions voxels = voxel_options(*scene, given);
  call.begin("reading");
  const std::uint64_t memory = call.common().memory_bytes;
  const VoxelizeBudget budget(memory);
  const SceneOptions reading = reading_options(*scene, call.common(), memory, budget);
  const auto source = scene->open(reading);
  VoxelizeOptions options = voxelize_options(voxels, call.common(), budget);
  options.context.progress = call.progress();
  options.context.stop = call.stop();
  auto grid = std::make_shared<VoxelGrid>();
  grid->scene = scene;
  grid->solid = make_shelf(budget.shelf, call.common().temp);
  ShelfSink sink(grid->solid.get());
  const auto open = [&](const StreamHeader& h, const VoxelizeCounts& counts) -> BrickSink& {
    grid->header = h;
    const bool told = voxels.up || source->up() || voxels.tell_up();
    grid->header.provenance.push_back(
        make_provenance("bpvox", voxelize_text(voxels, h.frame.up, told), counts.input_hash));
    grid->header.scene =
        scene->arrays ? SceneFiles{{}, "", counts.scene.triangles, counts.input_hash} : scene_files(voxels, counts);
    return sink;
  };
  const VoxelizeCounts counts = voxelize_stream(*source, open, options);
  note_voxels(call.report(), call.common(), grid->header, counts, {voxels.scenes, reading});
  return grid;
}

std::shared_ptr<const VoxelGrid> close(const VoxelGrid& grid, const bp_close_options* given, Call& call) {
  const bp_close_options options = take_struct(given, bp_close_options{}, "bp_close_options");
  call.begin("closing");
  return Closing(grid, options, call).run();
}

}  // namespace bp::api

using namespace bp::api;

extern "C" {

void bp_voxelize_defaults(bp_voxelize_options* options, size_t size) {
  put_defaults(options, size, bp_voxelize_options{});
}

bp_status bp_voxelize(const bp_scene* scene, const bp_voxelize_options* options, const bp_run* run, bp_grid** out) {
  return guarded_result(run, out, [&](Call& call) { return voxelize(needed(scene, "scene").scene, options, call); });
}

void bp_close_defaults(bp_close_options* options, size_t size) {
  put_defaults(options, size, bp_close_options{});
}

bp_status bp_close(const bp_grid* grid, const bp_close_options* options, const bp_run* run, bp_grid** out) {
  return guarded_result(run, out, [&](Call& call) { return close(*needed(grid, "grid").grid, options, call); });
}

}  // extern "C"
