#include "tools/lod/whole_levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/mesh/lod_writer.h"
#include "lib/grid/clip.h"
#include "tools/lod/level_chain.h"
#include "tools/lod/lod_outputs.h"

namespace bp {

namespace {

constexpr const char* kJob = "levels in one mesh";

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

Json json_of(const WholeLevel& level) {
  const LevelRow& r = level.row;
  Json steps = Json::array();
  for (const Provenance& p : level.provenance) steps.push_back({p.tool, p.version, p.options, p.input_hash});
  return {{"size", level.content.size()},
          {"min", level.bounds.min},
          {"max", level.bounds.max},
          {"file", r.file},
          {"faces", r.faces},
          {"error", r.error_world},
          {"scale", r.scale_world},
          {"voxel", r.voxel},
          {"more", r.more},
          {"provenance", steps}};
}

WholeLevel level_from(const Json& json) {
  WholeLevel level;
  level.bounds = {json["min"].get<Vec3d>(), json["max"].get<Vec3d>()};
  level.row = {json["file"], 1, json["faces"], json["size"], json["error"], json["scale"], json["voxel"], json["more"]};
  for (const Json& p : json["provenance"]) level.provenance.push_back({p[0], p[1], p[2], p[3]});
  return level;
}

/// Size of a JSON, the JSON, the contents.
std::string packed(const WholeLevels& whole, const Json& notes) {
  Json json{{"origin", whole.origin}, {"notes", notes}, {"levels", Json::array()}};
  for (const WholeLevel& level : whole.levels) json["levels"].push_back(json_of(level));
  const std::string text = json.dump();
  const std::uint64_t size = text.size();
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
  bytes += text;
  for (const WholeLevel& level : whole.levels) bytes += level.content;
  return bytes;
}

WholeLevels unpacked(const std::string& bytes, std::vector<std::string>& notes) {
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  const Json json = Json::parse(bytes.substr(sizeof size, size));
  WholeLevels whole;
  whole.origin = json["origin"].get<Vec3d>();
  notes = json["notes"].get<std::vector<std::string>>();
  std::size_t at = sizeof size + size;
  for (const Json& level : json["levels"]) {
    whole.levels.push_back(level_from(level));
    whole.levels.back().content = bytes.substr(at, whole.levels.back().row.bytes);
    at += whole.levels.back().row.bytes;
  }
  return whole;
}

/// Everything that the levels depend on.
ResultKey key_of(const Build& build, const WholeInput& input, const LodOptions& lod) {
  const BuildOptions& o = build.options;
  KeyHash hash(kJob);
  hash.add(std::string_view(o.name)).add(std::string_view(input.input_hash)).add(input.scene_voxel);
  hash.add(std::int64_t(input.first)).add(std::int64_t(input.count)).add(lod.least_scale_world);
  hash.add(std::int64_t(lod.scene.size())).add(std::as_bytes(std::span(lod.scene)));
  const GridFrame& frame = input.header.frame;
  hash.add(frame.voxel).add(std::int64_t(frame.up));
  for (const std::int64_t x : frame.origin) hash.add(x);
  for (const Vec3d& p : {input.header.bounds.min, input.header.bounds.max})
    for (const double x : p) hash.add(x);
  for (std::size_t i = 0; i < input.count; ++i) {  // dense faces are of the solid
    const LodTarget target =
        target_of(o.request, input.first + i, input.first, input.header.bounds.diagonal(), input.scene_voxel, 1000000);
    hash.add(std::int64_t(target.faces)).add(target.error_world).add(target.scale_world.value_or(-1));
    hash.add(std::string_view(option_text(o, build.enclosed(), target, i, 0, frame).text()));
  }
  hash.add(std::int64_t(o.request.faces.size()));
  add_voxels(hash, *input.solid, voxels_of(input.header.bricks), {});
  add_voxels(hash, *input.surface, voxels_of(input.header.bricks), {});
  if (build.colors() != nullptr) {
    build.colors()->prepare(input.header.frame);
    build.colors()->all(input.header.frame).add_to(hash);
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
  if (store->get(key, bytes)) {
    std::vector<std::string> notes;
    WholeLevels whole = unpacked(bytes, notes);
    for (const std::string& note : notes) build.note(note);
    whole.kept = true;
    return whole;
  }
  const std::size_t notes_before = build.report.notes.size();
  WholeLevels whole = make(build, std::move(input), std::move(lod));
  Json notes = Json::array();
  for (std::size_t i = notes_before; i < build.report.notes.size(); ++i) notes.push_back(build.report.notes[i]);
  store->put(key, packed(whole, notes));
  return whole;
}

}  // namespace bp
