#include "tools/api/mesh.h"

#include "lib/core/error.h"
#include "lib/geometry/signed_volume.h"
#include "lib/geometry/triangle_parts.h"
#include "tools/api/call.h"
#include "tools/api/structs.h"
#include "tools/run/memory_shares.h"
#include "tools/run/mesh_extras.h"
#include "tools/run/scene_budget.h"

namespace bp::api {

bp_arrays Mesh::arrays() const {
  bp_arrays a{};
  a.size = sizeof a;
  a.vertices = vertices.data();
  a.vertex_count = vertices.size() / 3;
  a.vertex_type = BP_FLOAT64;
  a.triangles = triangles.data();
  a.triangle_count = triangles.size() / 3;
  a.triangle_type = BP_UINT32;
  a.borrow = 1;
  return a;
}

std::vector<std::string> Mesh::steps() const {
  if (!lattice) return loaded_steps;
  std::vector<std::string> steps;
  for (const Provenance& step : lattice->provenance)
    steps.push_back(step.tool + " " + step.version + " " + step.options);
  return steps;
}

const Mesh& mesh_at(const bp_mesh* meshes, std::size_t index) {
  const Meshes& all = needed(meshes, "mesh").meshes;
  if (index >= all.size())
    fail(ErrorCode::bad_argument, "index: {}, and the number of meshes is {}", index, all.size());
  return all[index];
}

namespace {

Mesh loaded(const IndexedMesh& from) {
  Mesh mesh;
  for (const Vec3d& p : from.vertices) mesh.vertices.insert(mesh.vertices.end(), p.begin(), p.end());
  for (const auto& t : from.triangles) mesh.triangles.insert(mesh.triangles.end(), t.begin(), t.end());
  if (from.triangles.empty()) return mesh;
  const auto place = [&](std::uint32_t v) { return from.vertices[v]; };
  SignedVolume volume(place(from.triangles.front()[0]));
  for (const auto& [a, b, c] : from.triangles) {
    volume.add({place(a), place(b), place(c)});
    mesh.info.area += area_of({place(a), place(b), place(c)});
  }
  mesh.info.volume = volume.value().value_or(0);
  return mesh;
}

Meshes load_meshes(const char* path, Call& call) {
  call.begin("reading");
  SceneOptions options;
  options.memory_bytes = UsableMemory(call.common().memory_bytes, kMeshProgram).bytes / 8;
  options.temp_dir = call.common().temp;
  options.keep_extremes = true;
  options.document = document_budget(call.common().memory_bytes, kMeshProgram, 1);
  Meshes out;
  for (const IndexedMesh& level : read_levels(file_name(path), options)) out.push_back(loaded(level));
  const MeshExtras extras = mesh_extras(path);
  for (Mesh& mesh : out) mesh.loaded_steps = extras.provenance;
  return out;
}

/// Opens the output by `open` once nothing speaks against it.
void write(const Mesh& mesh, MeshFormat format, const std::string& name,
           const std::function<std::unique_ptr<OutputFile>(const std::string& name)>& open) {
  if (!mesh.lattice)
    fail(ErrorCode::bad_argument, "the mesh was loaded, and libbp writes the meshes that it makes; copy the file");
  if (!mesh.quads.empty() && format != MeshFormat::obj && format != MeshFormat::ply)
    fail(ErrorCode::bad_argument, "{}: only .obj and .ply hold quads", name);
  const auto file = open(name);
  write_mesh(*mesh.lattice, *file, format, mesh.write);
  file->commit();
}

}  // namespace

}  // namespace bp::api

using namespace bp::api;

extern "C" {

bp_status bp_mesh_load(const char* path, const bp_run* run, bp_mesh** out) {
  return guarded_result(run, out, [&](Call& call) { return bp_mesh{load_meshes(path, call), {}}; });
}

size_t bp_mesh_count(const bp_mesh* mesh) {
  return mesh == nullptr ? 0 : mesh->meshes.size();
}

bp_status bp_mesh_look(const bp_mesh* mesh, size_t index, bp_mesh_view* view, size_t size) {
  return guarded([&] {
    const Mesh& m = mesh_at(mesh, index);
    put_struct(view, size,
               bp_mesh_view{0, m.vertices.data(), m.vertices.size() / 3, m.triangles.data(), m.triangles.size() / 3,
                            m.quads.data(), m.quads.size() / 2});
  });
}

bp_status bp_mesh_read_info(const bp_mesh* mesh, size_t index, bp_mesh_info* info, size_t size) {
  return guarded([&] {
    const Mesh& m = mesh_at(mesh, index);
    bp_mesh_info all = m.info;
    all.stopped_by = m.stopped_by.c_str();
    all.enclosed = m.enclosed.c_str();
    put_struct(info, size, all);
  });
}

bp_status bp_mesh_save(const bp_mesh* mesh, size_t index, const char* path, int overwrite) {
  return guarded([&] {
    const std::string file = file_name(path);
    write(mesh_at(mesh, index), bp::mesh_format_of(file), file,
          [&](const std::string& name) { return std::make_unique<bp::OutputFile>(name, overwrite != 0); });
  });
}

bp_status bp_mesh_write(const bp_mesh* mesh, size_t index, const char* format, bp_sink_fn sink, void* user) {
  return guarded([&] {
    const std::string extension = &needed(format, "format");
    const auto known = bp::mesh_format_named(extension);
    if (!known) bp::fail(bp::ErrorCode::bad_argument, "{}: no mesh format; glb, gltf, ply, obj and stl are", extension);
    write(mesh_at(mesh, index), *known, "mesh." + extension,
          [&](const std::string& name) { return output_of(sink, user, name); });
  });
}

void bp_mesh_free(bp_mesh* mesh) {
  delete mesh;
}

}  // extern "C"
