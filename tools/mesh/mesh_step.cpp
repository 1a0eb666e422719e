#include "tools/mesh/mesh_step.h"

#include "io/store/scratch.h"
#include "lib/core/error.h"
#include "lib/geometry/signed_volume.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "tools/mesh/enclosure.h"
#include "tools/mesh/mesh_report.h"
#include "tools/notes/proportion.h"
#include "tools/run/memory_shares.h"

namespace bp {

namespace {

/// Edges follow the scale where it differs from place to place: none is longer than so many scales, except near the
/// closing.
constexpr double kEdgeFactor = 4;

/// Sets the limit on edges: the promise that the user asked for, or the default, which may give way.
void set_edges(const MeshOptions& o, const StreamHeader& header, MeshParams& params) {
  if (o.edge_factor && !header.has_closing)
    fail(ErrorCode::bad_argument, "--edge-factor: the stream is not closed, so it has no scale; use bpclose");
  if (!header.scale.constant()) params.edge_factor = kEdgeFactor;
  if (o.edge_factor) params.edge_factor = *o.edge_factor;
  params.edges_yield = params.edges_by_shape = !o.edge_factor;
}

}  // namespace

MeshParams mesh_params(const MeshOptions& o, const StreamHeader& header) {
  MeshParams params;
  params.mode = o.proxy.mode;
  params.faces = o.levels.faces;
  if (o.error()) question_length("--error", *o.error(), header.bounds, header.frame.voxel);
  if (o.error()) params.error_world = o.error()->in_world(header.bounds.diagonal(), header.frame.voxel);
  params.volume_ratio = o.volume;
  if (o.proxy.mode == MeshMode::inside) params.least_part = MeshParams::kLeastPart;
  params.quads = o.quads;
  set_edges(o, header, params);
  // A result that may lie beyond --error is measured, so that a note can tell.
  const bool chosen = o.proxy.enclose.kind != EncloseOption::Kind::automatic;
  params.distances = o.error() && (chosen || o.levels.faces.size() > 1);
  return params;
}

std::string set_enclosure(const MeshOptions& o, BrickSource& source, MeshParams& params, const PassContext& context,
                          TriangleSource* scene, Report& report) {
  const auto limit = [&](std::uint64_t triangles) {
    MeshParams with_scene = params;
    with_scene.enclose = Enclose::scene;
    return mesh_limit(source, context, with_scene, triangles);
  };
  Enclosure enclosure =
      make_enclosure(o.proxy.enclose, {source.header(), o.proxy.mode, o.error().has_value(), params.distances,
                                       context.pieces, o.common.temp, scene, limit});
  if (!enclosure.note.empty()) report.note(enclosure.note, o.common);
  params.enclose = enclosure.what;
  params.scene = std::move(enclosure.scene);
  params.rounding = enclosure.rounding;
  // The user did not ask for the scene: the bound is on what bpmesh adds to the requested closing.
  if (o.error() && o.proxy.mode == MeshMode::bounding && o.proxy.enclose.kind == EncloseOption::Kind::automatic)
    params.distances_to = Enclose::closing;
  return o.proxy.enclose.kind == EncloseOption::Kind::files ? o.proxy.enclose.text() : name_of(enclosure.what);
}

std::optional<double> volume_of(const std::vector<TriangleD>& scene) {
  if (scene.empty()) return {};
  SignedVolume volume(scene.front().front());
  for (const TriangleD& t : scene) volume.add(t);
  return volume.value();
}

void tell_steps(std::vector<LatticeMesh>& levels, const MeshOptions& o, const MeshedStream& from) {
  for (std::size_t i = 0; i < levels.size(); ++i)
    levels[i].provenance.push_back(mesh_provenance(o, from.header.frame, from.enclosed, from.checksum, i));
}

MeshWriteOptions write_options(MeshMode mode, const Vec3d& origin) {
  const Contract contract = mode == MeshMode::fit      ? Contract::fit
                            : mode == MeshMode::inside ? Contract::inside
                                                       : Contract::encloses;
  return {origin, mode == MeshMode::fit, contract};
}

PieceMemory mesh_memory(const CommonOptions& common) {
  const MeshBudget budget(common.memory_bytes);
  PieceMemory memory;
  memory.waiting_bytes = budget.waiting;
  memory.work_bytes = budget.work;
  memory.limit = budget.limit;
  memory.waiting_share = MeshBudget::kWaitingShare;
  memory.work_share = MeshBudget::kWorkShare;
  memory.make_scratch = [store = budget.store, temp = common.temp] { return make_scratch(store, temp); };
  return memory;
}

}  // namespace bp
