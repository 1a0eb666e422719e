#include "tools/info/leaks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/files/file.h"
#include "io/scene/part_names.h"
#include "io/scene/scene_reader.h"
#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "lib/device/backend.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/grid/shelf_stream.h"
#include "lib/levels/voxel_choice.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "tools/notes/leak_words.h"
#include "tools/pipe/voxelize_step.h"
#include "tools/run/memory_shares.h"
#include "tools/run/read_again.h"
#include "tools/run/scene_budget.h"

namespace bp {

namespace {

constexpr std::size_t kMostLeaks = kMostTrials;  // leaks that are told
constexpr double kSearchShare = 0.6;             // part of the memory; the bricks take another
constexpr double kDenseShare = 1.0 / 16;         // part of the search's memory for the voxels that it is given
constexpr double kBesideOpening = 1.733;         // sqrt(3), rounded up: cubes reach so much farther at an angle

std::string row_text(const PlacedLeak& leak, const GridFrame& frame, std::size_t number) {
  return fmt::format(
      "leak {:<6} {}, {:.3g} wide{}; {}\n"
      "  room      {:.4g}, up to {:.3g} wide; --scale {:.4g} fills it\n",
      number, place_text(middle_of(leak.place, frame), frame), leak.width * frame.voxel,
      parts_text("next to", leak.parts), scale_text(leak, frame), room_volume(leak, frame),
      2 * filling_scale(leak, frame), filling_scale(leak, frame));
}

Json row_json(const PlacedLeak& leak, const GridFrame& frame) {
  return {{"place", middle_of(leak.place, frame)},
          {"width", leak.width * frame.voxel},
          {"width_voxels", leak.width},
          {"least_scale", closing_scale(leak, frame)},
          {"shut_when_tried", leak.trial.answer == ShutTrial::Answer::shut},
          {"inside", middle_of(leak.inner, frame)},
          {"outside", middle_of(leak.outer, frame)},
          {"parts", leak.parts},
          {"room", {{"volume", room_volume(leak, frame)}, {"filled_at_scale", filling_scale(leak, frame)}}}};
}

}  // namespace

LeakMemory::LeakMemory(std::uint64_t memory) : shelf(VoxelizeBudget(memory).shelf) {
  const UsableMemory usable(memory, kVoxelProgram);
  search = part_of({usable.bytes, 1, usable.limit}, kSearchShare);
}

WallVoxels wall_voxels(VoxelOptions voxels, const CommonOptions& common) {
  voxels.fill = FillMode::none;
  if (!voxels.voxel && !voxels.resolution) voxels.resolution = kOccluderResolution;
  const VoxelizeBudget budget(common.memory_bytes);
  const LeakMemory memory(common.memory_bytes);
  SceneOptions how{voxels.format, budget.reader, common.temp};
  how.document = document_budget(common.memory_bytes, kVoxelProgram, voxels.scenes.size());
  how.walls_only = how.keep_degenerate = true;
  const auto source = open_scenes(voxels.scenes, how);
  WallVoxels walls;
  walls.bricks = make_shelf(budget.shelf, common.temp);
  ShelfSink sink(walls.bricks.get());
  const VoxelizeCounts counts = voxelize_stream(
      *source,
      [&](const StreamHeader& header, const VoxelizeCounts&) -> BrickSink& {
        require_leak_memory(header, memory.search);
        walls.header = header;
        return sink;
      },
      voxelize_options(voxels, common, budget));
  walls.header.scene = scene_files(voxels, counts);
  return walls;
}

void require_leak_memory(const StreamHeader& header, const MemoryShare& memory) {
  const VoxelBox bounds = voxel_bounds(header.frame, header.bounds);
  const MemoryShare dense = part_of(memory, kDenseShare), search = part_of(memory, 1 - kDenseShare);
  const auto voxels = std::uint64_t(voxels_of(bricks_of(bounds)).volume() / 8);
  const std::uint64_t searched = leaks_bytes(bounds);
  if (voxels > dense.bytes || searched > search.bytes)  // the number is for both steps
    throw NeedsMemory("looking for leaks", voxels + searched, memory.bytes,
                      std::max(dense.limit_for(voxels), search.limit_for(searched)), {Remedy::larger_voxels});
  check_outputs();
}

BitBox dense_voxels(const WallVoxels& walls) {
  BrickBox bricks;
  for (const BrickCoord at : walls.bricks->coords())
    bricks = hull(bricks, BrickBox{at, {at.x + 1, at.y + 1, at.z + 1}});
  BitBox voxels(voxels_of(bricks));
  load_voxels(*walls.bricks, voxels);
  return voxels;
}

LeakInfo leak_info(const StreamHeader& header, const BitBox& walls, const MemoryShare& memory) {
  const GridFrame& frame = header.frame;
  GroundedLeaks found =
      find_grounded_leaks(walls, ground_of(frame), {part_of(memory, 1 - kDenseShare), kMostLeaks, {}});
  LeakInfo info{frame, {}, 0, 0, double(found.closed_voxels) * std::pow(frame.voxel, 3), found.on_ground};
  info.is_filled = header.fill != FillMode::none;
  for (const Leak& leak : found.leaks) {
    if (info.leaks.size() < kMostLeaks) {
      info.leaks.push_back({leak, {}});
    } else {
      ++info.left_out;
      info.left_out_volume += room_volume(leak, frame);
    }
  }
  return info;
}

void name_parts(const StreamHeader& header, SceneOptions how, LeakInfo& info) {
  std::vector<PartNames> near(info.leaks.size());
  how.part_names = std::make_shared<PartNames>();
  how.part_names->of_triangle = [&](const std::string& name, const TriangleD& t) {
    for (std::size_t i = 0; i < near.size(); ++i) {
      const Leak& leak = info.leaks[i];
      const double distance = kBesideOpening * (leak.clearance + 0.5) * info.frame.voxel;
      if (distance_squared(middle_of(leak.place, info.frame), t) <= distance * distance) near[i].add(name);
    }
    return false;  // the part may lie beside other openings, too
  };
  try {
    read_again(header.scene, header.bounds, how, [](const TriangleD&) {});
  } catch (const Error&) {  // without names the places are told all the same
    return;
  }
  for (std::size_t i = 0; i < near.size(); ++i) info.leaks[i].parts = std::move(near[i].names);
}

std::string leak_text(const LeakInfo& info, const std::string& name) {
  std::string text = fmt::format("{}: leaks\nvoxel       {}\n", name, info.frame.voxel);
  if (info.on_ground) text += "ground      the scene stands on it\n";
  if (info.is_filled) {
    text += "closed      not known: the stream is filled; bpvox --fill none leaves rooms empty\n";
  } else {
    text += fmt::format("closed      {:.4g} that the outside does not reach\n", info.closed_volume);
  }
  for (std::size_t i = 0; i < info.leaks.size(); ++i) text += row_text(info.leaks[i], info.frame, i + 1);
  if (info.left_out > 0)
    text += fmt::format("more        {} leak{}, of rooms of {:.3g} together\n", info.left_out,
                        info.left_out == 1 ? "" : "s", info.left_out_volume);
  if (info.leaks.empty())
    text +=
        "leaks       none: what the outside reaches is nowhere wider than the way into it; open sides make no rooms\n";
  return text;
}

Json leak_json(const LeakInfo& info) {
  Json rows = Json::array();
  for (const PlacedLeak& leak : info.leaks) rows.push_back(row_json(leak, info.frame));
  return {{"kind", "leaks"},
          {"voxel", info.frame.voxel},
          {"up", name_of(info.frame.up)},
          {"ground", info.on_ground},
          {"closed_volume", info.is_filled ? Json(nullptr) : Json(info.closed_volume)},
          {"leaks", rows},
          {"left_out", {{"leaks", info.left_out}, {"volume", info.left_out_volume}}}};
}

}  // namespace bp
