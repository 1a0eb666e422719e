#include "tools/lod/scene/complete_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/files/file.h"
#include "lib/core/error.h"
#include "lib/levels/cage_voxels.h"
#include "lib/levels/lod_chain.h"
#include "lib/pass/color/vertex_colors.h"
#include "tools/cli/names.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/choices.h"
#include "tools/lod/scene/scene_levels.h"
#include "tools/run/scale_rules.h"

namespace bp {

namespace {

void complete(const Build& build, const Completion& with, LodLevel& level, std::size_t number,
              const LodTarget& target) {
  const auto& [scene, room, looks, input_hash] = with;
  if (room.margin_world > 0) level.error_world += farthest_of_margin(room.margin_world, room.voxel);
  if (scene.colors != nullptr) {
    scene.colors->prepare(level.mesh.frame);
    color_vertices(level.mesh, scene.colors->all(level.mesh.frame));
  }
  if (looks != nullptr)
    level.mesh.texture =
        level_texture(build, scene, level.mesh, {level.error_world, target.error_world, level.scale_world}, *looks,
                      texture_memory(build));
  const BuildOptions& o = build.options;
  OptionText text = option_text(o, scene.enclosed, target, number, level.scale_world, level.mesh.frame);
  if (scene.colors != nullptr) text.add("colors", "auto");
  if (room.margin_world > 0) text.add("margin", room.margin_world);
  if (room.plane) text.add("symmetry", name_of(Symmetry(room.plane->axis)));
  if (scene.field) text.add("field", provenance_text(*scene.field));
  if (scene.textured) text.add("appearance", o.full() ? "full" : "texture");
  level.mesh.provenance = {make_provenance("bplod", text, input_hash)};
}

/// Returns the name of the report's stage in which levels of these numbers are made.
std::string text_of(const std::vector<std::size_t>& numbers) {
  if (numbers.size() == 1) return fmt::format("level {}", numbers[0]);
  return fmt::format("levels {} to {}", numbers.front(), numbers.back());
}

}  // namespace

CompleteLevels make_levels(Build& build, LodChain& chain, const ChainRange& range, const Completion& completion) {
  LevelSequence sequence(chain, range);
  for (std::vector<std::size_t> numbers; !(numbers = sequence.next()).empty();) {
    build.report.begin(text_of(numbers));
    sequence.make_next();
  }
  auto [made, left_out] = sequence.take();
  CompleteLevels out;
  out.left_out = std::move(left_out);
  if (completion.looks != nullptr) build.report.begin("textures");
  for (auto& [level, target] : made) {
    complete(build, completion, level, range.first + out.levels.size(), target);
    out.facts.push_back(facts_of(level, target));
    out.levels.push_back(std::move(level));
  }
  return out;
}

namespace {

std::vector<LodTarget> targets_of(const LevelRequest& request) {
  std::vector<LodTarget> targets;
  for (std::size_t i = 0; i < level_count(request); ++i) targets.push_back(level_target(request, i, 0, 0));
  return targets;
}

}  // namespace

std::unique_ptr<SceneLooks> hold_looks(Build& build, const LodScene& scene) {
  if (!scene.textured && !build.options.leaves) return nullptr;
  build.report.begin("textures");
  return read_looks(build, scene, part_of(build.budget.work, kLooksBeside));
}

MemoryShare texture_memory(const Build& build) {
  return part_of(build.budget.work, 0.1);
}

namespace {

/// Makes the levels of a chain that has its scene.
void make_levels(Build& build, MadeChain& chain) {
  const BuildOptions& o = build.options;
  VoxelizedScene& voxels = chain.scene.voxels;
  chain.parts = parts_of(voxels, o, build.budget.work.bytes);
  if (o.is_cage()) chain.room = make_room(build, chain.scene);
  const StreamHeader& header = voxels.header;
  const double diagonal = header.bounds.diagonal();
  LevelRequest request = request_for(o, chain.scene.size.triangles, diagonal, header.frame.voxel);
  std::optional<SceneLevels> own;
  if (o.proxy.visual) {
    naming_limit([] { check_outputs(); },
                 [&] {
                   return std::max(levels_limit(chain.scene, lod_options(build, chain.scene, chain.room)),
                                   SceneLevels::limit(build, chain.scene, targets_of(request)));
                 });
    own.emplace(build, chain.scene, targets_of(request));
    request.faces = own->open();
    request.levels = request.faces.size();
    request.is_chosen = false;  // SceneLevels knows which levels are worth having
  }
  if (level_count(request) > 0) {
    build.report.begin("measure the scene");
    LodOptions options = complete_options(build, chain.scene, chain.room);
    LodChain levels(header, std::move(voxels.solid), build.backends, std::move(options));
    const ChainRange range{request, 0, level_count(request), diagonal, is_named(voxel_request(o, diagonal))};
    chain.made = make_levels(build, levels, range, {chain.scene, chain.room, nullptr, voxels.counts.input_hash});
  }
  if (own) chain.made = own->with(std::move(chain.made));
}

/// Returns the limit on memory at which the images of the scene fit.
std::uint64_t images_limit(const Build& build, const LodScene& scene) {
  if (!build.options.proxy.visual) return looks_limit(build, scene, kLooksAfter);
  return std::max(looks_limit(build, scene, kLooksBeside), SceneLevels::images_limit(build, scene));
}

}  // namespace

MadeChain make_chain(Build& build) {
  MadeChain chain{read_scene(build, {0, nullptr, false, true}), {}, {}, {}};
  naming_limit([&] { make_levels(build, chain); }, [&] { return images_limit(build, chain.scene); });
  return chain;
}

void note_chain(Build& build, const MadeChain& chain) {
  const CompleteLevels& made = chain.made;
  note_levels(build, made.facts, 0, made.left_out, chain.scene.size);
  const LevelFacts& finest = made.facts.front();
  const bool asked = asks_for_faces(request_of(build.options));
  build.note(heavier_note(finest, asked, chain.scene.size.triangles));
  if (made.scene_of(0) != nullptr) return;
  const std::string joined =
      joined_note(finest, made.levels.front().counts.levels.front().measures.shells, chain.parts);
  build.note(joined.empty() && !asked ? closed_note(finest) : joined);
}

}  // namespace bp
