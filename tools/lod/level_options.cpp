#include "tools/lod/level_options.h"

#include <algorithm>

#include "lib/core/error.h"

namespace bp {

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

void check(const LevelOptions& o) {
  const LevelRequest r = request_of(o);
  if (int(asks_for_faces(r)) + int(!o.errors.empty()) + int(!o.pixels.empty()) > 1)
    fail(ErrorCode::bad_argument, "--faces, --error and --screen exclude each other");
  if (o.levels && (*o.levels < 1 || *o.levels > kMostLevels))
    fail(ErrorCode::bad_argument, "--levels {}: must be 1 to {}", *o.levels, kMostLevels);
  const std::size_t listed = std::max({r.faces.size(), r.shares.size(), r.errors_world.size()});
  if (o.levels && listed > 1 && listed != *o.levels)
    fail(ErrorCode::bad_argument, "--levels {}, and a list of {}; leave one of them out", *o.levels, listed);
}

LevelRequest request_of(const LevelOptions& o, double diagonal, double voxel) {
  LevelRequest r;
  r.levels = o.levels;
  r.faces = o.faces;
  r.shares = o.shares;
  for (const Length& error : o.errors) r.errors_world.push_back(error.in_world(diagonal, 0));
  for (const double pixels : o.pixels) r.errors_world.push_back(diagonal / pixels);
  if (o.scale) r.scale_world = o.scale->in_world(diagonal, voxel);
  return r;
}

}  // namespace bp
