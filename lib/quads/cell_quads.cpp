#include "lib/quads/cell_quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "lib/quads/detail/units.h"

namespace bp {

namespace {

constexpr std::int32_t kCubesAlong = 40;  // planes along the longest side before merging

/// Makes the grid of cubes: solid where a cube holds a unit of the surface, or lies inside.
BoxGrid cubes_of(const Units& units, std::int32_t edge, const std::optional<MirrorPlane>& plane) {
  BoxGrid cells;
  VoxelCoord first;
  for (int i = 0; i < 3; ++i) {
    first[i] = floor_div(units.box.min[i], edge);
    std::int32_t last = floor_div(units.box.max[i] - 1, edge) + 1;
    if (plane && plane->axis == i) last = std::max(last, -first[i]), first[i] = -last;
    for (std::int32_t c = first[i]; c <= last; ++c) cells.planes[std::size_t(i)].push_back(c * edge);
  }
  cells.solid = Grid(cells.box());
  for_each(units.box, [&](VoxelCoord p) {
    bool open = false;  // the surface suffices, since cubes inside are filled
    if (units.solid.at(p)) {
      for_each_neighbour(p, [&](const VoxelCoord& q, int, bool) { open = open || !units.solid.at(q); });
    }
    if (!open) return;
    for (int i = 0; i < 3; ++i) p[i] = floor_div(p[i], edge) - first[i];
    cells.solid.at(p) = 1;
    if (!plane) return;
    p[plane->axis] = cells.box().max[plane->axis] - 1 - p[plane->axis];
    cells.solid.at(p) = 1;
  });
  fill(cells.solid);
  return cells;
}

/// Returns the grid without the plane between boxes i and i + 1 of an axis. A merged box is solid if either of the two
/// was.
BoxGrid without_plane(const BoxGrid& cells, int axis, std::int32_t i) {
  BoxGrid out;
  out.planes = cells.planes;
  auto& planes = out.planes[std::size_t(axis)];
  planes.erase(planes.begin() + i + 1);
  out.solid = Grid(out.box());
  for_each(cells.box(), [&](const VoxelCoord& p) {
    if (!cells.solid.at(p)) return;
    VoxelCoord q = p;
    q[axis] -= p[axis] > i;
    out.solid.at(q) = 1;
  });
  return out;
}

/// Returns the volume of gaps between solid boxes that removing the plane between boxes i and i + 1 would fill: there
/// limbs grow together. `middle`: box i - 1 is the mirror image of box i.
double gaps_filled(const BoxGrid& cells, int axis, std::int32_t i, bool middle) {
  double volume = 0;
  VoxelBox layer = cells.box();
  layer.min[axis] = i;
  layer.max[axis] = i + 1;
  const int u = (axis + 1) % 3, w = (axis + 2) % 3;
  for_each(layer, [&](const VoxelCoord& p) {
    const auto solid = [&](std::int32_t k) {
      VoxelCoord q = p;
      q[axis] += k;
      return cells.solid.at(q) != 0;
    };
    if (solid(0) == solid(1)) return;
    const bool gap = solid(1) ? middle || solid(-1) : solid(2);
    const std::int32_t thickness = cells.thickness(axis, solid(1) ? i : i + 1);
    if (gap) volume += double(thickness) * cells.thickness(u, p[u]) * cells.thickness(w, p[w]);
  });
  return volume;
}

/// Removes planes one after the other: each time the plane that adds the least volume for the faces that it saves.
/// Planes beyond the edge of the solid go last.
class Merger {
 public:
  Merger(BoxGrid cells, std::uint64_t faces, const std::optional<MirrorPlane>& plane)
      : cells_(std::move(cells)), faces_(faces), plane_(plane) {
    mend(cells_, plane_);
  }

  std::optional<BoxGrid> run() {
    for (;;) {
      const Size now = size_of(cells_);
      if (now.faces <= faces_) return std::move(cells_);
      edge_ = std::sqrt(now.area / (double(faces_) / 2));
      if (!merge(now)) return std::nullopt;
      mend(cells_, plane_);
    }
  }

 private:
  bool merge(const Size& now) {
    std::optional<BoxGrid> best;
    double least = HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t n = cells_.box().max[axis];
      const bool mirrored = plane_ && plane_->axis == axis;
      for (std::int32_t i = mirrored ? n / 2 : 0; i + 1 < n; ++i) {
        BoxGrid other = without_plane(cells_, axis, i);
        if (mirrored) other = without_plane(other, axis, n - 2 - i);
        Size then = size_of(other);
        then.volume += kGapWeight * gaps_filled(cells_, axis, i, mirrored && i == n / 2);
        const double price = price_of(then, now, cells_.thickness(axis, i) + cells_.thickness(axis, i + 1));
        if (price >= least) continue;
        least = price;
        best = std::move(other);
      }
    }
    if (best) cells_ = std::move(*best);
    return best.has_value();
  }

  [[nodiscard]] double price_of(const Size& then, const Size& now, double thickness) const {
    const double saved = double(now.faces) - double(then.faces), added = then.volume - now.volume;
    const double shape = std::max(1.0, thickness / edge_);
    return (added + kLeastAdded * now.volume) * shape * shape * shape * shape / std::max(saved, kLeastSaved);
  }

  static constexpr double kGapWeight = 40;
  static constexpr double kLeastAdded = 1e-4, kLeastSaved = 0.1;
  BoxGrid cells_;
  std::uint64_t faces_;
  const std::optional<MirrorPlane>& plane_;
  double edge_ = 0;
};

/// Makes pairs of triangles from the faces between solid and empty cells.
class QuadMesher {
 public:
  QuadMesher(const BoxGrid& cells, const Units& units, const std::optional<MirrorPlane>& plane)
      : cells_(cells), units_(units), plane_(plane) {}

  CellQuads run(const GridFrame& frame) {
    out_.mesh.frame = frame;
    const Grid& cells = cells_.solid;
    const std::int32_t middle = plane_ ? cells_.box().max[plane_->axis] / 2 : 0;
    for_each(cells_.box(), [&](const VoxelCoord& p) {
      if (!cells.at(p) || (plane_ && p[plane_->axis] < middle)) return;
      for_each_neighbour(p, [&](const VoxelCoord& q, int axis, bool high) {
        if (!cells.at(q)) face(high ? q : p, axis, high);
      });
    });
    if (plane_) mirror();
    return std::move(out_);
  }

 private:
  std::uint32_t vertex(const VoxelCoord& corner) {
    const auto [it, fresh] = number_.try_emplace(std::tuple(corner.x, corner.y, corner.z), number_.size());
    if (fresh) {
      LatticeCoord p;
      for (int i = 0; i < 3; ++i) {
        const std::int64_t unit = cells_.planes[std::size_t(i)][std::size_t(corner[i])];
        p[i] = (unit * units_.edge + units_.origin[i]) * kLatticePerVoxel;
      }
      out_.mesh.vertices.push_back(p);
    }
    return std::uint32_t(it->second);
  }

  void face(const VoxelCoord& first, int axis, bool high) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    std::uint32_t q[4];
    for (int k = 0; k < 4; ++k) {
      const int i = high ? k : (4 - k) % 4;
      VoxelCoord corner = first;
      corner[u] += i == 1 || i == 2;
      corner[w] += i >= 2;
      q[k] = vertex(corner);
    }
    add({q[0], q[1], q[2]}, {q[0], q[2], q[3]});
  }

  void add(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
    auto& triangles = out_.mesh.triangles;
    const auto n = std::uint32_t(triangles.size());
    triangles.push_back(a);
    triangles.push_back(b);
    out_.mesh.quads.push_back({n, n + 1});
  }

  void mirror() {
    auto& vertices = out_.mesh.vertices;
    const auto n = std::uint32_t(vertices.size());
    out_.mate.resize(n);
    for (std::uint32_t v = 0; v < n; ++v) {
      out_.mate[v] = v;
      if (vertices[v][plane_->axis] == plane_->lattice()) continue;
      out_.mate[v] = std::uint32_t(vertices.size());
      out_.mate.push_back(v);
      vertices.push_back(plane_->mirrored(vertices[v]));
    }
    const auto half = out_.mesh.triangles;
    const auto over = [&](const std::array<std::uint32_t, 3>& t) {
      return std::array<std::uint32_t, 3>{out_.mate[t[0]], out_.mate[t[2]], out_.mate[t[1]]};
    };
    for (std::size_t i = 0; i < half.size(); i += 2) add(over(half[i]), over(half[i + 1]));
  }

  const BoxGrid& cells_;
  const Units& units_;
  const std::optional<MirrorPlane>& plane_;
  std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, std::size_t> number_;
  CellQuads out_;
};

}  // namespace

CellQuads cell_quads(const BrickShelf& voxels, const GridFrame& frame, std::uint64_t faces,
                     const std::optional<MirrorPlane>& plane) {
  const Units units = units_of(voxels, plane);
  std::optional<BoxGrid> cells = Merger(cubes_of(units, kUnitsAlong / kCubesAlong, plane), faces, plane).run();
  return cells ? QuadMesher(*cells, units, plane).run(frame) : CellQuads{};
}

CellQuads cube_quads(const BrickShelf& voxels, const GridFrame& frame, std::int32_t units,
                     const std::optional<MirrorPlane>& plane) {
  const Units all = units_of(voxels, plane);
  BoxGrid cells = cubes_of(all, units, plane);
  mend(cells, plane);
  return QuadMesher(cells, all, plane).run(frame);
}

}  // namespace bp
