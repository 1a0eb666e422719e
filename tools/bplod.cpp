// bplod: scenes in, levels of detail out, in one process. Manual: docs/bplod.1.md
#include <cmath>

#include "tools/cli/input_list.h"
#include "tools/cli/run_tool.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/choices.h"
#include "tools/lod/collision/collision_files.h"
#include "tools/lod/collision/nearer_hulls.h"
#include "tools/lod/explain.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/occluder.h"
#include "tools/lod/options/parse_options.h"
#include "tools/lod/scene/complete_levels.h"
#include "tools/lod/tile_build.h"
#include "tools/lod/tiles/visual_tileset.h"

namespace {

/// Returns the row of a file. The distance of hulls to the scene is not measured.
bp::LevelRow row_of(const bp::WrittenFile& file, const std::vector<bp::LevelFacts>& levels,
                    const bp::OutputFolder& out) {
  std::uint64_t bytes = out.bytes(file.name);
  for (const std::string& name : file.beside) bytes += out.bytes(name);
  bp::LevelRow row = bp::row_of(levels[file.level], file.name, bytes);
  if (file.is_level) return row;
  row.faces = file.faces;
  row.error_world = std::nan("");
  row.more = {{"hulls", file.hulls}, {"hull_volume_over_level", file.hull_volume}};
  return row;
}

/// Returns the names of the files to come; `most`: number of levels.
std::vector<std::string> files_of(const bp::BuildOptions& o, std::size_t most) {
  if (o.profile == bp::LodProfile::collision) return bp::collision_files(o);
  return o.obj ? bp::obj_files(o, most) : bp::profile_files(o.profile, o.name, most);
}

std::vector<bp::WrittenFile> write_files(bp::Build& build, const bp::MadeChain& chain, const bp::Vec3d& origin,
                                         bp::OutputFolder& out) {
  const bp::BuildOptions& o = build.options;
  const std::vector<bp::LodLevel>& levels = chain.made.levels;
  if (o.profile == bp::LodProfile::collision) {
    build.report.begin("hulls");
    const bp::ConvexParts hulls = bp::nearer_hulls(build, chain);
    build.report.begin("write");
    return bp::write_collision_files(o, levels.front().mesh, hulls, origin, out);
  }
  build.report.begin("write");
  if (o.obj) return bp::write_obj_levels(o, levels, origin, out);
  bp::LeafLooks looks{chain.scene.textures.get(), {}, o.colors() && chain.scene.has_colors(), o.compression()};
  looks.broken = chain.made.broken;
  looks.spare_places = true;
  return bp::write_profile(o, chain.made, chain.scene.voxels.header.bounds.diagonal(), origin, looks, out);
}

/// Builds levels of one mesh each.
void build_chain(const bp::BuildOptions& o) {
  const std::size_t most = bp::level_count(request_of(o));
  bp::OutputFolder out(o.out, files_of(o, most), o.common.overwrite);
  bp::Build build(o);
  bp::MadeChain chain = bp::make_chain(build);
  auto& [scene, room, parts, made] = chain;
  bp::bake_levels(build, scene, made);
  build.progress.end();
  bp::note_chain(build, chain);
  const bp::StreamHeader& header = scene.voxels.header;
  const bp::Vec3d origin = bp::origin_of(o.proxy.origin, header.frame, header.bounds);
  for (std::size_t i = made.levels.size(); i < most; ++i)  // there may be as many
    out.leave_out(bp::level_name(o.name, i) + ".glb");
  if (o.profile == bp::LodProfile::gltf) bp::take_away_longer_list(o, most, out);
  const std::vector<bp::WrittenFile> files = write_files(build, chain, origin, out);
  out.commit();
  std::vector<bp::LevelRow> rows;
  for (const bp::WrittenFile& file : files) {
    rows.push_back(row_of(file, made.facts, out));
    if (o.proxy.visual) rows.back().more["from"] = made.scene_of(file.level) != nullptr ? "scene" : "fit";
    build.note(file.note);
  }
  if (origin != bp::Vec3d{}) build.report.counts["origin"] = origin;
  bp::finish(build, scene.told(room.margin_world), rows, out.bytes());
}

void make(const bp::BuildOptions& o) {
  if (o.shows_scene()) return o.explain ? bp::explain_visual_tileset(o) : bp::build_visual_tileset(o);
  if (o.explain) return bp::explain(o);
  if (o.profile == bp::LodProfile::occluder) return bp::build_occluder(o);
  o.is_tileset() ? bp::build_tileset(o) : build_chain(o);
}

void run(const bp::BuildOptions& o) {
  bp::InputList inputs(o.inputs, o.common.overwrite);
  make(o);
  inputs.write();
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bplod", argc, argv, bp::parse_build_options, run);
}
