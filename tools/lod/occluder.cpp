#include "tools/lod/occluder.h"

#include <fmt/format.h>

#include <cmath>

#include "tools/cli/names.h"
#include "tools/lod/choices.h"
#include "tools/lod/lod_outputs.h"
#include "tools/run/hiding_recipe.h"

namespace bp {

namespace {

constexpr double kLittle = 5e-3;  // of the volume of the bounds
constexpr double kHalf = 0.5;     ///< of what is hidden

double hidden_volume(const MadeOccluder& made) {
  return double(made.hidden_voxels) * std::pow(made.scene.header.frame.voxel, 3);
}

double volume_of(const Bounds3d& b) {
  return (b.max[0] - b.min[0]) * (b.max[1] - b.min[1]) * (b.max[2] - b.min[2]);
}

OptionText option_text(const BuildOptions& o, const MadeOccluder& made) {
  const GridFrame& frame = made.scene.header.frame;
  OptionText text;
  text.add("mode", "inside").add("faces", made.faces_asked);
  add_recipe({{frame, made.scale_world, o.closing.element}, true, made.ground, frame.up}, text);
  return text.add("opening", made.opening_world).add("tighten", true);
}

Json json_of(const MadeOccluder& made) {
  Json tried = Json::array();
  const double voxel_volume = std::pow(made.scene.header.frame.voxel, 3);
  for (const MadeOccluder::Tried& t : made.tried)
    tried.push_back({{"scale", t.scale_world}, {"hidden", double(t.hidden_voxels) * voxel_volume}});
  return {{"scales", tried},
          {"ground", made.ground},
          {"hidden", hidden_volume(made)},
          {"opening", made.opening_world},
          {"parts", made.level.counts.levels.front().measures.shells},
          {"parts_dropped", made.level.counts.dropped_parts}};
}

void note(Build& build, const MadeOccluder& made, double volume) {
  const double hidden = hidden_volume(made), share = hidden / volume_of(made.scene.header.bounds);
  if (share < kLittle)
    build.note(fmt::format(
        "the scene hides {:.2g} % of its bounding box only: walls are missing, or wider open than {}", 100 * share,
        build.options.closing.scale ? "is closed; without --scale bplod looks for the one that hides enough"
                                    : "any scale closes that hides more"));
  if (volume < kHalf * hidden)
    build.note(fmt::format("{} faces hold {:.2g} % of the volume that the scene hides; more --faces hold more",
                           made.level.mesh.triangles.size(), 100 * volume / hidden));
  if (made.ground) build.note("the scene is open below: it is taken to stand on the ground, and eyes to be above it");
  if (made.scale_world > 0)
    build.note(
        fmt::format("openings narrower than {:.4g} are taken for closed, and the rooms behind them are filled, as are "
                    "valleys as narrow; --scale 0 keeps free what one enters",
                    2 * made.scale_world));
  else if (!build.options.closing.scale)
    build.note("openings stay open: closing them would hide little more");
  if (!made.level.reached)
    build.note(fmt::format("{} faces instead of {}: no further edge can be merged", made.level.mesh.triangles.size(),
                           made.faces_asked));
}

}  // namespace

void build_occluder(const BuildOptions& o) {
  OutputFolder out(o.out, profile_files(o.profile, o.name, 1), o.common.overwrite);
  Build build(o);
  MadeOccluder made = make_occluder(build);
  made.level.mesh.provenance = {make_provenance("bplod", option_text(o, made), made.scene.counts.input_hash)};
  const LevelFacts facts = facts_of(made.level, {});
  note(build, made, facts.volume);
  build.progress.end();
  build.report.begin("write");
  const Json more = json_of(made);
  std::vector<LodLevel> levels;
  levels.push_back(std::move(made.level));
  const StreamHeader& header = made.scene.header;
  const Vec3d origin = origin_of(o.proxy.origin, header.frame, header.bounds);
  const WrittenFile file = write_profile(o, levels, 0, origin, out).front();
  out.commit();
  LevelRow row = row_of(facts, file.name, out.bytes(file.name));
  row.more.update(more);
  if (origin != Vec3d{}) build.report.counts["origin"] = origin;
  build.finish(made.scene, {row}, out.bytes());
}

}  // namespace bp
