// bpvox: scenes in, a stream of solid bricks out. Manual: docs/bpvox.1.md
#include <algorithm>
#include <optional>

#include "io/files/file.h"
#include "io/scene/scene_reader.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/levels/voxel_choice.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "tools/cli/options/voxel.h"
#include "tools/cli/output_name.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/notes/estimate.h"
#include "tools/pipe/voxelize_step.h"
#include "tools/run/memory_shares.h"
#include "tools/run/provenance.h"
#include "tools/run/scene_budget.h"

namespace {

struct Options {
  bp::CommonOptions common;
  bp::VoxelOptions voxels;
  std::string out = "-";
};

Options parse(bp::Args& args) {
  Options o;
  args.about("Turns scenes of any size into a stream of voxels: all voxels that the surface touches, and the inside.");
  args.example("bpvox scene.glb --resolution 256 | bpclose --scale 2% | bpmesh --faces 1000 -o proxy.glb");
  o.voxels.add_scenes(args, "scenes, voxelized together");
  args.option("-o,--output", "FILE", o.out, "stream of voxels; - is stdout");
  o.voxels.add_with_inside(args, std::to_string(bp::kDefaultResolution));
  o.common.add_to(args, bp::CommonOptions::all_parts & ~unsigned(bp::CommonOptions::device_part));
  args.removed("--device", "bpvox always computes on the CPU");
  args.often({"--output", "--voxel", "--resolution", "--fill", "--up", "--overwrite"});
  args.parse();
  o.voxels.check();
  bp::check_stream_name(o.out);
  return o;
}

void fill_report(bp::Report& report, const Options& o, const bp::StreamHeader& header, const bp::VoxelizeCounts& c,
                 const bp::SceneOptions& scene) {
  report.options["options"] = header.provenance.back().options;
  report.options["memory"] = o.common.memory_bytes;
  report.bytes_in = bp::size_of_files(o.voxels.scenes);
  report.counts["triangles"] = c.scene.triangles;
  report.counts["degenerate"] = c.scene.degenerate;
  report.counts["non_finite"] = c.scene.non_finite;
  report.counts["bad_faces"] = c.scene.bad_faces;
  report.counts["instances"] = c.scene.instances;
  report.counts["voxel_asked"] = c.voxel_asked;
  report.counts["voxel"] = header.frame.voxel;
  const bp::BrickCoord bricks = header.bricks.size();
  report.counts["grid_bricks"] = {bricks.x, bricks.y, bricks.z};
  report.counts["tiles"] = c.tiles;
  report.counts["tiles_touched"] = c.tiles_touched;
  report.counts["surface_voxels"] = c.surface_voxels;
  report.counts["solid_voxels"] = c.solid_voxels;
  report.counts["bricks"] = c.bricks;
  report.counts["full_bricks"] = c.full_bricks;
  report.counts["open_columns"] = c.open_columns;
  report.counts["scene_read_twice"] = c.read_twice;
  report.counts["scratch_bytes"] = c.scratch_bytes;
  note_voxels(report, o.common, header, c, {o.voxels.scenes, scene});
}

void run(const Options& o) {
  bp::Report report("bpvox");
  bp::Progress progress("bpvox", o.common.progress);
  const bp::VoxelizeBudget budget(o.common.memory_bytes);
  bp::SceneOptions scene{o.voxels.format, budget.reader, o.common.temp};
  scene.document = bp::document_budget(o.common.memory_bytes, bp::kVoxelProgram, o.voxels.scenes.size());
  scene.keep_degenerate = true;
  const auto source = bp::open_scenes(o.voxels.scenes, scene);
  const auto file = bp::open_output(o.out, o.common.overwrite);
  std::optional<bp::BrickWriter> writer;
  bp::StreamHeader header;
  report.begin("read");
  const auto open = [&](const bp::StreamHeader& h, const bp::VoxelizeCounts& counts) -> bp::BrickSink& {
    report.begin("voxelize");
    header = h;
    const bp::Estimate estimate =
        bp::estimate_voxelize(h.bounds, h.frame.voxel, bp::most_touched_voxels(counts, h.frame.voxel));
    bp::note_estimate(estimate, o.common, progress, report);
    header.provenance.push_back(bp::make_provenance(
        "bpvox", bp::voxelize_text(o.voxels, h.frame.up, o.voxels.tell_up() || source->up()), counts.input_hash));
    header.scene = bp::scene_files(o.voxels, counts);
    bp::check_outputs();
    return writer.emplace(*file, header);
  };
  bp::VoxelizeOptions options = bp::voxelize_options(o.voxels, o.common, budget);
  options.context.progress = progress.for_pass();
  const bp::VoxelizeCounts counts = bp::voxelize_stream(*source, open, options);
  writer->finish();
  file->commit();
  progress.end();
  report.bytes_out = file->bytes();
  fill_report(report, o, header, counts, scene);
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpvox", argc, argv, parse, run);
}
