#include "tools/lod/collision/collision_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/mesh/lod_writer.h"
#include "io/mesh/mesh_writer.h"
#include "tools/lod/collision/robot_files.h"

namespace bp {

namespace {

constexpr const char* kHull = "_hull_";

std::string hull_file(const BuildOptions& o, std::size_t number) {
  return fmt::format("{}{}{:02}.{}", o.name, kHull, number, name_of(o.hull_files));
}

std::string mjcf_file(const BuildOptions& o) {
  return o.name + "_mujoco.xml";
}

std::string urdf_file(const BuildOptions& o) {
  return o.name + ".urdf";
}

/// Returns a note if the hulls hold more than the level, with advice whether more of them would help; empty if they
/// hold hardly more. `body`: the file that holds the level itself.
std::string hull_note(const WrittenFile& file, const ConvexParts& parts, const std::string& body) {
  constexpr double kAsGood = 1.1;
  if (file.hull_volume < kAsGood) return "";
  const char* advice = parts.short_of_faces ? "more --faces fit closer; or"
                       : parts.limited      ? "more --hulls fit closer; or"
                                            : "more --hulls would hardly fit closer;";
  return fmt::format(
      "{}: {} hull{} with {:.3g} times the body's volume; {} use {}, the body itself, as complex collision", file.name,
      file.hulls, file.hulls == 1 ? "" : "s", file.hull_volume, advice, body);
}

/// Returns whether `file` has the name of a hull of these levels, with any number and in any format.
bool is_hull_file(const BuildOptions& o, const std::string& file) {
  const std::string start = o.name + kHull;
  if (!file.starts_with(start)) return false;
  const std::string rest = file.substr(start.size());
  const std::size_t dot = rest.find_first_not_of("0123456789");
  return dot != std::string::npos && dot >= 2 && (rest.substr(dot) == ".obj" || rest.substr(dot) == ".stl");
}

/// Removes hull files of an earlier run: a simulator that reads all hull files of the folder must not read old ones.
void take_away_earlier(const BuildOptions& o, const std::vector<std::string>& written, OutputFolder& out) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(o.out, none)) {
    const std::string file = entry.path().filename().string();
    if (is_hull_file(o, file) && std::find(written.begin(), written.end(), file) == written.end()) out.take_away(file);
  }
}

/// Writes the hulls, and the MuJoCo and URDF models that name their files. Returns the MuJoCo model's row for the list
/// of written files.
WrittenFile write_hull_files(const BuildOptions& o, const ConvexParts& parts, const Vec3d& origin, OutputFolder& out) {
  const MeshFormat format = o.hull_files == HullFiles::obj ? MeshFormat::obj : MeshFormat::stl;
  std::vector<std::string> files;
  for (const LatticeMesh& hull : parts.hulls) {
    const std::string name = hull_file(o, files.size());
    OutputFile& file = files.empty() ? out.file(name) : out.add(name, mjcf_file(o));
    write_mesh(hull, file, format, {origin, false, Contract::convex_part});
    files.push_back(name);
  }
  out.file(mjcf_file(o)).write(mjcf_text(o.name, files));
  out.file(urdf_file(o)).write(urdf_text(o.name, files));
  take_away_earlier(o, files, out);
  WrittenFile row{mjcf_file(o), 0, 0, false, parts.hulls.size()};
  row.beside = files;
  row.beside.push_back(urdf_file(o));
  return row;
}

}  // namespace

std::vector<std::string> collision_files(const BuildOptions& o) {
  std::vector<std::string> files{o.name + "_godot.glb", o.name + "_unreal.glb", o.name + "_unity.glb"};
  if (o.hull_files != HullFiles::none)
    for (const std::string& file : {hull_file(o, 0), mjcf_file(o), urdf_file(o)}) files.push_back(file);
  return files;
}

std::uint64_t faces_of_hulls(const BuildOptions& o, const LatticeMesh& body) {
  constexpr std::uint64_t kEnough = 64;  // a body of few faces may need more for its convex parts
  return o.levels.faces.empty() ? std::max<std::uint64_t>(body.triangles.size(), kEnough) : o.levels.faces.front();
}

/// The names are conventions of importers. Godot takes the suffix "-colonly" for a mesh that only collides. Unreal
/// takes the prefix "UCX_MESH_" for convex hulls, which enclose the mesh together. Unity has no convention; "_Collider"
/// is for people.
std::vector<WrittenFile> write_collision_files(const BuildOptions& o, const LatticeMesh& body, const ConvexParts& parts,
                                               const Vec3d& origin, OutputFolder& out) {
  const std::string& name = o.name;
  const NamedMesh godot{name + "-colonly", &body}, unity{name + "_Collider", &body};
  write_parts_glb({&godot, 1}, out.file(name + "_godot.glb"), {origin, false, Contract::encloses});
  write_parts_glb({&unity, 1}, out.file(name + "_unity.glb"), {origin, false, Contract::encloses});
  std::vector<NamedMesh> unreal;
  WrittenFile hulls{name + "_unreal.glb", 0, 0, false, parts.hulls.size()};
  for (const LatticeMesh& hull : parts.hulls) {
    hulls.faces += hull.triangles.size();
    unreal.push_back({fmt::format("UCX_{}_{:02}", name, unreal.size()), &hull});
  }
  write_parts_glb(unreal, out.file(hulls.name), {origin, false, Contract::convex_parts});
  hulls.hull_volume =
      volume_of(parts) / (double(volume6_of(body)) / 6 * std::pow(body.frame.voxel / kLatticePerVoxel, 3));
  hulls.note = hull_note(hulls, parts, name + "_godot.glb");
  const std::uint64_t own = body.triangles.size();
  std::vector<WrittenFile> files{{name + "_godot.glb", 0, own}, hulls, {name + "_unity.glb", 0, own}};
  if (o.hull_files == HullFiles::none) return files;
  files.push_back(write_hull_files(o, parts, origin, out));
  files.back().faces = hulls.faces, files.back().hull_volume = hulls.hull_volume;
  return files;
}

}  // namespace bp
