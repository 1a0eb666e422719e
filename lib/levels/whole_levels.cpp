#include "lib/levels/whole_levels.h"

#include <algorithm>
#include <cmath>

#include "lib/grid/clip.h"
#include "lib/quads/limbs.h"
#include "lib/store/packing.h"
#include "lib/store/result_key.h"

namespace bp {

ResultKey key_of(const WholeInput& input) {
  const auto& [header, solid, first, count, request, lod, colors, encoding] = input;
  // The memory decides no byte; that is all of `context`, and how `surface` is kept. The fields about refusals and
  // about an earlier check of the scene decide none either.
  const auto& [closing, mode, enclose, scene, rounding, is_within, surface, least_scale_world, field, foreseen, cage,
               context] = lod;
  const GridFrame& frame = header.frame;
  KeyHash hash("levels in one mesh");
  hash.add(encoding, first, count, frame, header.bounds, header.scene.triangles, request.faces.size());
  hash.add(closing, mode, enclose, std::as_bytes(std::span(scene)), rounding.share, rounding.offset, least_scale_world,
           cage ? cage->plane : std::nullopt, cage && cage->limbs ? cage->limbs->key() : "",
           field ? to_json(*field) : "");
  // A fixed number of dense faces will do, since the solid decides the true one.
  for (std::size_t i = 0; i < count; ++i) {
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

std::optional<WholeLevels> kept_levels(const ResultKey& key, ResultStore& store) {
  std::string bytes;
  WholeLevels kept;
  if (!store.get(key, bytes)) return std::nullopt;
  std::string_view left = bytes;
  if (!unpack(left, kept) || !left.empty()) return std::nullopt;
  return kept;
}

void keep_levels(const ResultKey& key, const WholeLevels& levels, ResultStore& store) {
  std::string bytes;
  pack(bytes, levels);
  store.put(key, bytes);
}

Bounds3d bounds_of(const LatticeMesh& mesh) {
  Bounds3d bounds;
  for (const LatticeCoord v : mesh.vertices) bounds.add(mesh.frame.world(v));
  return bounds;
}

Vec3d common_origin(const std::vector<LodLevel>& levels) {
  double voxel = 0;
  Bounds3d bounds;
  for (const LodLevel& level : levels) {  // the origin is a corner of the largest voxels, and so of all
    voxel = std::max(voxel, level.mesh.frame.voxel);
    bounds.merge(bounds_of(level.mesh));
  }
  Vec3d origin;
  for (std::size_t i = 0; i < 3; ++i)
    origin[i] = std::nearbyint((bounds.min[i] / 2 + bounds.max[i] / 2) / voxel) * voxel + 0.0;
  return origin;
}

}  // namespace bp
