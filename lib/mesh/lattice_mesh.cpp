#include "lib/mesh/lattice_mesh.h"

namespace bp {

int128 volume6_of(std::span<const LatticeCoord> vertices, std::span<const std::array<std::uint32_t, 3>> triangles) {
  int128 sum = 0;
  for (const auto& [a, b, c] : triangles) sum += orient3d_value(vertices[0], vertices[a], vertices[b], vertices[c]);
  return sum;
}

std::vector<std::uint32_t> drop_unused_vertices(std::vector<LatticeCoord>& vertices,
                                                std::span<std::array<std::uint32_t, 3>> triangles) {
  std::vector<char> used(vertices.size(), 0);
  for (const auto& t : triangles) {
    for (const std::uint32_t v : t) used[v] = 1;
  }
  std::vector<std::uint32_t> kept, number(vertices.size());
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    number[v] = std::uint32_t(kept.size());
    vertices[kept.size()] = vertices[v];
    kept.push_back(v);
  }
  vertices.resize(kept.size());
  for (auto& t : triangles) {
    for (std::uint32_t& v : t) v = number[v];
  }
  return kept;
}

}  // namespace bp
