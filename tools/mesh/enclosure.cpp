#include "tools/mesh/enclosure.h"

#include <fmt/format.h>

#include <optional>

#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/exact/predicates.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/store/content_hash.h"
#include "lib/store/hex.h"
#include "tools/cli/common_options.h"
#include "tools/cli/names.h"
#include "tools/run/enclosed_triangles_limit.h"
#include "tools/run/memory_shares.h"
#include "tools/run/scene_budget.h"
#include "tools/run/scene_files.h"

namespace bp {

namespace {

using Kind = EncloseOption::Kind;

/// Returns the bytes that the triangles of a scene take, from reading them to the end.
std::uint64_t bytes_of(std::uint64_t triangles, const EnclosureInput& in) {
  const std::uint64_t tree = TriangleBvh::bytes_with_triangles(triangles);
  if (in.mode == MeshMode::fit) return triangles * sizeof(TriangleD) + tree;
  return triangles * EnclosedTriangles::kBytesEach + (in.distances ? tree : 0);
}

/// Returns a limit at which so many triangles fit, and what comes after them.
std::uint64_t limit_of_all(std::uint64_t triangles, const EnclosureInput& in) {
  const std::uint64_t after = in.limit ? in.limit(triangles) : 0;
  return std::max(in.memory.limit_for(bytes_of(triangles, in)), after);
}

void check_memory(const std::string& name, std::uint64_t triangles, const EnclosureInput& in) {
  const std::uint64_t bytes = bytes_of(triangles, in), most = in.memory.bytes();
  if (bytes <= most) return;
  const NeedsMemory refusal(fmt::format("{}: enclosing its triangles", name), bytes, most, in.memory.limit_for(bytes),
                            {in.mode == MeshMode::fit ? Remedy::enclose_closing : Remedy::enclose_input});
  fail_with_limit(refusal, [&] { return limit_of_all(triangles, in); });
}

/// Voxels and surface do not exist yet, so half of the memory is for the reader's vertices.
SceneOptions scene_options(const EnclosureInput& in, const std::string& format) {
  SceneOptions options;
  options.format = format;
  options.memory_bytes = in.memory.bytes() / 2;
  options.temp_dir = in.temp_dir;
  options.keep_degenerate = true;
  options.document = document_budget(in.memory.limit.bytes, kMeshProgram, 2);
  return options;
}

/// Throws bad_input if triangles lie outside the bounds: the voxels do not enclose them, so they cannot be kept inside.
void check_bounds(const std::string& name, const std::vector<TriangleD>& chunk, const Bounds3d& bounds) {
  Bounds3d both = bounds;
  for (const TriangleD& t : chunk) both.merge(bounds_of(t));
  if (both == bounds) return;
  fail(ErrorCode::bad_input, "{}: reaches beyond the scene that the stream was made from; name that scene", name);
}

/// Reads the triangles of files into `out`, whose note tells which content of the files was not read.
void read_files(const std::vector<std::string>& files, const EnclosureInput& in, Enclosure& out) {
  const auto scene = open_scenes(files, scene_options(in, ""));
  std::vector<TriangleD> all;
  std::uint64_t triangles = 0;
  for (std::vector<TriangleD> chunk; scene->read(chunk);) {
    check_bounds(scene->name(), chunk, in.header.bounds);
    triangles += chunk.size();
    if (bytes_of(triangles, in) <= in.memory.bytes())
      all.insert(all.end(), chunk.begin(), chunk.end());
    else
      all = {};  // the rest is counted
  }
  check_memory(scene->name(), triangles, in);
  if (all.empty()) fail(ErrorCode::bad_input, "{}: no triangles; there is nothing to enclose", scene->name());
  out.note = reading_note(scene->counts(), in.header.frame.voxel);
  if (!out.note.empty()) out.note = fmt::format("{}: {}", scene->name(), out.note);
  out.rounding = scene->counts().rounding;
  out.scene = std::move(all);
}

/// Tells why the scene's triangles cannot be used, and what the user can do about it.
struct Obstacle {
  std::string why, remedy;
};

Obstacle obstacle(const SceneFault& fault) {
  return {fault.fact, fault.changed ? "run bpvox again" : "name the file with --enclose"};
}

/// Returns the triangles that the stream was made from; none if the scene holds other triangles by now.
std::vector<TriangleD> read_same(TriangleSource& source, const SceneFiles& scene) {
  std::vector<TriangleD> all;
  ContentHash hash;
  all.reserve(scene.triangles);
  for (std::vector<TriangleD> chunk; source.read(chunk);) {
    if (all.size() + chunk.size() > scene.triangles) return {};
    hash.add(std::as_bytes(std::span(chunk)));
    all.insert(all.end(), chunk.begin(), chunk.end());
  }
  const auto [high, low] = hash.value().words;
  if (hex_of(high, low) != scene.hash) return {};
  return all;
}

std::vector<TriangleD> read_same(const SceneFiles& scene, const EnclosureInput& in, Rounding& rounding) {
  try {
    const auto source = open_scenes(names_of(scene), scene_options(in, scene.format));
    std::vector<TriangleD> all = read_same(*source, scene);
    rounding = source->counts().rounding;
    return all;
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    return {};
  }
}

/// Gives `out` the scene's triangles; returns the obstacle if that fails.
std::optional<Obstacle> take_scene(const EnclosureInput& in, bool any_number, Enclosure& out) {
  const SceneFiles& scene = in.header.scene;
  if (in.scene == nullptr) {
    if (const auto fault = fault_of(scene)) return obstacle(*fault);
  }
  if (!any_number && scene.triangles > kMostEnclosedTriangles) {
    return Obstacle{fmt::format("the scene has {} triangles, more than {}", scene.triangles, kMostEnclosedTriangles),
                    "--enclose scene takes them all the same"};
  }
  if (in.scene != nullptr) {
    check_memory(in.scene->name(), scene.triangles, in);
    in.scene->rewind();
    out.scene = read_same(*in.scene, scene);
    out.rounding = in.scene->counts().rounding;
    if (out.scene.empty())
      fail(ErrorCode::bad_input, "{}: its triangles are not those that were voxelized; voxelize it again",
           in.scene->name());
    return std::nullopt;
  }
  const std::string name = file_name(scene.files.front().name);
  keep_inputs(names_of(scene));
  check_memory(name, scene.triangles, in);
  out.scene = read_same(scene, in, out.rounding);
  if (out.scene.empty())
    return obstacle(changed_scene(scene.files.size() == 1 ? scene.files.front().name : "a scene file"));
  return std::nullopt;
}

/// Returns whether `automatic` looks for the scene's triangles at all. It does not for a proxy inside a scene, which is
/// kept by voxels, nor for a fit with a bound on the distance, which begins at the closing. (A fit around a cube's
/// closing would grow thorns: that closing lies outside slanted sides by about the distance in which a fit looks for
/// the scene.)
bool wants_scene(const EnclosureInput& in) {
  if (in.mode == MeshMode::inside) return false;
  const bool cube = in.header.has_closing && in.header.element == StructuringElement::cube;
  return in.mode == MeshMode::bounding || (!in.has_error && !cube);
}

Enclosure automatic(const EnclosureInput& in) {
  Enclosure out;
  if (!wants_scene(in)) return out;
  const std::optional<Obstacle> obstacle = take_scene(in, false, out);
  const bool fit = in.mode == MeshMode::fit;
  if (!obstacle) {
    out.what = Enclose::scene;
    return out;
  }
  out.what = fit ? Enclose::closing : Enclose::input;
  out.note = fmt::format("{}: the {} the scene's voxels, not its triangles, and is less {}; {}", obstacle->why,
                         fit ? "fit follows" : "proxy encloses", fit ? "near" : "tight", obstacle->remedy);
  return out;
}

Enclosure enclosure_of(const EncloseOption& option, const EnclosureInput& in) {
  Enclosure out;
  switch (option.kind) {
    case Kind::automatic:
      return automatic(in);
    case Kind::closing:
      break;
    case Kind::input:
      out.what = Enclose::input;
      break;
    case Kind::files:
      out.what = Enclose::scene;
      read_files(option.files, in, out);
      break;
    case Kind::scene:
      out.what = Enclose::scene;
      if (const std::optional<Obstacle> obstacle = take_scene(in, true, out))
        fail(ErrorCode::bad_input, "--enclose scene: {}; {}, or use --enclose input", obstacle->why, obstacle->remedy);
  }
  return out;
}

}  // namespace

/// Segments and points are dropped for a fit, since it follows surfaces.
Enclosure make_enclosure(const EncloseOption& option, const EnclosureInput& in) {
  // A refusal is of what describes the scene: of named files, it is taken to be the stream's scene.
  Enclosure out = naming_limit([&] { return enclosure_of(option, in); },
                               [&] { return limit_of_all(in.header.scene.triangles, in); });
  if (in.mode == MeshMode::fit)
    std::erase_if(out.scene, [](const TriangleD& t) { return collinear(t[0], t[1], t[2]); });
  return out;
}

}  // namespace bp
