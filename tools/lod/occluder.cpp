#include "tools/lod/occluder.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/stage/complement.h"
#include "lib/stage/hidden_stage.h"
#include "tools/common/names.h"

namespace bp {

namespace {

constexpr double kAsMuch = 0.95;                                 // of what the best scale hides
constexpr double kLeastScaleVox = 2;                             // that is tried
constexpr double kMostScale = 1.0 / 16, kMostOpening = 1.0 / 8;  // of the scene's diagonal
constexpr double kLeastPart = 1e-3;                              // of the largest one, by volume

class Occluder {
 public:
  explicit Occluder(Build& build) : build_(build) {
    made_.scene = build.voxelize(0);
    diagonal_ = made_.scene.header.bounds.diagonal();
    voxel_ = made_.scene.header.frame.voxel;
  }

  MadeOccluder run() {
    build_.report.stage("close openings");
    const std::optional<Length>& scale = build_.options.request.scale;
    hide(scale ? scale->in_world(diagonal_, voxel_) : best_scale());
    if (hidden_.count == 0)
      fail(ErrorCode::bad_input,
           "the scene hides nothing: it is open by more than twice the scale of {:.4g}, or thinner than its voxels of "
           "{:.4g}; try another --scale, or smaller voxels",
           scale_, voxel_);
    build_.report.stage("mesh");
    mesh();
    finish();
    return std::move(made_);
  }

 private:
  [[nodiscard]] HiddenOptions options(double scale) const {
    HiddenOptions o;
    o.scale_world = scale;
    o.element = build_.options.element;
    o.memory_bytes = build_.budget.work;
    o.make_shelf = build_.make_shelf;
    o.progress = build_.show;
    return o;
  }

  void hide(double scale) {
    if (hidden_.voxels != nullptr && scale == scale_) return;
    hidden_ = {};
    hidden_ = hidden_voxels(made_.scene.header, *made_.scene.solid, build_.backends, options(scale));
    scale_ = scale;
  }

  double best_scale() {
    std::vector<std::pair<double, std::uint64_t>> tried;
    std::uint64_t most = 0;
    for (double scale = 0; scale <= diagonal_ * kMostScale;
         scale = scale == 0 ? kLeastScaleVox * voxel_ : scale * std::sqrt(2.0)) {
      hide(scale);
      tried.emplace_back(scale, hidden_.count);
      most = std::max(most, hidden_.count);
    }
    Json list = Json::array();
    for (const auto& [scale, count] : tried)
      list.push_back({{"scale", scale}, {"hidden", double(count) * std::pow(voxel_, 3)}});
    made_.more["scales"] = list;
    for (const auto& [scale, count] : tried) {
      if (double(count) >= kAsMuch * double(most)) return scale;
    }
    return 0;
  }

  /// False if nothing is left of it.
  bool mesh_at(double scale, LodLevel& level) {
    StreamHeader header = made_.scene.header;
    header.bricks = bricks_around(*hidden_.voxels);
    header.fill = FillMode::inside;
    header.has_closing = scale > 0;
    header.scale.base = scale;
    std::unique_ptr<BrickShelf> opened;
    if (scale > 0) opened = opening(header, *hidden_.voxels, build_.backends, options(scale));
    if (scale > 0 && opened == nullptr) return false;
    ShelfSource source(header, *hidden_.voxels, opened.get(), ShelfSource::Keep::all);
    MeshParams params;
    params.mode = MeshMode::inside;
    params.faces = build_.options.request.faces;
    params.enclose = Enclose::input;
    params.tighten = !build_.options.loose;
    params.least_part = kLeastPart;
    params.memory = build_.pieces();
    try {
      level.mesh = std::move(mesh_stream(source, build_.make_shelf, std::move(params), level.counts).front());
    } catch (const Error& e) {
      if (scale == 0 || e.code() != ErrorCode::bad_input) throw;
      return false;  // too thin to be meshed
    }
    level.reached = level.mesh.triangles.size() <= build_.options.request.faces.front();
    return true;
  }

  [[nodiscard]] static double volume_of(const LodLevel& level) { return level.counts.levels.front().measures.volume; }

  void mesh() {
    LodLevel& best = made_.level;
    int attempts = 0;
    for (double scale = 0; scale <= diagonal_ * kMostOpening; scale = scale == 0 ? 2 * voxel_ : 2 * scale) {
      LodLevel level;
      if (!mesh_at(scale, level)) break;
      ++attempts;
      const bool more = volume_of(level) > volume_of_best();
      if (best.reached && found_ && !more) break;
      if (!found_ || level.reached || level.mesh.triangles.size() < best.mesh.triangles.size()) {
        best = std::move(level);
        opening_ = scale;
        found_ = true;
      }
    }
    best.attempts = attempts;
  }
  [[nodiscard]] double volume_of_best() const { return found_ ? volume_of(made_.level) : 0; }

  void finish() {
    LodLevel& level = made_.level;
    const BuildOptions& o = build_.options;
    level.scale_world = scale_;
    level.error_world = level.distance_world = std::nan("");
    const std::uint64_t faces = o.request.faces.front();
    const GridFrame& frame = level.mesh.frame;
    OptionText text;  // bpcheck makes the voxels again from this (tools/check/hiding_recipe.h)
    text.add("mode", "inside").add("faces", faces).add("openings", scale_).add("element", name_of(o.element));
    text.add("walls", "opaque").add("voxel", frame.voxel);
    text.add("grid", fmt::format("{},{},{}", frame.origin[0], frame.origin[1], frame.origin[2]));
    text.add("opening", opening_).add("up", name_of(frame.up)).add("tighten", !o.loose);
    level.mesh.provenance = {make_provenance("bplod", text, made_.scene.counts.input_hash)};
    made_.more.update({{"hidden", double(hidden_.count) * std::pow(voxel_, 3)},
                       {"opening", opening_},
                       {"parts", level.counts.levels.front().measures.shells},
                       {"parts_dropped", level.counts.dropped_parts}});
    if (scale_ > 0)
      build_.note(fmt::format("openings narrower than {:.4g} are taken for closed; --scale 0 closes none", 2 * scale_));
    if (!level.reached)
      build_.note(
          fmt::format("{} faces instead of {}: no further edge can be merged", level.mesh.triangles.size(), faces));
  }

  Build& build_;
  MadeOccluder made_;
  double diagonal_ = 0, voxel_ = 0, scale_ = 0, opening_ = 0;
  HiddenVoxels hidden_;
  bool found_ = false;
};

}  // namespace

MadeOccluder make_occluder(Build& build) {
  return Occluder(build).run();
}

}  // namespace bp
