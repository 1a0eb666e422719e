// bpmesh: stream of voxels in, proxy out. Manual: docs/bpmesh.1.md
#include <algorithm>
#include <optional>

#include "io/files/file.h"
#include "io/mesh/mesh_writer.h"
#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "tools/cli/report.h"
#include "tools/cli/run_tool.h"
#include "tools/mesh/mesh_options.h"
#include "tools/mesh/mesh_report.h"
#include "tools/mesh/mesh_step.h"
#include "tools/mesh/shortfalls.h"
#include "tools/notes/estimate.h"
#include "tools/notes/proportion.h"
#include "tools/notes/up_note.h"
#include "tools/run/memory_shares.h"
#include "tools/run/origin.h"

namespace {

/// Notes that a glTF lies far from its origin, or was moved nearer. Other formats hold doubles, or refuse.
void note_origin(bp::Report& report, const bp::MeshOptions& o, const bp::StreamHeader& header, bp::MeshFormat format) {
  const bool gltf = format == bp::MeshFormat::glb || format == bp::MeshFormat::gltf;
  if (!gltf && o.proxy.origin.kind != bp::OriginOption::Kind::automatic) return;
  const bool tells = format != bp::MeshFormat::stl;
  if (const std::string text = origin_note(o.proxy.origin, header.frame, header.bounds, tells); !text.empty())
    report.note(text, o.common);
}

/// Notes a scale field by which nobody closed, and the up axis of the scene if the format has one of its own.
void note_stream(bp::Report& report, const bp::MeshOptions& o, const bp::StreamHeader& header, bp::MeshFormat format) {
  if (header.has_field && !header.has_closing)
    report.note("the stream has a scale field, and was not closed by it; bpclose goes between bpscale and bpmesh",
                o.common);
  if (format != bp::MeshFormat::glb && format != bp::MeshFormat::gltf) return;
  if (const std::string text = bp::up_note(header); !text.empty()) report.note(text, o.common);
}

void note_estimate(bp::Report& report, const bp::MeshOptions& o, const bp::StreamHeader& header, bp::Enclose enclosed) {
  const bool scene = enclosed == bp::Enclose::scene;
  const double effort = (o.error() ? bp::kErrorEffort : 1) * (scene ? bp::kSceneEffort : 1);
  bp::Estimate estimate = bp::estimate_mesh(header.bounds, header.frame.voxel, effort);
  if (scene) estimate.bytes += bp::kBytesOfEnclosed * double(header.scene.triangles);
  const std::string text = bp::estimate_note(estimate, o.common.memory_bytes);
  if (!text.empty()) report.note(text, o.common);
}

/// Opens one file for each level.
std::vector<std::unique_ptr<bp::OutputFile>> open_outputs(const bp::MeshOptions& o) {
  std::vector<std::unique_ptr<bp::OutputFile>> outputs;
  for (std::size_t i = 0; i < std::max<std::size_t>(o.levels.faces.size(), 1); ++i)
    outputs.push_back(bp::open_output(bp::level_name(o, i), o.common.overwrite));
  return outputs;
}

void run(bp::MeshOptions o) {
  const bp::MeshFormat format = bp::output_format(o);
  bp::Report report("bpmesh");
  report.begin("read and mesh");
  const std::vector<std::unique_ptr<bp::OutputFile>> outputs = open_outputs(o);
  bp::BrickReader source(o.in);
  if (!o.proxy.mode_given && source.header().fill == bp::FillMode::inside) o.proxy.mode = bp::MeshMode::inside;
  const bp::Vec3d origin = bp::origin_of(o.proxy.origin, source.header().frame, source.header().bounds);
  bp::MeshParams params = bp::mesh_params(o, source.header());
  bp::PassContext context;
  context.pieces = bp::mesh_memory(o.common);
  context.make_shelf = bp::make_shelf_factory(bp::MeshBudget(o.common.memory_bytes).shelves, o.common.temp);
  const std::string enclosed = bp::set_enclosure(o, source, params, context, nullptr, report);
  note_estimate(report, o, source.header(), params.enclose);
  note_stream(report, o, source.header(), format);
  const bool closed_by_scale = source.header().has_closing && source.header().scale.constant();
  const bp::ShortfallFacts facts{params.error_world, closed_by_scale, bp::volume_of(params.scene)};
  bp::naming_limit([] { bp::check_outputs(); },
                   [&] { return bp::mesh_limit(source, context, params, params.scene.size()); });
  bp::MeshCounts counts;
  std::vector<bp::LatticeMesh> levels = bp::mesh_stream(source, context, std::move(params), counts);
  report.bytes_in = source.totals().bytes;

  report.begin("write");
  bp::tell_steps(levels, o, {source.header(), source.totals().checksum(), enclosed});
  for (std::size_t i = 0; i < levels.size(); ++i)
    bp::write_mesh(levels[i], *outputs[i], format, bp::write_options(o.proxy.mode, origin));
  bp::OutputFile::commit_all(outputs);
  for (const auto& output : outputs) report.bytes_out += output->bytes();
  bp::fill_report(report, o, counts);
  if (origin != bp::Vec3d{}) report.counts["origin"] = origin;
  note_origin(report, o, source.header(), format);
  report.counts["enclosed"] = enclosed;
  bp::note_shortfalls(report, o, counts, facts);
  report.write(o.common);
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpmesh", argc, argv, bp::parse_mesh_options, run);
}
