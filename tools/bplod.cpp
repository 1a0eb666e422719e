// bplod: scenes in, levels of detail out, in one process. Manual: docs/bplod.1.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/cli/run_tool.h"
#include "tools/lod/build.h"
#include "tools/lod/explain.h"
#include "tools/lod/level_chain.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/occluder.h"
#include "tools/lod/tile_build.h"

namespace {

/// What the list says of a file. How far hulls are from the scene is not measured.
bp::LevelRow row_of(const bp::WrittenFile& file, const std::vector<bp::LodLevel>& levels, const bp::OutputFolder& out) {
  bp::LevelRow row = bp::row_of(levels[file.level], file.name, out.bytes(file.name));
  if (file.is_level) return row;
  row.faces = file.faces;
  row.error_world = std::nan("");
  row.more = {{"hulls", file.hulls}, {"hull_volume_over_level", file.hull_volume}};
  return row;
}

/// What is said of levels with more faces than the scene has triangles; else empty.
std::string heavier_note(const std::vector<bp::LodLevel>& levels, std::uint64_t triangles) {
  const std::uint64_t faces = levels.front().mesh.triangles.size();
  if (faces <= std::max(triangles, bp::kLeastFaces)) return "";
  return fmt::format("level 0 has {} faces, and the scene {} triangles; --faces 50% makes half as many", faces,
                     triangles);
}

/// One mesh a level.
void run_chain(const bp::BuildOptions& o) {
  bp::OutputFolder out(o.out, bp::profile_files(o.profile, o.name, bp::level_count(o.request)), o.common.overwrite);
  bp::Build build(o);
  const auto [scene, levels] = bp::make_chain(build);
  const bp::Vec3d origin = bp::origin_of(o.origin, scene.header.frame, scene.header.bounds);
  for (std::size_t i = levels.size(); i < bp::level_count(o.request); ++i)  // as many as there may be
    out.leave_out(bp::level_name(o.name, i) + ".glb");
  build.progress.end();
  if (const std::string text = heavier_note(levels, scene.counts.scene.triangles); !text.empty()) build.note(text);
  build.report.stage("write");
  const std::vector<bp::WrittenFile> files = bp::write_profile(o, levels, scene.header.bounds.diagonal(), origin, out);
  out.commit();
  std::vector<bp::LevelRow> rows;
  for (const bp::WrittenFile& file : files) {
    rows.push_back(row_of(file, levels, out));
    if (!file.note.empty()) build.note(file.note);
  }
  if (origin != bp::Vec3d{}) build.report.counts["origin"] = origin;
  build.finish(scene, rows, out.bytes());
}

/// One mesh within the scene.
void run_occluder(const bp::BuildOptions& o) {
  bp::OutputFolder out(o.out, bp::profile_files(o.profile, o.name, 1), o.common.overwrite);
  bp::Build build(o);
  bp::MadeOccluder made = bp::make_occluder(build);
  build.progress.end();
  build.report.stage("write");
  const std::vector<bp::LodLevel> levels{std::move(made.level)};
  const bp::StreamHeader& header = made.scene.header;
  const bp::Vec3d origin = bp::origin_of(o.origin, header.frame, header.bounds);
  const bp::WrittenFile file = bp::write_profile(o, levels, 0, origin, out).front();
  out.commit();
  bp::LevelRow row = bp::row_of(levels.front(), file.name, out.bytes(file.name));
  row.more.update(made.more);
  if (origin != bp::Vec3d{}) build.report.counts["origin"] = origin;
  build.finish(made.scene, {row}, out.bytes());
}

void run(const bp::BuildOptions& o) {
  if (o.explain) return bp::explain(o);
  if (o.profile == bp::LodProfile::occluder) return run_occluder(o);
  o.profile == bp::LodProfile::tiles ? bp::build_tileset(o) : run_chain(o);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bplod", argc, argv, bp::parse_build_options, run);
}
