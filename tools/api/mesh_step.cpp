// The last step of the pipe, as bpmesh does it.
#include "tools/mesh/mesh_step.h"

#include <algorithm>

#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "tools/api/call.h"
#include "tools/api/mesh.h"
#include "tools/api/structs.h"
#include "tools/mesh/shortfalls.h"
#include "tools/run/memory_shares.h"
#include "tools/run/scene_budget.h"

namespace bp::api {

namespace {

using Kind = EncloseOption::Kind;

std::vector<std::uint64_t> faces_of(const bp_mesh_options& o) {
  if (!is_list(o.faces, o.levels, "faces", "levels")) return {};
  return falling_faces(o.faces, o.levels);
}

MeshMode mode_of(const bp_mesh_options& o, const StreamHeader& header) {
  switch (choice<bp_mode>(o.mode, 4, "mode")) {
    case BP_MODE_BOUNDING:
      return MeshMode::bounding;
    case BP_MODE_FIT:
      return MeshMode::fit;
    case BP_MODE_INSIDE:
      return MeshMode::inside;
    case BP_MODE_AUTO:
      break;
  }
  return header.fill == FillMode::inside ? MeshMode::inside : MeshMode::bounding;
}

MeshOptions options_of(const bp_mesh_options& given, const VoxelGrid& grid, Call& call) {
  constexpr Kind kKinds[] = {Kind::automatic, Kind::scene, Kind::input, Kind::closing};
  MeshOptions o;
  o.common = call.common();
  o.levels.faces = faces_of(given);
  if (const Length error = length_of(given.error, "error"); error.value > 0) o.levels.errors = {error};
  if (!(given.volume >= 0) || given.volume > 1e300)
    fail(ErrorCode::bad_argument, "volume: {} is no multiple of a volume", given.volume);
  o.volume = given.volume;
  o.quads = given.quads != 0;
  o.proxy.mode = mode_of(given, grid.header);
  o.proxy.mode_given = given.mode != BP_MODE_AUTO;
  o.proxy.enclose.kind = kKinds[std::size_t(choice<bp_enclose>(given.enclose, 4, "enclose"))];
  return o;
}

/// Opens the grid's scene for its triangles; null: its header names files, or nobody knows them.
std::unique_ptr<TriangleSource> scene_again(const VoxelGrid& grid, const PieceMemory& memory,
                                            const CommonOptions& common) {
  SceneOptions options;
  options.memory_bytes = memory.bytes() / 2;
  options.temp_dir = common.temp;
  options.keep_degenerate = true;
  return grid.open_arrays(options);
}

void set_info(Mesh& mesh, const LevelCounts& counts, std::uint64_t asked, const std::string& enclosed) {
  mesh.info.volume = counts.measures.volume;
  mesh.info.area = area_world(*mesh.lattice);
  mesh.info.faces_asked = asked;
  mesh.info.error_bound = counts.error_world;
  mesh.stopped_by = counts.stopped_by;
  mesh.enclosed = enclosed;
}

}  // namespace

Mesh mesh_of(LatticeMesh lattice) {
  Mesh mesh;
  mesh.vertices.reserve(3 * lattice.vertices.size());
  for (const LatticeCoord& v : lattice.vertices) {
    const Vec3d p = lattice.frame.world(v);
    mesh.vertices.insert(mesh.vertices.end(), p.begin(), p.end());
  }
  for (const auto& t : lattice.triangles) mesh.triangles.insert(mesh.triangles.end(), t.begin(), t.end());
  for (const auto& q : lattice.quads) mesh.quads.insert(mesh.quads.end(), q.begin(), q.end());
  mesh.lattice = std::move(lattice);
  return mesh;
}

Meshes mesh(const VoxelGrid& grid, const bp_mesh_options* given, Call& call, bool cage) {
  const MeshOptions o = options_of(take_struct(given, bp_mesh_options{}, "bp_mesh_options"), grid, call);
  call.begin("meshing");
  const StreamHeader& header = grid.header;
  MeshParams params = mesh_params(o, header);
  if (cage) params.cage.emplace();
  PassContext context;
  context.pieces = mesh_memory(o.common);
  context.make_shelf = make_shelf_factory(MeshBudget(o.common.memory_bytes).shelves, o.common.temp);
  context.progress = call.progress();
  context.stop = call.stop();
  const auto scene = scene_again(grid, context.pieces, o.common);
  ShelfSource source = grid.open();
  const std::string enclosed = set_enclosure(o, source, params, context, scene.get(), call.report());
  const bool closed_by_scale = header.has_closing && header.scale.constant();
  const ShortfallFacts facts{params.error_world, closed_by_scale, volume_of(params.scene)};
  MeshCounts counts;
  std::vector<LatticeMesh> levels = mesh_stream(source, context, std::move(params), counts);
  tell_steps(levels, o, {header, grid.totals().checksum(), enclosed});
  Meshes out;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    out.push_back(mesh_of(std::move(levels[i])));
    out.back().write = write_options(o.proxy.mode, {});
    set_info(out.back(), counts.levels[i], i < o.levels.faces.size() ? o.levels.faces[i] : 0, enclosed);
  }
  if (!cage) note_shortfalls(call.report(), o, counts, facts);  // a cage counts no steps
  return out;
}

}  // namespace bp::api

using namespace bp::api;

extern "C" {

void bp_mesh_defaults(bp_mesh_options* options, size_t size) {
  put_defaults(options, size, bp_mesh_options{});
}

bp_status bp_mesh_make(const bp_grid* grid, const bp_mesh_options* options, const bp_run* run, bp_mesh** out) {
  return guarded_result(run, out, [&](Call& call) {
    return bp_mesh{mesh(*needed(grid, "grid").grid, options, call), {}};
  });
}

bp_status bp_proxy(const bp_scene* scene, const bp_voxelize_options* voxels, const bp_close_options* closing,
                   const bp_mesh_options* options, const bp_run* run, bp_mesh** out) {
  return guarded_result(run, out, [&](Call& call) {
    const auto closed = close(*voxelize(needed(scene, "scene").scene, voxels, call), closing, call);
    return bp_mesh{mesh(*closed, options, call), {}};
  });
}

}  // extern "C"
