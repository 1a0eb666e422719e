// The exact verdict on a proxy, as bpcheck gives it.
#include <cmath>
#include <limits>

#include "lib/check/check_proxy.h"
#include "lib/check/verdict_text.h"
#include "lib/core/error.h"
#include "lib/pass/voxelize/empty_scene.h"
#include "tools/api/call.h"
#include "tools/api/mesh.h"
#include "tools/api/structs.h"
#include "tools/run/hiding_recipe.h"
#include "tools/run/memory_shares.h"
#include "tools/run/scene_budget.h"

struct bp_verdict {
  bp::CheckReport report;
  std::string reasons, text, json;
};

namespace bp::api {

namespace {

constexpr std::size_t kCheckExamples = 5;

std::unique_ptr<TriangleSource> open_for_check(const Scene& scene, const CommonOptions& common, std::uint64_t memory,
                                               bool walls_only = false) {
  SceneOptions options;
  options.walls_only = walls_only;
  options.keep_extremes = options.keep_degenerate = true;
  options.memory_bytes = memory / 3;
  options.temp_dir = common.temp;
  options.document = document_budget(common.memory_bytes, kMeshProgram, std::max<std::size_t>(scene.files.size(), 1));
  return scene.open(options);
}

double margin_of(const bp_length& margin, TriangleSource* scene) {
  const Length length = length_of(margin, "margin");
  if (!(length.value > 0)) return 0;
  if (scene == nullptr) fail(ErrorCode::bad_argument, "margin: it is a distance from a scene, and none is given");
  if (length.unit != Length::Unit::percent) return length.in_world(0, 0);
  Bounds3d bounds;
  for (std::vector<TriangleD> chunk; scene->read(chunk);) {
    for (const TriangleD& t : chunk) {
      for (const Vec3d& p : t) bounds.add(p);
    }
  }
  scene->rewind();
  return length.in_world(bounds.diagonal(), 0);
}

/// `steps`: that made the proxy, empty if they are not known.
bp_verdict verdict_of(const ArrayScene& proxy, const std::vector<std::string>& steps, const bp_scene* scene,
                      const bp_check_options* given, Call& call) {
  const bp_check_options o = take_struct(given, bp_check_options{}, "bp_check_options");
  if (o.inside != 0 && scene == nullptr)
    fail(ErrorCode::bad_argument, "inside: it asks for a place within a scene, and none is given");
  if (o.inside != 0 && (o.convex != 0 || o.margin.value > 0))
    fail(ErrorCode::bad_argument, "inside: it excludes convex and margin, which ask for a place around the scene");
  call.begin("checking");
  const std::uint64_t memory = UsableMemory(call.common().memory_bytes, kMeshProgram).bytes;
  std::unique_ptr<TriangleSource> source;
  if (scene != nullptr) source = open_for_check(*scene->scene, call.common(), memory);
  CheckOptions options;
  options.max_examples = kCheckExamples;
  options.inside = o.inside != 0;
  options.convex = o.convex != 0;
  options.distances = o.no_distances == 0;
  options.margin_world = margin_of(o.margin, source.get());
  options.scene_memory_bytes = memory / 3 * 2;
  MeshExtras extras;
  extras.provenance = steps;
  Walls walls;
  if (options.inside)
    walls = walls_of(
        extras, [&](bool opaque_only) { return open_for_check(*scene->scene, call.common(), memory, opaque_only); });
  options.hidden = walls.question;
  CheckReport report = check_proxy(proxy.mesh(), source.get(), options);
  if (source && !report.scene_counts.has_area()) refuse_empty_scene(report.scene_name, report.scene_counts);
  bp_verdict verdict{{}, failures(report), verdict_text(report, "the proxy"), verdict_json(report, "the proxy")};
  verdict.report = std::move(report);
  return verdict;
}

double number_or_nan(const std::optional<double>& number) {
  return number.value_or(std::numeric_limits<double>::quiet_NaN());
}

double max_or_nan(const std::optional<SampledDistance>& distance) {
  return distance ? distance->max : std::numeric_limits<double>::quiet_NaN();
}

bp_verdict_info info_of(const CheckReport& r) {
  bp_verdict_info info{};
  info.answer = std::int32_t(r.answer());
  info.sound = std::int32_t(r.soundness());
  info.placed = std::int32_t(!r.has_scene     ? Answer::undecided
                             : r.asks_hidden  ? r.hiddenness()
                             : r.wants_inside ? r.insideness()
                                              : r.enclosure());
  info.touching = r.touching.count;
  info.outside = r.outside.count;
  info.volume = number_or_nan(r.volume);
  info.scene_volume = number_or_nan(r.scene_volume);
  info.scene_to_proxy = max_or_nan(r.scene_to_proxy);
  info.proxy_to_scene = max_or_nan(r.proxy_to_scene);
  return info;
}

}  // namespace

}  // namespace bp::api

using namespace bp::api;

extern "C" {

void bp_check_defaults(bp_check_options* options, size_t size) {
  put_defaults(options, size, bp_check_options{});
}

bp_status bp_check(const bp_arrays* proxy, const bp_scene* scene, const bp_check_options* options, const bp_run* run,
                   bp_verdict** out) {
  return guarded_result(run, out, [&](Call& call) {
    bp_arrays arrays{};
    arrays.triangle_type = BP_UINT32;
    arrays = take_struct(&needed(proxy, "proxy"), arrays, "bp_arrays");
    arrays.borrow = 1;
    return verdict_of(ArrayScene(arrays), {}, scene, options, call);
  });
}

bp_status bp_check_mesh(const bp_mesh* proxy, size_t index, const bp_scene* scene, const bp_check_options* options,
                        const bp_run* run, bp_verdict** out) {
  return guarded_result(run, out, [&](Call& call) {
    const Mesh& mesh = mesh_at(proxy, index);
    return verdict_of(ArrayScene(mesh.arrays()), mesh.steps(), scene, options, call);
  });
}

bp_status bp_verdict_read_info(const bp_verdict* verdict, bp_verdict_info* info, size_t size) {
  return guarded([&] { put_struct(info, size, info_of(needed(verdict, "verdict").report)); });
}

const char* bp_verdict_reasons(const bp_verdict* verdict) {
  return verdict == nullptr ? "" : verdict->reasons.c_str();
}

const char* bp_verdict_text(const bp_verdict* verdict) {
  return verdict == nullptr ? "" : verdict->text.c_str();
}

const char* bp_verdict_json(const bp_verdict* verdict) {
  return verdict == nullptr ? "" : verdict->json.c_str();
}

void bp_verdict_free(bp_verdict* verdict) {
  delete verdict;
}

}  // extern "C"
