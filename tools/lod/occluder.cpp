#include "tools/lod/occluder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/files/file.h"
#include "lib/check/counted.h"
#include "lib/core/error.h"
#include "lib/volume/entered.h"
#include "tools/lod/choices.h"
#include "tools/lod/lod_outputs.h"
#include "tools/notes/leak_words.h"
#include "tools/run/hiding_recipe.h"

namespace bp {

namespace {

constexpr double kLittle = 5e-3;  // of the bounds' volume
constexpr double kMuch = 0.3;     ///< of the bounds' volume: then no large rooms are missing
constexpr double kHalf = 0.5;     ///< of the hidden volume
// The share of hidden voxels that a note tells of if a body can enter them. It is 0.3 and more in houses. Inlets and
// wheels of machines are about at this share, and cabins above (docs/decisions/0019-occluders-behind-openings.md).
constexpr double kMuchEntered = 0.1;

double hidden_volume(const BuiltOccluder& built) {
  return double(built.hidden.voxels.count) * std::pow(built.scene.voxels.header.frame.voxel, 3);
}

double volume_of(const Bounds3d& b) {
  return (b.max[0] - b.min[0]) * (b.max[1] - b.min[1]) * (b.max[2] - b.min[2]);
}

HidingRecipe recipe_of(const BuildOptions& o, const BuiltOccluder& built) {
  const GridFrame& frame = built.scene.voxels.header.frame;
  const double body = o.rooms ? built.rooms.body_world : 0;
  return {frame, built.hidden.scale_world, o.closing.element, body, true, built.ground};
}

OptionText option_text(const BuildOptions& o, const BuiltOccluder& built) {
  OptionText text;
  text.add("mode", "inside").add("faces", built.made.faces_asked);
  add_recipe(recipe_of(o, built), text);
  return text.add("opening", built.made.opening_world).add("tighten", true);
}

double closed_gap(const BuildOptions& o, const BuiltOccluder& built) {
  return recipe_of(o, built).closed_gap();  // as bpcheck says
}

Json json_of(const BuildOptions& o, const BuiltOccluder& built) {
  Json tried = Json::array();
  const double voxel_volume = std::pow(built.scene.voxels.header.frame.voxel, 3);
  for (const HiddenScene::Tried& t : built.hidden.tried)
    tried.push_back({{"scale", t.scale_world}, {"hidden", double(t.hidden_voxels) * voxel_volume}});
  const MeshCounts& counts = built.made.level.counts;
  return {{"scales", tried},
          {"ground", built.ground},
          {"hidden", hidden_volume(built)},
          {"closed_gap", closed_gap(o, built)},
          {"body", built.rooms.body_world},
          {"entered", double(built.rooms.entrance.hidden) * voxel_volume},
          {"opening", built.made.opening_world},
          {"parts", counts.levels.front().measures.shells},
          {"parts_dropped", counts.dropped_parts}};
}

/// Returns where the scene leaks; nothing without the memory to look for it. Closings are tried around so many leaks.
std::optional<GroundedLeaks> leaks_of(Build& build, const VoxelizedScene& scene, std::size_t trials) {
  const VoxelBox bounds = voxel_bounds(scene.header.frame, scene.header.bounds);
  const MemoryShare& work = build.budget.work;
  if (leaks_bytes(bounds) + std::uint64_t(bounds.volume() / 4) > work.bytes) return {};
  build.report.begin("look for leaks");
  BitBox walls(bounds);
  load_voxels(*scene.solid, walls);
  return find_grounded_leaks(walls, ground_of(scene.header.frame), {work, trials, build.context().progress});
}

/// Returns "; " and a sentence about the largest leak.
std::string leak_clause(Build& build, const VoxelizedScene& scene) {
  const std::optional<GroundedLeaks> found = leaks_of(build, scene, 1);
  if (!found) return "; bpinfo --leaks tells where, with more --memory";
  if (found->leaks.empty()) return "; it has no room that is wider than the way into it";
  return "; " + leak_sentence(found->leaks.front(), scene.header.frame) + " (bpinfo --leaks shows it)";
}

/// Returns a note if the scale that was asked for fills rooms that a smaller one would enclose, and these are more than
/// all that is hidden.
std::string filled_note(Build& build, const BuiltOccluder& built) {
  const GridFrame& frame = built.scene.voxels.header.frame;
  const double scale = built.hidden.scale_world;
  const std::optional<GroundedLeaks> found = leaks_of(build, built.scene.voxels, 0);
  std::size_t rooms = 0;
  double volume = 0, below = 0;
  for (std::size_t i = 0; found && i < found->leaks.size(); ++i) {
    const Leak& leak = found->leaks[i];
    if (filling_scale(leak, frame) > scale) continue;
    ++rooms;
    volume += room_volume(leak, frame);
    below = std::max(below, filling_scale(leak, frame));
  }
  if (volume < hidden_volume(built)) return "";
  return fmt::format("--scale {:.4g} fills {} ({:.3g}) instead of closing openings; below {:.4g} more may be hidden",
                     scale, counted(rooms, "room"), volume, below);
}

/// Throws `failed` if the occluder holds less than --min-hidden.
void require_hidden(Build& build, const BuiltOccluder& built, double volume) {
  const double share = volume / volume_of(built.scene.voxels.header.bounds);
  if (!(share < build.options.min_hidden)) return;
  fail(ErrorCode::failed, "the occluder holds {:.2g} % of the scene's bounding box, less than --min-hidden {:.4g}%{}",
       100 * share, 100 * build.options.min_hidden, leak_clause(build, built.scene.voxels));
}

/// Returns a note about rooms that somebody can enter: what becomes of them, and where the entrance to filled ones is.
std::string rooms_note(const BuildOptions& o, const BuiltOccluder& built) {
  const auto& [body_world, entrance] = built.rooms;
  const GridFrame& frame = built.scene.voxels.header.frame;
  if (o.rooms && body_world == 0)
    return "--rooms open leaves no room open: none is so high that voxels could show its doors; name a height";
  const std::string body =
      fmt::format("a body {:.3g} high and {:.3g} wide, along the axes,", body_world, body_world * kBodyWidth);
  if (o.rooms) return fmt::format("rooms that {} can enter or reach into are left open", body);
  const double share = double(entrance.hidden) / double(built.hidden.voxels.count);
  if (share < kMuchEntered) return "";
  const VoxelBox& door = entrance.opening;
  const int up = ground_of(frame).axis;
  const VoxelCoord size = door.size(),
                   middle{floor_div(door.min.x + door.max.x, 2), floor_div(door.min.y + door.max.y, 2),
                          floor_div(door.min.z + door.max.z, 2)};
  return fmt::format(
      "{} can enter {:.2g} % of what is filled, by an opening {:.3g} wide and {:.3g} high at {}; --rooms "
      "open leaves such rooms open",
      body, 100 * share, std::max(size[(up + 1) % 3], size[(up + 2) % 3]) * frame.voxel, size[up] * frame.voxel,
      place_text(middle_of(middle, frame), frame));
}

void note(Build& build, const BuiltOccluder& built, double volume) {
  const MadeOccluder& made = built.made;
  const double hidden = hidden_volume(built), share = hidden / volume_of(built.scene.voxels.header.bounds);
  if (share < kLittle)
    build.note(fmt::format(
        "the scene hides {:.2g} % of its bounding box only: walls are missing, or wider open than {}{}", 100 * share,
        build.options.closing.scale ? "is closed; without --scale bplod looks for the one that hides enough"
                                    : "any scale closes that hides more",
        leak_clause(build, built.scene.voxels)));
  if (volume < kHalf * hidden)
    build.note(fmt::format("{} faces hold {:.2g} % of the volume that the scene hides; more --faces hold more",
                           made.level.mesh.triangles.size(), 100 * volume / hidden));
  if (build.options.closing.scale && built.hidden.scale_world > 0 && share < kMuch)
    build.note(filled_note(build, built));
  build.note(rooms_note(build.options, built));
  if (built.ground) build.note("the scene is open below: it is taken to stand on the ground, and eyes to be above it");
  if (built.hidden.scale_world > 0)
    build.note(fmt::format(
        "openings narrower than {:.4g} may count as closed, and then the rooms behind them are filled, as are "
        "valleys as narrow",
        closed_gap(build.options, built)));
  else if (!build.options.closing.scale)
    build.note(fmt::format("openings wider than {:.4g} stay open: closing them would hide little more",
                           closed_gap(build.options, built)));
  if (!made.level.reached)
    build.note(fmt::format("{} faces instead of {}: no further edge can be merged", made.level.mesh.triangles.size(),
                           made.faces_asked));
}

/// Returns what a scene hides, and what somebody enters there.
HiddenScene hidden_of(Build& build, const VoxelizedScene& scene, OccluderRequest request, const char* pass,
                      EnteredRooms& rooms) {
  const std::optional<Length>& body = build.options.rooms;
  const StreamHeader& header = scene.header;
  std::optional<Entered> entered;
  if (body)
    entered = entered_by(header, *scene.solid, body->in_world(header.bounds.diagonal(), header.frame.voxel),
                         request.hidden.context);
  if (entered) {
    std::uint64_t& memory = request.hidden.context.memory.bytes;
    memory -= std::min(memory, std::uint64_t(entered->voxels.word_count()) * sizeof(std::uint64_t));
    request.hidden.entered = &entered->voxels;
  }
  build.report.begin("close openings");
  HiddenScene hidden = hidden_scene(header, *scene.solid, build.backends, request, pass);
  if (!body && hidden.scale_world > 0 && hidden.voxels.count > 0) {
    try {
      entered = entered_by(header, *scene.solid, 0, request.hidden.context);
      if (entered) rooms.entrance = entrance_of(entered->voxels, *hidden.voxels.voxels);
    } catch (const NeedsMemory&) {  // there is a note less
    }
  }
  rooms.body_world = entered ? entered->body_world : 0;
  return hidden;
}

BuiltOccluder make(Build& build) {
  const BuildOptions& o = build.options;
  BuiltOccluder built;
  built.scene = read_scene(build, {});
  const StreamHeader& header = built.scene.voxels.header;
  const LevelRequest levels = request_of(o, header.bounds.diagonal(), header.frame.voxel);
  OccluderRequest request{levels.faces.empty() ? 0 : levels.faces.front(),
                          levels.scale_world,
                          {0, o.closing.element, nullptr, build.context()}};
  naming_limit([] { check_outputs(); },
               [&] { return occluder_limit_before(header, *built.scene.voxels.solid, request); });
  built.hidden = hidden_of(build, built.scene.voxels, request, "closing openings", built.rooms);
  const std::uint64_t without = built.hidden.voxels.count;
  if (can_read_again(o) && may_gain_on_ground(header, without)) {
    request.more_than_voxels = kGroundGains * double(without);
    EnteredRooms rooms;
    HiddenScene grounded = hidden_of(build, read_scene(build, {0, nullptr, true, false}).voxels, request,
                                     "closing openings above the ground", rooms);
    built.ground = gains_on_ground(grounded.voxels.count, without);
    if (built.ground) built.hidden = std::move(grounded), built.rooms = rooms;
  }
  if (built.hidden.voxels.count == 0)
    fail(ErrorCode::bad_input,
         "the scene hides nothing: it is open, also at a scale of {:.4g}, or thinner than its voxels of {:.4g}{}; try "
         "another --scale, or smaller voxels{}",
         built.hidden.scale_world, header.frame.voxel, leak_clause(build, built.scene.voxels),
         o.rooms ? ", or --rooms filled" : "");
  build.report.begin("mesh");
  naming_limit([] { check_outputs(); }, [&] { return occluder_limit(header, built.hidden, request); });
  built.made = make_occluder(header, built.hidden, build.backends, request);
  return built;
}

}  // namespace

BuiltOccluder built_occluder(Build& build) {
  BuiltOccluder built = make(build);
  LodLevel& level = built.made.level;
  const OptionText text = option_text(build.options, built);
  level.mesh.provenance = {make_provenance("bplod", text, built.scene.voxels.counts.input_hash)};
  const double volume = facts_of(level, {}).volume;
  require_hidden(build, built, volume);
  note(build, built, volume);
  return built;
}

void build_occluder(const BuildOptions& o) {
  OutputFolder out(o.out, profile_files(o.profile, o.name, 1), o.common.overwrite);
  Build build(o);
  BuiltOccluder built = built_occluder(build);
  LodLevel& level = built.made.level;
  const LevelFacts facts = facts_of(level, {});
  build.progress.end();
  build.report.begin("write");
  const Json more = json_of(o, built);
  CompleteLevels made;
  made.levels.push_back(std::move(level));
  const StreamHeader& header = built.scene.voxels.header;
  const Vec3d origin = origin_of(o.proxy.origin, header.frame, header.bounds);
  const WrittenFile file = write_profile(o, made, 0, origin, {}, out).front();
  out.commit();
  LevelRow row = row_of(facts, file.name, out.bytes(file.name));
  row.more.update(more);
  if (origin != Vec3d{}) build.report.counts["origin"] = origin;
  finish(build, built.scene.told(), {row}, out.bytes());
}

}  // namespace bp
