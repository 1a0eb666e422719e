#include "tools/lod/lod_targets.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::uint64_t kDefaultLevels = 4;
constexpr std::uint64_t kLeastFirstFaces = 200;

std::size_t list_size(const LodRequest& r) {
  return std::max({r.faces.size(), r.shares.size(), r.errors.size(), r.pixels.size()});
}

/// Of a finest level that nobody asked for. Of a scene of few triangles each of them may be needed.
std::uint64_t default_faces(std::uint64_t triangles, double triangles_per_face) {
  const auto share = std::uint64_t(double(triangles) / triangles_per_face);
  return std::max({share, std::min(triangles, kLeastFirstFaces), kLeastFaces});
}

/// As many as have at least kLeastFaces, if each has a quarter of those before.
std::uint64_t levels_from(std::uint64_t faces) {
  std::uint64_t levels = 1;
  while (levels < kDefaultLevels && (faces >> (2 * levels)) >= kLeastFaces) ++levels;
  return levels;
}

}  // namespace

std::vector<Length> parse_errors(const std::string& text) {
  std::vector<Length> all;
  for_each_item(text, [&](std::string_view item) {
    all.push_back(parse_length(item));
    const Length& last = all.back();
    if (last.unit == Length::Unit::voxels)
      fail(ErrorCode::bad_argument, "{}: the voxels follow from the errors; use scene units or percent", text);
    if (!(last.value > 0)) fail(ErrorCode::bad_argument, "{}: an error must be above 0", text);
    if (last.unit != all.front().unit) fail(ErrorCode::bad_argument, "{}: mixes units", text);
    if (all.size() > 1 && last.value <= all[all.size() - 2].value)
      fail(ErrorCode::bad_argument, "{}: each level must have a larger one than the one before", text);
  });
  return all;
}

std::vector<double> parse_pixels(const std::string& text) {
  std::vector<double> all;
  for_each_item(text, [&](std::string_view item) {
    all.push_back(parse_number(item));
    if (!(all.back() > 0)) fail(ErrorCode::bad_argument, "{}: a size must be above 0 pixels", text);
    if (all.size() > 1 && all.back() >= all[all.size() - 2])
      fail(ErrorCode::bad_argument, "{}: each level must be for a smaller size than the one before", text);
  });
  return all;
}

void check(const LodRequest& r) {
  if (int(asks_for_faces(r)) + int(!r.errors.empty()) + int(!r.pixels.empty()) > 1)
    fail(ErrorCode::bad_argument, "--faces, --error and --screen exclude each other");
  if (r.levels && (*r.levels < 1 || *r.levels > kMostLevels))
    fail(ErrorCode::bad_argument, "--levels {}: must be 1 to {}", *r.levels, kMostLevels);
  if (r.levels && list_size(r) > 1 && list_size(r) != *r.levels)
    fail(ErrorCode::bad_argument, "--levels {}, and a list of {}; leave one of them out", *r.levels, list_size(r));
}

std::size_t level_count(const LodRequest& r) {
  if (r.levels) return std::size_t(*r.levels);
  return list_size(r) > 0 ? list_size(r) : std::size_t(kDefaultLevels);
}

bool is_explicit(const LodRequest& r) {
  return r.levels || list_size(r) > 1;
}

bool asks_for_faces(const LodRequest& r) {
  return !r.faces.empty() || !r.shares.empty();
}

bool asks_for_nothing(const LodRequest& r) {
  return list_size(r) == 0;
}

LodRequest request_for(LodRequest r, std::uint64_t triangles, const LodDefaults& defaults) {
  constexpr double kLeast = 4;  // of a closed surface
  for (const double share : r.shares)
    r.faces.push_back(std::uint64_t(std::max(std::round(share / 100 * double(triangles)), kLeast)));
  r.shares.clear();
  if (!asks_for_nothing(r)) return r;
  r.most_faces = default_faces(triangles, defaults.triangles_per_face);
  if (!defaults.by_voxels) r.faces = {std::min(r.most_faces, defaults.most_faces)};
  if (!r.levels) r.levels = levels_from(r.most_faces);
  return r;
}

double finest_error(const LodRequest& r, double diagonal) {
  if (!r.errors.empty()) return r.errors[0].in_world(diagonal, 0);
  if (!r.pixels.empty()) return diagonal / r.pixels[0];
  return 0;
}

LodTarget tile_target_of(const LodRequest& r, std::size_t i, double diagonal, double voxel) {
  LodTarget target;
  const int n = int(i);
  if (!r.errors.empty()) {
    target.error_world =
        i < r.errors.size() ? r.errors[i].in_world(diagonal, 0) : std::ldexp(r.errors[0].in_world(diagonal, 0), n);
  } else if (!r.pixels.empty()) {
    target.error_world = diagonal / (i < r.pixels.size() ? r.pixels[i] : std::ldexp(r.pixels[0], -n));
  } else if (!r.faces.empty()) {
    target.faces = i < r.faces.size() ? r.faces[i] : r.faces[0];
  }
  if (r.scale) target.scale_world = std::ldexp(r.scale->in_world(diagonal, voxel), n);
  return target;
}

LodTarget target_of(const LodRequest& r, std::size_t i, std::size_t since, double diagonal, double voxel,
                    std::uint64_t dense_faces) {
  LodTarget target = tile_target_of(r, i, diagonal, voxel);
  if (target.error_world > 0 || i < r.faces.size()) return target;
  const std::uint64_t first = r.faces.empty()
                                  ? std::min(std::max(dense_faces / kDensePerFace, kLeastFirstFaces), r.most_faces)
                                  : r.faces.front();
  const int n = int(i - since);
  target.faces = std::max(n < 32 ? first >> (2 * n) : 0, kLeastFaces);
  return target;
}

}  // namespace bp
