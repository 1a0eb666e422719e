#include "lib/levels/whole_levels.h"

#include <algorithm>
#include <cmath>

#include "lib/grid/clip.h"
#include "lib/store/packing.h"
#include "lib/store/result_key.h"

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

/// Everything that the levels depend on.
ResultKey key_of(const WholeInput& input) {
  const auto& [header, solid, first, count, request, lod, colors, encoding] = input;
  // No byte depends on the memory, which is all of `context` and of how `surface` is kept.
  const auto& [closing, mode, enclose, scene, surface, least_scale_world, field, quads, context] = lod;
  const GridFrame& frame = header.frame;
  KeyHash hash(kJob);
  hash.add(encoding, first, count, frame, header.bounds, header.scene.triangles, request.faces.size());
  hash.add(closing, mode, enclose, std::as_bytes(std::span(scene)), least_scale_world, quads,
           field ? to_json(*field) : "");
  for (std::size_t i = 0; i < count; ++i) {  // dense faces are of the solid
    hash.add(level_target(request, first + i, first, 1000000));
  }
  add_voxels(hash, *solid, voxels_of(header.bricks), {});
  add_voxels(hash, *surface, voxels_of(header.bricks), {});
  if (colors != nullptr) {
    colors->prepare(frame);
    hash.add(colors->all(frame));
  }
  return hash.key();
}

bool unpack_whole(std::string_view bytes, WholeLevels& whole) {
  return unpack(bytes, whole) && bytes.empty();
}

WholeLevels make(WholeInput input, Backends& backends, const LevelSteps& steps, const WholeEncoder& encode) {
  LodChain chain(input.header, std::move(input.solid), backends, std::move(input.lod));
  const MadeLevels made =
      make_levels(chain, {input.request, input.first, input.count, input.header.bounds.diagonal()}, steps);
  WholeLevels whole;
  whole.origin = common_origin(made.levels);
  whole.left_out = made.left_out;
  for (std::size_t i = 0; i < made.levels.size(); ++i) {
    const LatticeMesh& mesh = made.levels[i].mesh;
    whole.levels.push_back(
        {encode(input.first + i, mesh, whole.origin), bounds_of(mesh), made.facts[i], mesh.provenance});
  }
  return whole;
}

}  // namespace

bool are_kept(const WholeInput& input, ResultStore& store) {
  std::string bytes;
  return store.get(key_of(input), bytes);
}

WholeLevels make_whole_levels(WholeInput input, Backends& backends, const LevelSteps& steps, const WholeEncoder& encode,
                              ResultStore* store) {
  if (store == nullptr) return make(std::move(input), backends, steps, encode);
  const ResultKey key = key_of(input);
  std::string bytes;
  if (WholeLevels kept; store->get(key, bytes) && unpack_whole(bytes, kept)) {
    kept.kept = true;
    return kept;
  }
  WholeLevels whole = make(std::move(input), backends, steps, encode);
  bytes.clear();
  pack(bytes, whole);
  store->put(key, bytes);
  return whole;
}

}  // namespace bp
