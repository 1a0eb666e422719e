#pragma once
#include "io/scene/points/scene_points.h"
#include "tests/unit/io/scene/scene_files.h"

namespace bp::test {

inline std::vector<Vec3d> points_of(const std::string& path) {
  const auto points = open_points(path, {});
  std::vector<Vec3d> all, some;
  while (points->read(some)) all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// A file of the scene with its points moved.
inline std::string moved_file(const TempDir& dir, const std::string& path, const MovePoints& move) {
  OutputFile out(dir.path("moved" + path.substr(path.rfind('.'))), true);
  open_points(path, {})->write(move, out);
  out.commit();
  return out.name();
}

/// Its bytes.
inline std::string moved(const TempDir& dir, const std::string& path, const MovePoints& move) {
  return bytes_of_file(moved_file(dir, path, move));
}

}  // namespace bp::test
