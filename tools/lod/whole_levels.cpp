#include "tools/lod/whole_levels.h"

#include <algorithm>
#include <cmath>

#include "io/mesh/lod_writer.h"
#include "lib/grid/clip.h"
#include "lib/store/packing.h"
#include "tools/lod/level_chain.h"
#include "tools/lod/lod_outputs.h"

namespace bp {

namespace {

constexpr const char* kJob = "levels in one mesh";

/// A LevelRow with its JSON as text.
struct Row {
  std::string file;
  std::uint64_t tiles = 0, faces = 0, bytes = 0;
  double error = 0, scale = 0, voxel = 0;
  std::string more;
};

Bounds3d bounds_of(const LatticeMesh& mesh) {
  Bounds3d bounds;
  for (const LatticeCoord v : mesh.vertices) bounds.add(mesh.frame.world(v));
  return bounds;
}

/// A point that is a lattice point of every level: a corner of the largest voxels, near the middle.
Vec3d common_origin(const std::vector<LodLevel>& levels) {
  double voxel = 0;
  Bounds3d bounds;
  for (const LodLevel& level : levels) {
    voxel = std::max(voxel, level.mesh.frame.voxel);
    bounds.merge(bounds_of(level.mesh));
  }
  Vec3d origin;
  for (std::size_t i = 0; i < 3; ++i)
    origin[i] = std::nearbyint((bounds.min[i] / 2 + bounds.max[i] / 2) / voxel) * voxel + 0.0;
  return origin;
}

/// What the store keeps of the levels.
std::string packed(const WholeLevels& whole, const std::vector<std::string>& notes) {
  std::string bytes;
  pack(bytes, whole.origin);
  pack(bytes, notes);
  pack(bytes, whole.levels.size());
  for (const auto& [content, bounds, row, provenance] : whole.levels) {
    const auto& [file, tiles, faces, size, error, scale, voxel, more] = row;
    pack(bytes, content);
    pack(bytes, bounds);
    pack(bytes, Row{file, tiles, faces, size, error, scale, voxel, more.dump()});
    pack(bytes, provenance);
  }
  return bytes;
}

bool unpack_levels(std::string_view bytes, WholeLevels& whole, std::vector<std::string>& notes) {
  std::size_t size = 0;
  bool good = unpack(bytes, whole.origin) && unpack(bytes, notes) && unpack(bytes, size);
  for (std::size_t i = 0; good && i < size; ++i) {
    auto& [content, bounds, row, provenance] = whole.levels.emplace_back();
    Row r;
    good = unpack(bytes, content) && unpack(bytes, bounds) && unpack(bytes, r) && unpack(bytes, provenance);
    if (good) row = {r.file, r.tiles, r.faces, r.bytes, r.error, r.scale, r.voxel, Json::parse(r.more)};
  }
  return good;
}

/// Everything that the levels depend on.
ResultKey key_of(const Build& build, const WholeInput& input, const LodOptions& lod) {
  const BuildOptions& o = build.options;
  KeyHash hash(kJob);
  const auto& [header, solid, surface, first, count, scene_voxel, input_hash] = input;
  const GridFrame& frame = header.frame;
  hash.add(o.name, o.request.faces.size(), input_hash, scene_voxel, first, count, frame, header.bounds);
  hash.add(lod.least_scale_world, std::as_bytes(std::span(lod.scene)));
  for (std::size_t i = 0; i < count; ++i) {  // dense faces are of the solid
    const LodTarget target = target_of(o.request, first + i, first, header.bounds.diagonal(), scene_voxel, 1000000);
    const auto& [faces, error_world, scale_world, detail] = target;
    hash.add(faces, error_world, scale_world, detail, option_text(o, build.enclosed(), target, i, 0, frame).text());
  }
  add_voxels(hash, *solid, voxels_of(header.bricks), {});
  add_voxels(hash, *surface, voxels_of(header.bricks), {});
  if (build.colors() != nullptr) {
    build.colors()->prepare(frame);
    hash.add(build.colors()->all(frame));
  }
  return hash.key();
}

WholeLevels make(Build& build, WholeInput input, LodOptions lod) {
  WholeLevels whole;
  const Bounds3d bounds = input.header.bounds;
  lod.surface = std::move(input.surface);
  LodChain chain(input.header, std::move(input.solid), build.backends, std::move(lod));
  const std::vector<LodLevel> levels = make_levels(
      build, chain, {build.options.request, input.first, input.count, input.scene_voxel, bounds, input.input_hash});
  whole.origin = common_origin(levels);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LatticeMesh& mesh = levels[i].mesh;
    const std::string name = level_name(build.options.name, input.first + i);
    WholeLevel& out = whole.levels.emplace_back();
    out.content = tile_glb({name, &mesh}, lattice_point(mesh.frame, whole.origin));
    out.bounds = bounds_of(mesh);
    out.row = row_of(levels[i], name + ".glb", out.content.size());
    out.provenance = mesh.provenance;
  }
  return whole;
}

}  // namespace

bool are_kept(const Build& build, const WholeInput& input, const LodOptions& lod, ResultStore& store) {
  std::string bytes;
  return store.get(key_of(build, input, lod), bytes);
}

WholeLevels make_whole_levels(Build& build, WholeInput input, LodOptions lod, ResultStore* store) {
  if (store == nullptr) return make(build, std::move(input), std::move(lod));
  const ResultKey key = key_of(build, input, lod);
  std::string bytes;
  std::vector<std::string> notes;
  if (WholeLevels whole; store->get(key, bytes) && unpack_levels(bytes, whole, notes)) {
    for (const std::string& note : notes) build.note(note);
    whole.kept = true;
    return whole;
  }
  const std::size_t notes_before = build.report.notes.size();
  WholeLevels whole = make(build, std::move(input), std::move(lod));
  notes.clear();
  for (std::size_t i = notes_before; i < build.report.notes.size(); ++i) notes.push_back(build.report.notes[i]);
  store->put(key, packed(whole, notes));
  return whole;
}

}  // namespace bp
