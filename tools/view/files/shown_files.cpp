#include "tools/view/files/shown_files.h"

#include <algorithm>
#include <atomic>
#include <filesystem>

#include "io/scene/scene_format.h"
#include "io/scene/scene_reader.h"
#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "io/tiles/tileset_file.h"
#include "io/tiles/tileset_level.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/live/surface_piece.h"
#include "tools/run/inputs.h"

namespace bp {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_large(const ShownFile& file, std::uint64_t most) {
  fail(ErrorCode::out_of_resource, "{}: has more than {} triangles, and is not shown", file.name, most);
}

/// Returns the middle of what a page draws, subtracted from a file's coordinates once its origin is added.
Vec3d shift_of(const ShownFile& file, const Vec3d& middle) {
  Vec3d shift = file.extras.origin.value_or(Vec3d{});
  for (std::size_t i = 0; i < 3; ++i) shift[i] -= middle[i];
  return shift;
}

ShownFile shown_file(const std::string& path, const std::string& name) {
  ShownFile file;
  file.path = path;
  file.name = name;
  std::error_code none;
  if (!fs::is_regular_file(path, none)) fail(ErrorCode::bad_input, "{}: is neither a file nor a folder", path);
  if (begins_as_stream(path)) {
    file.kind = ShownFile::Kind::voxels;
    const BrickReader reader(path);
    for (const Provenance& step : reader.header().provenance)
      file.extras.provenance.push_back(step.tool + " " + step.version + " " + step.options);
    return file;
  }
  file.extras = mesh_extras(path);
  file.levels = file.extras.levels;
  if (path.ends_with(".json")) {
    file.kind = ShownFile::Kind::tileset;
    file.levels = tileset_level(read_tileset(path), path, 0).levels;
  }
  return file;
}

/// Returns the meshes and streams in a folder, sorted by name.
std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (entry.is_regular_file() && (!scene_format_of(path).empty() || begins_as_stream(path)))
      names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  if (names.empty()) fail(ErrorCode::bad_input, "{}: a folder with neither a tileset, a mesh nor voxels", folder);
  return names;
}

/// Returns the last part of a path: the name of the folder for "lod/".
std::string last_name(const std::string& path) {
  const fs::path p = fs::path(path).lexically_normal();
  return (p.has_filename() ? p : p.parent_path()).filename().string();
}

/// Adds a piece of a surface in this frame.
void append(const SurfacePiece& piece, const GridFrame& frame, const Vec3d& middle, ShownMesh& out) {
  const Vec3d origin = frame.world_origin();
  const double step = frame.voxel / SurfacePiece::kPerVoxel;
  const auto first = std::uint32_t(out.positions.size());
  for (const SurfacePiece::Vertex& v : piece.vertices) {
    std::array<float, 3> p{};
    for (int i = 0; i < 3; ++i) {
      const auto axis = std::size_t(i);
      const double voxels = double(piece.brick[i]) * kBrickEdge - SurfacePiece::kOrigin;
      p[axis] = float(origin[axis] - middle[axis] + voxels * frame.voxel + v.position[axis] * step);
    }
    out.positions.push_back(p);
    out.normals.push_back(v.normal);
  }
  for (const auto& face : piece.faces) {
    for (const auto& t : triangles_of(face)) out.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

ShownMesh voxels_of_stream(const ShownFile& file, const Vec3d& middle, std::uint64_t most,
                           const SceneOptions& options) {
  BrickReader reader(file.path);
  const StreamHeader header = reader.header();
  const Layer layer = header.has_closing ? Layer::closing : Layer::solid;
  const auto shelf = make_shelf(options.memory_bytes, options.temp_dir);
  for_bricks(reader, [&](const Brick& brick) {
    if (brick.layer == layer) shelf->put(brick.coord, brick.fill, brick.bits);
  });
  const std::vector<BrickCoord> bricks = shelf->coords();
  std::vector<SurfacePiece> pieces(bricks.size());
  std::atomic<std::uint64_t> faces = 0;
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    if (2 * faces > most) return;  // it is refused below
    const BrickCoord c = bricks[std::size_t(i)];
    const VoxelBox box = voxels_of(c).grown(1);
    pieces[std::size_t(i)] = piece_of(*shelf, c, header.scale.sample(header.frame, box));
    faces += pieces[std::size_t(i)].faces.size();
  });
  if (2 * faces > most) refuse_large(file, most);
  ShownMesh out;
  for (const SurfacePiece& piece : pieces) append(piece, header.frame, middle, out);
  out.faces = std::uint32_t(out.triangles.size());
  return out;
}

ShownMesh mesh_of_tiles(const ShownFile& file, std::size_t level, const Vec3d& middle, std::uint64_t most,
                        const SceneOptions& options) {
  const Tileset tileset = read_tileset(file.path, options);
  const auto source = open_contents(tileset, tileset_level(tileset, file.path, level).contents, file.path, options);
  IndexedMesh mesh;
  std::vector<TriangleColors> colors;
  std::vector<std::uint8_t> inner;
  for (std::vector<TriangleD> some; source->read_faces(some, colors, inner);) {
    if (mesh.triangles.size() + some.size() > most) refuse_large(file, most);
    for (const TriangleD& t : some) {
      const auto first = std::uint32_t(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    mesh.inner_edges.insert(mesh.inner_edges.end(), inner.begin(), inner.end());
  }
  return shown_mesh(mesh, shift_of(file, middle));
}

}  // namespace

std::vector<ShownFile> shown_files(const std::vector<std::string>& paths) {
  std::vector<ShownFile> files;
  for (const std::string& path : paths) {
    if (!fs::exists(path)) fail(ErrorCode::bad_input, "{}: there is no such file or folder", path);
    if (!fs::is_directory(path)) {
      files.push_back(shown_file(path, last_name(path)));
    } else if (const fs::path tileset = fs::path(path) / "tileset.json"; fs::exists(tileset)) {
      files.push_back(shown_file(tileset.string(), last_name(path)));
    } else {
      for (const std::string& name : files_in(path))
        files.push_back(shown_file((fs::path(path) / name).string(), last_name(path) + "/" + name));
    }
  }
  return files;
}

ShownMesh read_level(const ShownFile& file, std::size_t level, const Vec3d& middle, std::uint64_t most,
                     const SceneOptions& options) {
  if (level >= file.levels) fail(ErrorCode::bad_argument, "{}: has no level {}", file.name, level);
  if (file.kind == ShownFile::Kind::voxels) return voxels_of_stream(file, middle, most, options);
  if (file.kind == ShownFile::Kind::tileset) return mesh_of_tiles(file, level, middle, most, options);
  SceneOptions one = options;
  one.level = level;
  one.mesh = {{most}, 1, 0, "showing a mesh"};
  const IndexedMesh mesh = read_mesh(file.path, one);
  if (mesh.triangles.size() > most) refuse_large(file, most);
  return shown_mesh(mesh, shift_of(file, middle));
}

}  // namespace bp
