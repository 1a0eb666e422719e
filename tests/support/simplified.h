#pragma once
#include <meshoptimizer.h>

#include <map>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"

/// meshoptimizer's simplifier, with which measurements compare levels.
namespace bp::test {

inline std::vector<TriangleD> read_triangles(const std::string& path) {
  const auto scene = open_scenes({path}, {});
  std::vector<TriangleD> all;
  for (std::vector<TriangleD> chunk; scene->read(chunk);) all.insert(all.end(), chunk.begin(), chunk.end());
  return all;
}

/// Simplifies. Equal positions are merged first, as meshoptimizer wants it; in floats relative to `middle`.
inline std::vector<TriangleD> simplified(const std::vector<TriangleD>& in, const Vec3d& middle, std::size_t faces) {
  std::map<Vec3d, unsigned> number;
  std::vector<float> points;
  std::vector<unsigned> indices;
  for (const TriangleD& t : in) {
    for (const Vec3d& p : t) {
      const auto [at, fresh] = number.try_emplace(p, unsigned(number.size()));
      for (std::size_t i = 0; fresh && i < 3; ++i) points.push_back(float(p[i] - middle[i]));
      indices.push_back(at->second);
    }
  }
  constexpr float kAnyError = 1e9F;
  std::vector<unsigned> out(indices.size());
  out.resize(meshopt_simplify(out.data(), indices.data(), indices.size(), points.data(), number.size(),
                              3 * sizeof(float), 3 * faces, kAnyError, 0, nullptr));
  std::vector<TriangleD> result(out.size() / 3);
  for (std::size_t k = 0; k < out.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) result[k / 3][k % 3][i] = double(points[3 * out[k] + i]) + middle[i];
  }
  return result;
}

}  // namespace bp::test
