#include "tools/lod/lod_outputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/files/final_names.h"
#include "io/mesh/lod_writer.h"
#include "io/mesh/mesh_writer.h"
#include "lib/core/error.h"

namespace bp {

namespace {

std::vector<NamedMesh> named(const std::string& name, const CompleteLevels& made) {
  std::vector<NamedMesh> meshes;
  for (std::size_t i = 0; i < made.levels.size(); ++i)
    meshes.push_back({level_name(name, i), &made.levels[i].mesh, made.scene_of(i)});
  return meshes;
}

std::vector<WrittenFile> write_gltf_profile(const std::string& name, const CompleteLevels& made, double diameter,
                                            MeshWriteOptions facts, const LeafLooks& looks, OutputFolder& out) {
  std::vector<WrittenFile> files;
  const std::vector<NamedMesh> meshes = named(name, made);
  const std::optional<Contract> claimed = facts.contract;
  bool claims_all = true;
  for (const NamedMesh& level : meshes) {
    facts.contract = level.scene == nullptr ? claimed : std::nullopt;
    claims_all = claims_all && facts.contract;
    write_lod_glb({&level, 1}, {}, out.file(level.name + ".glb"), facts, looks);
    files.push_back({level.name + ".glb", files.size(), made.facts[files.size()].faces});
  }
  std::vector<double> coverage;  // a level is drawn until the next one's error is a pixel; the last one always
  for (std::size_t i = 1; i < meshes.size(); ++i)
    coverage.push_back(coverage_at_one_pixel(diameter, made.facts[i].error_world));
  coverage.push_back(0);
  facts.contract = claims_all ? claimed : std::nullopt;
  write_lod_glb(meshes, coverage, out.file(name + ".glb"), facts, looks);
  return files;
}

/// Writes one GLB. Godot makes an occluder of a node with this suffix, and does not draw it.
std::vector<WrittenFile> write_occluder_profile(const std::string& name, const LatticeMesh& mesh, const Vec3d& origin,
                                                OutputFolder& out) {
  const NamedMesh godot{name + "-occonly", &mesh};
  write_parts_glb({&godot, 1}, out.file(name + "_occluder.glb"), {origin, false, Contract::inside});
  return {{name + "_occluder.glb", 0, mesh.triangles.size()}};
}

/// Writes the cage as OBJ, which has quads, and as GLB of triangles, for viewers that cannot read OBJ.
std::vector<WrittenFile> write_cage_profile(const std::string& name, const LatticeMesh& mesh, const Vec3d& origin,
                                            OutputFolder& out) {
  const NamedMesh shown{name + "_Cage", &mesh};
  const std::uint64_t quads = mesh.quads.size();
  write_mesh(mesh, out.file(name + "_cage.obj"), MeshFormat::obj, {origin, false, Contract::margin});
  write_parts_glb({&shown, 1}, out.file(name + "_cage.glb"), {origin, false, Contract::margin});
  const std::string note =
      fmt::format("{} has {} quads and {} triangles", name + "_cage.obj", quads, mesh.triangles.size() - 2 * quads);
  return {{name + "_cage.obj", 0, mesh.triangles.size(), true, 0, 0, note},
          {name + "_cage.glb", 0, mesh.triangles.size()}};
}

}  // namespace

OutputFolder::OutputFolder(std::string path, const std::vector<std::string>& names, bool overwrite, Open open)
    : path_(std::move(path)), overwrite_(overwrite), open_(std::move(open)), names_(names) {
  made_.emplace(path_);
  if (open_ == nullptr)
    open_ = [](const std::string& name, bool replace) { return open_output(name, replace, true, NamedBy::file); };
  for (const std::string& name : names) files_.push_back(open_(path_of(name), overwrite));
}

OutputFolder::OutputFolder(const std::vector<std::string>& names, Open open)
    : overwrite_(false), open_(std::move(open)), names_(names) {
  for (const std::string& name : names) files_.push_back(open_(name, overwrite_));
}

std::string OutputFolder::path_of(const std::string& name) const {
  return path_.empty() ? name : path_ + "/" + name;
}

OutputFile& OutputFolder::file(const std::string& name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) fail(ErrorCode::failed, "{}: is none of the files of this profile", name);
  return *files_[std::size_t(found - names_.begin())];
}

OutputFile& OutputFolder::add(const std::string& name, const std::string& next) {
  const auto at = std::find(names_.begin(), names_.end(), next) - names_.begin();
  files_.insert(files_.begin() + at, open_(path_of(name), overwrite_));
  names_.insert(names_.begin() + at, name);
  return *files_[std::size_t(at)];
}

void OutputFolder::leave_out(const std::string& name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return;
  files_.erase(files_.begin() + (found - names_.begin()));
  names_.erase(found);
  left_out_.push_back(name);
}

void OutputFolder::commit() {
  OutputFile::commit_all(files_);
  if (overwrite_) {  // without --overwrite none was there before
    for (const std::string& name : left_out_) (void)remove_file(path_of(name));
  }
  if (made_) made_->keep();
}

std::uint64_t OutputFolder::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& file : files_) sum += file->bytes();
  return sum;
}

std::uint64_t OutputFolder::bytes(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? 0 : files_[std::size_t(found - names_.begin())]->bytes();
}

Contract contract_of_levels(const BuildOptions& options) {
  return options.proxy.mode == MeshMode::fit ? Contract::fit : Contract::encloses;
}

Contract contract_of_tiles(const BuildOptions& options) {
  return options.proxy.mode == MeshMode::fit ? Contract::fit : Contract::tile;
}

std::string level_name(const std::string& name, std::size_t level) {
  return name + "_LOD" + std::to_string(level);
}

std::vector<std::string> profile_files(LodProfile profile, const std::string& name, std::size_t levels) {
  if (profile == LodProfile::occluder) return {name + "_occluder.glb"};
  if (profile == LodProfile::cage) return {name + "_cage.obj", name + "_cage.glb"};
  std::vector<std::string> files;
  for (std::size_t i = 0; i < levels; ++i) files.push_back(level_name(name, i) + ".glb");
  files.push_back(name + ".glb");
  return files;
}

std::vector<WrittenFile> write_profile(const BuildOptions& options, const CompleteLevels& made, double diameter,
                                       const Vec3d& origin, const LeafLooks& looks, OutputFolder& out) {
  if (options.profile == LodProfile::occluder)
    return write_occluder_profile(options.name, made.levels.front().mesh, origin, out);
  if (options.profile == LodProfile::cage)
    return write_cage_profile(options.name, made.levels.front().mesh, origin, out);
  // Tilesets and collision meshes are written elsewhere (tile_build.h, collision/collision_files.h).
  return write_gltf_profile(options.name, made, diameter, {origin, false, contract_of_levels(options)}, looks, out);
}

void take_away_longer_list(const BuildOptions& options, std::size_t levels, OutputFolder& out) {
  for (std::size_t i = levels;; ++i) {
    const std::string name = level_name(options.name, i) + ".glb", head = head_of(options.out + "/" + name);
    if (!head.starts_with("glTF") || head.find("\"generator\":\"bplod ") == std::string::npos) return;
    out.take_away(name);
  }
}

WholeLevels encoded(const BuildOptions& options, const CompleteLevels& made, std::size_t first) {
  WholeLevels whole;
  whole.origin = common_origin(made.levels);
  whole.left_out = made.left_out;
  for (std::size_t i = 0; i < made.levels.size(); ++i) {
    const LatticeMesh& mesh = made.levels[i].mesh;
    std::string content =
        tile_glb({level_name(options.name, first + i), &mesh}, lattice_point(mesh.frame, whole.origin),
                 options.compression(), contract_of_tiles(options));
    whole.levels.push_back({std::move(content), bounds_of(mesh), made.facts[i], mesh.provenance});
  }
  return whole;
}

}  // namespace bp
