// bplod: scenes in, levels of detail out, in one process. Manual: docs/bplod.1.md
#include "tools/common/run_tool.h"
#include "tools/lod/build.h"
#include "tools/lod/explain.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/tile_build.h"

namespace {

/// The file of a level; of a collision mesh, one of its three.
std::string file_of(const bp::BuildOptions& o, std::size_t level) {
  return o.profile == bp::LodProfile::collision ? o.name + "_godot.glb" : bp::level_name(o.name, level) + ".glb";
}

/// One mesh a level.
void run_chain(const bp::BuildOptions& o) {
  bp::OutputFolder out(o.out, bp::profile_files(o.profile, o.name, bp::level_count(o.request)), o.common.overwrite);
  bp::Build build(o);
  bp::VoxelizedScene scene = build.voxelize(0);
  build.report.stage("measure the scene");
  bp::LodChain chain(scene.header, std::move(scene.solid), build.backends, build.lod_options());
  std::vector<bp::LodLevel> levels;
  for (std::size_t i = 0; i < bp::level_count(o.request); ++i) {
    levels.push_back(
        build.make_level(chain, i, 0, scene.header.frame.voxel, scene.header.bounds, scene.counts.input_hash));
    if (i > 0) levels[i].error_world = std::max(levels[i].error_world, levels[i - 1].error_world);
  }
  build.progress.end();
  build.report.stage("write");
  bp::write_profile(o.profile, o.name, levels, scene.header.bounds.diagonal(), o.mode == bp::MeshMode::fit, out);
  out.commit();
  std::vector<bp::LevelRow> rows;
  for (std::size_t i = 0; i < levels.size(); ++i)
    rows.push_back(bp::row_of(levels[i], file_of(o, i), out.bytes(file_of(o, i))));
  build.finish(scene, rows, out.bytes());
}

void run(const bp::BuildOptions& o) {
  if (o.explain) return bp::explain(o);
  o.profile == bp::LodProfile::tiles ? bp::build_tileset(o) : run_chain(o);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bplod", argc, argv, bp::parse_build_options, run);
}
