// Levels, occluders and cages of a scene, as bplod makes them.
#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/pass/mesh/mesh_measures.h"
#include "tools/api/call.h"
#include "tools/api/include/bp/bp_experimental.h"
#include "tools/api/mesh.h"
#include "tools/api/structs.h"
#include "tools/cli/names.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/occluder.h"
#include "tools/lod/options/parse_options.h"
#include "tools/lod/scene/complete_levels.h"

namespace bp::api {

struct LevelFiles {
  LodProfile profile;
  MeshMode mode;
  double diameter = 0;  ///< of the scene
};

namespace {

using Kind = EncloseOption::Kind;

BuildOptions options_for(LodProfile profile, const Scene& scene, const bp_voxelize_options* voxels, const Call& call) {
  BuildOptions o;
  o.common = call.common();
  o.profile = profile;
  o.appearance = Appearance::off;
  o.voxels = voxel_options(scene, voxels);
  if (o.voxels.fill == FillMode::inside)
    fail(ErrorCode::bad_argument, "fill: levels are made of a scene whose own voxels are solid; leave BP_FILL_INSIDE");
  return o;
}

BuildHost host_of(const Scene& scene, Call& call) {
  BuildHost host;
  if (scene.arrays) host.open = [&scene](const SceneOptions& how) { return scene.open(how); };
  host.show = call.progress();
  host.stop = call.stop();
  return host;
}

std::vector<std::uint64_t> faces_of(const bp_levels_options& o) {
  if (!is_list(o.faces, o.face_count, "faces", "face_count")) return {};
  return falling_faces(o.faces, o.face_count);
}

std::vector<Length> errors_of(const bp_levels_options& o) {
  std::vector<Length> errors;
  if (!is_list(o.errors, o.error_count, "errors", "error_count")) return errors;
  for (std::size_t i = 0; i < o.error_count; ++i) {
    const Length error = length_of(o.errors[i], "errors");
    if (!(error.value > 0)) fail(ErrorCode::bad_argument, "errors: 0 is no error that a level can have");
    if (error.unit == Length::Unit::voxels) fail(ErrorCode::bad_argument, "errors: an error is not measured in voxels");
    if (i > 0 && error.unit != errors.back().unit)
      fail(ErrorCode::bad_argument, "errors: the lengths of a list have one unit");
    if (i > 0 && !(error.value > errors.back().value))
      fail(ErrorCode::bad_argument, "errors: {} after {}: each level has a larger one than the one before",
           error.text(), errors.back().text());
    errors.push_back(error);
  }
  return errors;
}

void set_levels(const bp_levels_options& given, BuildOptions& o) {
  constexpr Kind kKinds[] = {Kind::automatic, Kind::scene, Kind::input, Kind::closing};
  o.levels.faces = faces_of(given);
  o.levels.errors = errors_of(given);
  if (given.levels > 0) o.levels.levels = given.levels;
  if (const Length scale = length_of(given.scale, "scale"); scale.value > 0) o.closing.scale = scale;
  const auto mode = choice<bp_mode>(given.mode, 4, "mode");
  if (mode == BP_MODE_INSIDE) fail(ErrorCode::bad_argument, "mode: levels lie around the scene; see bp_occluder()");
  o.proxy.mode = mode == BP_MODE_FIT ? MeshMode::fit : MeshMode::bounding;
  o.proxy.enclose.kind = kKinds[std::size_t(choice<bp_enclose>(given.enclose, 4, "enclose"))];
  if (o.proxy.mode == MeshMode::fit && o.proxy.enclose.kind != Kind::automatic)
    fail(ErrorCode::bad_argument, "a fit encloses nothing and is not tightened; enclose has no meaning");
}

/// Returns a level as one mesh of a handle, with the facts that are known.
Mesh mesh_of_level(LatticeMesh lattice, const LevelFacts& facts, Contract contract, const std::string& enclosed) {
  Mesh mesh = mesh_of(std::move(lattice));
  mesh.write.contract = contract;
  mesh.info.volume = facts.volume;
  mesh.info.area = area_world(*mesh.lattice);
  mesh.info.faces_asked = facts.target.faces;
  mesh.info.error_bound = std::isfinite(facts.error_world) ? facts.error_world : 0;
  mesh.stopped_by = facts.stopped_by;
  mesh.enclosed = enclosed;
  return mesh;
}

void tell_notes(const Build& build, Call& call) {
  for (const Json& note : build.report.notes) call.report().notes.push_back(note);
}

bp_mesh chain_of(const Scene& scene, const BuildOptions& o, Call& call) {
  Build build(o, host_of(scene, call));
  MadeChain chain = make_chain(build);
  note_chain(build, chain);
  const bool encloses = o.proxy.mode == MeshMode::bounding;
  const Contract contract = o.is_cage() ? Contract::margin : contract_of_levels(o);
  const std::string enclosed = encloses ? name_of(chain.scene.enclosed) : "";
  bp_mesh out;
  for (std::size_t i = 0; i < chain.made.levels.size(); ++i)
    out.meshes.push_back(mesh_of_level(std::move(chain.made.levels[i].mesh), chain.made.facts[i], contract, enclosed));
  const double diameter = chain.scene.voxels.header.bounds.diagonal();
  out.files = std::make_shared<const LevelFiles>(LevelFiles{o.profile, o.proxy.mode, diameter});
  tell_notes(build, call);
  return out;
}

bp_mesh levels(const Scene& scene, const bp_voxelize_options* voxels, const bp_levels_options* given, Call& call) {
  BuildOptions o = options_for(LodProfile::gltf, scene, voxels, call);
  set_levels(take_struct(given, bp_levels_options{}, "bp_levels_options"), o);
  settle(o);
  return chain_of(scene, o, call);
}

bp_mesh cage(const Scene& scene, const bp_voxelize_options* voxels, const bp_cage_options* given, Call& call) {
  constexpr Symmetry kSymmetries[] = {Symmetry::automatic, Symmetry::off, Symmetry::x, Symmetry::y, Symmetry::z};
  const bp_cage_options options = take_struct(given, bp_cage_options{}, "bp_cage_options");
  BuildOptions o = options_for(LodProfile::cage, scene, voxels, call);
  if (options.faces > 0) o.levels.faces = {options.faces};
  const Length margin = length_of(options.margin, "margin");
  if (margin.value > 0 || options.no_margin != 0) o.margin = margin;
  o.symmetry = kSymmetries[std::size_t(choice<bp_symmetry>(options.symmetry, 5, "symmetry"))];
  settle(o);
  return chain_of(scene, o, call);
}

bp_mesh occluder(const Scene& scene, const bp_voxelize_options* voxels, const bp_occluder_options* given, Call& call) {
  const bp_occluder_options options = take_struct(given, bp_occluder_options{}, "bp_occluder_options");
  BuildOptions o = options_for(LodProfile::occluder, scene, voxels, call);
  if (o.voxels.fill != FillMode::flood)
    fail(ErrorCode::bad_argument, "fill: an occluder finds by itself what the scene hides; leave it out");
  if (options.faces > 0) o.levels.faces = {options.faces};
  const Length scale = length_of(options.scale, "scale");
  if (scale.value > 0 || options.no_scale != 0) o.closing.scale = scale;
  settle(o);
  Build build(o, host_of(scene, call));
  BuiltOccluder built = built_occluder(build);
  LevelFacts facts = facts_of(built.made.level, {});
  facts.target.faces = built.made.faces_asked;
  bp_mesh out;
  out.meshes.push_back(mesh_of_level(std::move(built.made.level.mesh), facts, Contract::inside, ""));
  out.files = std::make_shared<const LevelFiles>(LevelFiles{o.profile, o.proxy.mode});
  tell_notes(build, call);
  return out;
}

/// Meshes of a handle as the steps of bplod take them.
struct Outputs {
  BuildOptions options;
  CompleteLevels made;
  double diameter = 0;  ///< of the scene

  [[nodiscard]] std::vector<std::string> files() const {
    return profile_files(options.profile, options.name, made.levels.size());
  }
  void write(OutputFolder& out) const {
    (void)write_profile(options, made, diameter, {}, {}, out);
    out.commit();
  }
};

Outputs outputs_of(const bp_mesh& all, const char* name) {
  if (all.files == nullptr)
    fail(ErrorCode::bad_argument,
         "bp_levels_save() and bp_levels_write() write what bp_levels(), bp_occluder() and bp_scene_cage() make; "
         "save other meshes one by one, with bp_mesh_save()");
  Outputs out;
  BuildOptions& o = out.options;
  o.profile = all.files->profile;
  o.proxy.mode = all.files->mode;
  o.name = &needed(name, "name");
  if (o.name.empty()) fail(ErrorCode::bad_argument, "name: is empty");
  check_name(o);
  for (const Mesh& mesh : all.meshes) {
    out.made.levels.emplace_back().mesh = *mesh.lattice;
    LevelFacts& facts = out.made.facts.emplace_back();
    facts.faces = mesh.lattice->triangles.size();
    facts.error_world = mesh.info.error_bound;
  }
  out.diameter = all.files->diameter;
  return out;
}

/// Writes them with the names and bytes of bplod.
void save(const bp_mesh& all, const char* folder, const char* name, bool overwrite) {
  Outputs outputs = outputs_of(all, name);
  outputs.options.out = &needed(folder, "folder");
  OutputFolder out(folder, outputs.files(), overwrite, [](const std::string& path, bool replace) {
    return std::make_unique<OutputFile>(path, replace, NamedBy::file);
  });
  if (outputs.options.profile == LodProfile::gltf)
    take_away_longer_list(outputs.options, outputs.made.levels.size(), out);
  outputs.write(out);
}

void write(const bp_mesh& all, const char* name, bp_sink_fn sink, void* user) {
  const Outputs outputs = outputs_of(all, name);
  OutputFolder out(outputs.files(), [&](const std::string& file, bool) { return output_of(sink, user, file, true); });
  outputs.write(out);
}

}  // namespace

}  // namespace bp::api

using namespace bp::api;

extern "C" {

void bp_levels_defaults(bp_levels_options* options, size_t size) {
  put_defaults(options, size, bp_levels_options{});
}

bp_status bp_levels(const bp_scene* scene, const bp_voxelize_options* voxelize, const bp_levels_options* options,
                    const bp_run* run, bp_mesh** out) {
  return guarded_result(run, out,
                        [&](Call& call) { return levels(*needed(scene, "scene").scene, voxelize, options, call); });
}

void bp_occluder_defaults(bp_occluder_options* options, size_t size) {
  put_defaults(options, size, bp_occluder_options{});
}

bp_status bp_occluder(const bp_scene* scene, const bp_voxelize_options* voxelize, const bp_occluder_options* options,
                      const bp_run* run, bp_mesh** out) {
  return guarded_result(run, out,
                        [&](Call& call) { return occluder(*needed(scene, "scene").scene, voxelize, options, call); });
}

void bp_cage_defaults(bp_cage_options* options, size_t size) {
  put_defaults(options, size, bp_cage_options{});
}

bp_status bp_scene_cage(const bp_scene* scene, const bp_voxelize_options* voxelize, const bp_cage_options* options,
                        const bp_run* run, bp_mesh** out) {
  return guarded_result(run, out,
                        [&](Call& call) { return cage(*needed(scene, "scene").scene, voxelize, options, call); });
}

bp_status bp_levels_save(const bp_mesh* meshes, const char* folder, const char* name, int overwrite) {
  return guarded([&] { save(needed(meshes, "meshes"), folder, name, overwrite != 0); });
}

bp_status bp_levels_write(const bp_mesh* meshes, const char* name, bp_sink_fn sink, void* user) {
  return guarded([&] { write(needed(meshes, "meshes"), name, sink, user); });
}

}  // extern "C"
