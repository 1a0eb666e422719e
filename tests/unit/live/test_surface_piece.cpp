#include <cmath>
#include <map>

#include "lib/live/surface_piece.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"
#include "tests/support/memory_shelf.h"

using namespace bp;

namespace {

void put(const BitBox& bits, BrickShelf& shelf) {
  store_voxels(bits, shelf);
}

std::vector<SurfacePiece> pieces_of(const BrickShelf& shelf) {
  ScaleLattice scale;
  ScaleField field;
  field.base = 2;
  std::vector<SurfacePiece> all;
  for (const BrickCoord c : shelf.coords()) {
    all.push_back(piece_of(shelf, c, field.sample(GridFrame{}, voxels_of(c).grown(1))));
  }
  return all;
}

/// A vertex in 1/256 voxel of the grid.
std::array<std::int64_t, 3> place(const SurfacePiece& piece, std::uint32_t i) {
  const auto& p = piece.vertices[i].position;
  const VoxelCoord first = first_voxel(piece.brick);
  std::array<std::int64_t, 3> out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = std::int64_t(p[k]) + (std::int64_t(first[int(k)]) - SurfacePiece::kOrigin) * SurfacePiece::kPerVoxel;
  return out;
}

}  // namespace

TEST_CASE("a surface to look at is closed across bricks, and within half a voxel of the corners", "[quick][live]") {
  reference::Random random(7);
  for (int round = 0; round < 6; ++round) {
    const VoxelBox all{{-64, -64, -64}, {64, 64, 64}};
    BitBox bits(all);
    for (int i = 0; i < 8; ++i) {
      const VoxelCoord c{random.between(-40, 40), random.between(-40, 40), random.between(-40, 40)};
      const int r = random.between(2, 18);
      for_each(intersect(VoxelBox{c, c}.grown(r), all), [&](VoxelCoord p) {
        const VoxelCoord d = p - c;
        if (d.x * d.x + d.y * d.y + d.z * d.z < r * r) bits.set(p);
      });
    }
    test::MemoryShelf shelf;
    put(bits, shelf);
    using Place = std::array<std::int64_t, 3>;
    std::map<std::pair<Place, Place>, int> edges;
    for (const SurfacePiece& piece : pieces_of(shelf)) {
      for (const auto& face : piece.faces) {
        for (const auto& t : triangles_of(face)) {
          for (std::size_t k = 0; k < 3; ++k) {
            const Place a = place(piece, t[k]), b = place(piece, t[(k + 1) % 3]);
            ++edges[{a, b}];
            --edges[{b, a}];
            for (std::size_t axis = 0; axis < 3; ++axis) {
              const double side = std::abs(double(a[axis] - b[axis])) / SurfacePiece::kPerVoxel;
              CHECK(side <= 1 + 2 * SurfacePiece::kMostMoved);
            }
          }
        }
      }
    }
    REQUIRE(edges.size() > 100);
    for (const auto& [edge, n] : edges) CHECK(n == 0);
  }
}

TEST_CASE("a flat side stays where it is, and a ball has normals from its middle", "[quick][live]") {
  BitBox bits(VoxelBox{{0, 0, 0}, {64, 64, 64}});
  for_each(VoxelBox{{10, 10, 10}, {50, 50, 30}}, [&](VoxelCoord p) { bits.set(p); });
  test::MemoryShelf shelf;
  put(bits, shelf);
  const SurfacePiece plate = pieces_of(shelf).at(0);
  int flat = 0;
  for (const SurfacePiece::Vertex& v : plate.vertices) {
    const double x = double(v.position[0]) / 256 - 8, y = double(v.position[1]) / 256 - 8,
                 z = double(v.position[2]) / 256 - 8;
    if (x < 20 || x > 40 || y < 20 || y > 40 || z < 20) continue;
    CHECK(z == 30);
    CHECK(v.normal == std::array<std::int8_t, 4>{0, 0, 127, 0});
    CHECK(v.scale == 2 * kScaleOne);
    ++flat;
  }
  CHECK(flat == 21 * 21);

  bits.reset(bits.box());
  for_each(bits.box(), [&](VoxelCoord p) {
    const VoxelCoord d = p - VoxelCoord{32, 32, 32};
    if ((2 * d.x + 1) * (2 * d.x + 1) + (2 * d.y + 1) * (2 * d.y + 1) + (2 * d.z + 1) * (2 * d.z + 1) < 4 * 24 * 24)
      bits.set(p);
  });
  put(bits, shelf);
  double worst = 1;
  const SurfacePiece ball = pieces_of(shelf).at(0);
  for (const SurfacePiece::Vertex& v : ball.vertices) {
    double dot = 0, length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = double(v.position[k]) / 256 - 8 - 32;
      dot += d * v.normal[k] / 127;
      length += d * d;
    }
    worst = std::min(worst, dot / std::sqrt(length));
  }
  CHECK(worst > 0.97);
}
