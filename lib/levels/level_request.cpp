#include "lib/levels/level_request.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

std::size_t list_size(const LevelRequest& r) {
  return std::max({r.faces.size(), r.shares.size(), r.errors_world.size()});
}

/// Returns the default budget of a finest level. In a scene of few triangles each of them may be needed.
std::uint64_t default_faces(std::uint64_t triangles, const LevelDefaults& defaults) {
  const auto share = std::uint64_t(double(triangles) / defaults.triangles_per_face);
  return std::max({share, std::min(triangles, kLeastFirstFaces), defaults.least_faces});
}

/// Returns the number of levels that have at least kLeastFaces if each has a quarter of the faces before; at most
/// kDefaultLevels.
std::uint64_t levels_from(std::uint64_t faces) {
  std::uint64_t levels = 1;
  while (levels < kDefaultLevels && (faces >> (2 * levels)) >= kLeastFaces) ++levels;
  return levels;
}

}  // namespace

std::size_t level_count(const LevelRequest& r) {
  if (r.levels) return std::size_t(*r.levels);
  return list_size(r) > 0 ? list_size(r) : std::size_t(kDefaultLevels);
}

bool is_explicit(const LevelRequest& r) {
  return r.levels || list_size(r) > 1;
}

bool asks_for_faces(const LevelRequest& r) {
  return !r.faces.empty() || !r.shares.empty();
}

bool asks_for_nothing(const LevelRequest& r) {
  return list_size(r) == 0;
}

LevelRequest with_defaults(LevelRequest r, std::uint64_t triangles, const LevelDefaults& defaults) {
  for (const double share : r.shares)
    r.faces.push_back(
        std::uint64_t(std::max(std::round(share / 100 * double(triangles)), double(kFacesOfTetrahedron))));
  r.shares.clear();
  if (!asks_for_nothing(r)) return r;
  r.most_faces = default_faces(triangles, defaults);
  if (!defaults.by_voxels) r.faces = {std::min(r.most_faces, defaults.most_faces)};
  r.is_chosen = !r.levels;
  if (!r.levels) r.levels = levels_from(r.most_faces);
  return r;
}

LodTarget tile_target(const LevelRequest& r, std::size_t i) {
  LodTarget target;
  const int n = int(i);
  if (!r.errors_world.empty()) {
    target.error_world = i < r.errors_world.size() ? r.errors_world[i] : std::ldexp(r.errors_world[0], n);
  } else if (!r.faces.empty()) {
    target.faces = i < r.faces.size() ? r.faces[i] : r.faces[0];
  }
  if (r.scale_world) target.scale_world = std::ldexp(*r.scale_world, n);
  return target;
}

LodTarget level_target(const LevelRequest& r, std::size_t i, std::size_t since, std::uint64_t dense_faces) {
  LodTarget target = tile_target(r, i);
  if (target.error_world > 0 || i < r.faces.size()) return target;
  const std::uint64_t first = r.faces.empty()
                                  ? std::min(std::max(dense_faces / kDensePerFace, kLeastFirstFaces), r.most_faces)
                                  : r.faces.front();
  const int n = int(i - since);
  target.faces = std::max(n < 32 ? first >> (2 * n) : 0, kLeastFaces);
  return target;
}

bool clearly_fewer(std::uint64_t faces, std::uint64_t asked) {
  // A collapse removes two faces at a time, so merging may end one face below an odd number.
  return faces + 2 <= asked && double(faces) < kClearlyLess * double(asked);
}

}  // namespace bp
