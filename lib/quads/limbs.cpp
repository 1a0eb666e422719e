#include "lib/quads/limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "lib/grid/brick_voxels.h"
#include "lib/mesh/box_group.h"
#include "lib/quads/detail/units.h"

namespace bp {

namespace {

constexpr double kLeastLength = 0.03;  // of the diagonal
constexpr std::int32_t kStep = 3;      // length of a step along an axis; 4 and 5 are those across two and three
constexpr std::int32_t kFar = -1;      // no way leads there

using Cell = std::uint32_t;
constexpr Cell kNoCell = ~Cell(0);

/// A box of cubes, numbered along x first. The outermost ones are empty.
struct Cubes {
  VoxelBox box;
  std::array<std::int32_t, 26> step{}, length{};
  std::array<VoxelCoord, 26> way{};
  std::vector<char> solid;

  explicit Cubes(const VoxelBox& inner) : box(inner.grown(1)), solid(std::size_t(box.volume()), 0) {
    std::size_t n = 0;
    const VoxelCoord size = box.size();
    for (std::int32_t z = -1; z <= 1; ++z) {
      for (std::int32_t y = -1; y <= 1; ++y) {
        for (std::int32_t x = -1; x <= 1; ++x) {
          if (x == 0 && y == 0 && z == 0) continue;
          step[n] = (z * size.y + y) * size.x + x;
          way[n] = {x, y, z};
          length[n++] = kStep - 1 + std::abs(x) + std::abs(y) + std::abs(z);
        }
      }
    }
  }
  [[nodiscard]] Cell number(const VoxelCoord& p) const {
    const VoxelCoord d = p - box.min, size = box.size();
    return Cell((d.z * size.y + d.y) * size.x + d.x);
  }
  [[nodiscard]] VoxelCoord place(Cell c) const {
    const VoxelCoord size = box.size();
    const auto i = std::int32_t(c);
    return box.min + VoxelCoord{i % size.x, i / size.x % size.y, i / size.x / size.y};
  }
};

/// The lengths of the ways from the roots, and the cubes by their length.
struct Ways {
  std::vector<std::int32_t> length;
  std::vector<std::vector<Cell>> by_length;
};

Ways ways_from(const std::vector<Cell>& roots, const Cubes& cubes) {
  Ways ways{std::vector<std::int32_t>(cubes.solid.size(), kFar), {roots}};
  for (const Cell root : roots) ways.length[root] = 0;
  for (std::size_t n = 0; n < ways.by_length.size(); ++n) {
    std::vector<Cell> settled;
    for (std::size_t i = 0; i < ways.by_length[n].size(); ++i) {
      const Cell c = ways.by_length[n][i];
      if (ways.length[c] != std::int32_t(n)) continue;
      settled.push_back(c);
      for (std::size_t k = 0; k < cubes.step.size(); ++k) {
        const Cell to = c + Cell(cubes.step[k]);
        const std::int32_t far = std::int32_t(n) + cubes.length[k];
        if (!cubes.solid[to] || (ways.length[to] != kFar && ways.length[to] <= far)) continue;
        ways.length[to] = far;
        if (ways.by_length.size() <= std::size_t(far)) ways.by_length.resize(std::size_t(far) + 1);
        ways.by_length[std::size_t(far)].push_back(to);
      }
    }
    std::sort(settled.begin(), settled.end());
    settled.erase(std::unique(settled.begin(), settled.end()), settled.end());
    ways.by_length[n] = std::move(settled);
  }
  return ways;
}

/// Returns the solid cubes, the deepest first: in the reverse order in which they go if layers of cubes are taken away
/// from outside.
std::vector<Cell> by_depth(const Cubes& cubes) {
  std::vector<char> left = cubes.solid;
  std::vector<Cell> order, layer, next;
  const std::array<std::size_t, 6> sides{4, 10, 12, 13, 15, 21};  // the steps along axes
  for (Cell c = 0; c < left.size(); ++c) {
    if (!left[c]) continue;
    if (std::any_of(sides.begin(), sides.end(), [&](std::size_t k) { return !left[c + Cell(cubes.step[k])]; }))
      layer.push_back(c);
  }
  while (!layer.empty()) {
    std::sort(layer.begin(), layer.end());
    order.insert(order.end(), layer.rbegin(), layer.rend());
    for (const Cell c : layer) left[c] = 0;
    next.clear();
    for (const Cell c : layer) {
      for (const std::size_t k : sides) {
        const Cell to = c + Cell(cubes.step[k]);
        if (left[to] == 1) left[to] = 2, next.push_back(to);
      }
    }
    std::swap(layer, next);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// Returns, for each connected part that holds some of `cells`, the first of these in it.
std::vector<Cell> first_of_parts(const std::vector<Cell>& cells, const Cubes& cubes) {
  std::vector<char> left = cubes.solid;
  std::vector<Cell> first, part;
  for (const Cell cell : cells) {
    if (!left[cell]) continue;
    first.push_back(cell);
    left[cell] = 0;
    part.assign(1, cell);
    while (!part.empty()) {
      const Cell c = part.back();
      part.pop_back();
      for (const std::int32_t step : cubes.step) {
        const Cell to = c + Cell(step);
        if (left[to]) left[to] = 0, part.push_back(to);
      }
    }
  }
  return first;
}

/// Grows the parts of the cubes beyond t while t shrinks. Two parts that meet are named by a cube each; meet(one,
/// other, t) returns the name that their union keeps. grown(t, name_of) is called when all cubes of t have their parts.
template <class Meet, class Grown>
void grow_parts(const Ways& ways, const Cubes& cubes, const Meet& meet, const Grown& grown) {
  std::vector<Cell> up(ways.length.size(), kNoCell);
  const auto find = [&](Cell c) {
    while (up[c] != c) c = up[c] = up[up[c]];
    return c;
  };
  for (std::size_t n = ways.by_length.size(); n-- > 0;) {
    for (const Cell c : ways.by_length[n]) {
      up[c] = c;
      for (const std::int32_t step : cubes.step) {
        const Cell to = c + Cell(step);
        if (up[to] == kNoCell) continue;
        const Cell a = find(c), b = find(to);
        if (a == b) continue;
        const Cell kept = meet(a, b, std::int32_t(n));
        up[kept == a ? b : a] = kept;
      }
    }
    grown(std::int32_t(n), find);
  }
}

/// Returns the width of a section: the most that its cubes extend along one of the 13 directions between neighbours.
double width_of(std::span<const std::array<Cell, 2>> section, const Cubes& cubes) {
  double width = 0;
  for (std::size_t k = 0; k < cubes.way.size() / 2; ++k) {
    const VoxelCoord& way = cubes.way[k];
    std::int32_t low = std::numeric_limits<std::int32_t>::max(), high = std::numeric_limits<std::int32_t>::min();
    for (const auto& [part, cube] : section) {
      const VoxelCoord p = cubes.place(cube);
      const std::int32_t at = way.x * p.x + way.y * p.y + way.z * p.z;
      low = std::min(low, at);
      high = std::max(high, at);
    }
    const std::int32_t axes = std::abs(way.x) + std::abs(way.y) + std::abs(way.z);  // a cube extends as far
    width = std::max(width, (high - low + axes) / std::sqrt(axes));
  }
  return width;
}

/// Returns the tips of the parts that have a neck: at some t, the ways from their section to the root and to the tip
/// are both longer than it is wide, and the latter at least `least` long. A part is named by its tip.
std::vector<Cell> tips_of(const Ways& ways, const Cubes& cubes, double least) {
  std::set<Cell> tips;
  std::vector<std::array<Cell, 2>> cut;  // names of parts, and their cubes next to t
  const auto meet = [&](Cell a, Cell b, std::int32_t) {
    const bool first = ways.length[a] != ways.length[b] ? ways.length[a] > ways.length[b] : a < b;
    return first ? a : b;
  };
  grow_parts(ways, cubes, meet, [&](std::int32_t t, const auto& name_of) {
    if (t % kStep != 0) return;
    cut.clear();
    for (auto n = std::size_t(t); n < std::min(std::size_t(t + kStep), ways.by_length.size()); ++n) {
      for (const Cell c : ways.by_length[n]) {
        const Cell name = name_of(c);
        if (ways.length[name] - t >= least * kStep && !tips.contains(name)) cut.push_back({name, c});
      }
    }
    std::sort(cut.begin(), cut.end());
    for (auto first = cut.begin(), last = first; first != cut.end(); first = last) {
      last = std::find_if(first, cut.end(), [&](const auto& c) { return c[0] != (*first)[0]; });
      if (std::min(t, ways.length[(*first)[0]] - t) >= width_of({first, last}, cubes) * kStep) tips.insert((*first)[0]);
    }
  });
  return {tips.begin(), tips.end()};
}

/// Returns, for each tip, the t at which its part first meets a part with another tip; 0 if it meets none.
std::vector<std::int32_t> meetings_of(const std::vector<Cell>& tips, const Ways& ways, const Cubes& cubes) {
  std::vector<std::int32_t> met(tips.size(), 0);
  std::map<Cell, std::vector<std::size_t>> inside;  // tips of a part, by its name
  for (std::size_t i = 0; i < tips.size(); ++i) inside[tips[i]] = {i};
  const auto meet = [&](Cell a, Cell b, std::int32_t t) {
    const auto in_a = inside.find(a), in_b = inside.find(b);
    if (in_b == inside.end()) return a;
    if (in_a == inside.end()) return b;
    for (const auto& part : {in_a, in_b}) {
      if (part->second.size() == 1) met[part->second[0]] = t;
    }
    in_a->second.insert(in_a->second.end(), in_b->second.begin(), in_b->second.end());
    inside.erase(in_b);
    return a;
  };
  grow_parts(ways, cubes, meet, [](std::int32_t, const auto&) {});
  return met;
}

/// Marks the cubes whose middles lie inside a closed mesh. `corner`: lattice point at the corner of cube (0, 0, 0);
/// `edge`: of a cube, lattice units. Along each line of middles, those lie inside that have an odd number of crossings
/// below. Lines are moved off the corners of the mesh by an odd share of a lattice unit.
void mark_inside(const LatticeMesh& mesh, const LatticeCoord& corner, double edge, Cubes& cubes) {
  constexpr double kAside[2] = {0.137, 0.291};  // lattice units
  std::vector<char> crossed(cubes.solid.size(), 0);
  for (const auto& t : mesh.triangles) {
    std::array<std::array<double, 3>, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i)
        p[k][std::size_t(i)] = (double(mesh.vertices[t[k]][i] - corner[i]) + (i < 2 ? kAside[i] : 0)) / edge - 0.5;
    }
    const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    if (area == 0) continue;
    std::array<std::int32_t, 2> low{}, high{};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto [least, most] = std::minmax({p[0][i], p[1][i], p[2][i]});
      low[i] = std::max(std::int32_t(std::ceil(least)), cubes.box.min[int(i)]);
      high[i] = std::min(std::int32_t(std::floor(most)), cubes.box.max[int(i)] - 1);
    }
    for (std::int32_t y = low[1]; y <= high[1]; ++y) {
      for (std::int32_t x = low[0]; x <= high[0]; ++x) {
        const double u = ((x - p[0][0]) * (p[2][1] - p[0][1]) - (y - p[0][1]) * (p[2][0] - p[0][0])) / area;
        const double v = ((p[1][0] - p[0][0]) * (y - p[0][1]) - (p[1][1] - p[0][1]) * (x - p[0][0])) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const double z = std::ceil(p[0][2] + u * (p[1][2] - p[0][2]) + v * (p[2][2] - p[0][2]));
        if (z < cubes.box.max.z) crossed[cubes.number({x, y, std::max(std::int32_t(z), cubes.box.min.z)})] ^= 1;
      }
    }
  }
  for (std::int32_t y = cubes.box.min.y + 1; y < cubes.box.max.y - 1; ++y) {
    for (std::int32_t x = cubes.box.min.x + 1; x < cubes.box.max.x - 1; ++x) {
      char inside = crossed[cubes.number({x, y, cubes.box.min.z})];
      for (std::int32_t z = cubes.box.min.z + 1; z < cubes.box.max.z - 1; ++z) {
        const Cell c = cubes.number({x, y, z});
        inside = char(inside ^ crossed[c]);
        if (inside) cubes.solid[c] = 1;
      }
    }
  }
}

/// Makes the hollows solid that the grown voxels close off from the outside. The gaps that they fill stay empty.
void fill_within(const BrickShelf& grown, Units& units) {
  const VoxelBox box = bounds_of_voxels(grown);
  VoxelBox around =
      hull(units.box, {units.unit(box.min), units.unit(box.max - VoxelCoord{1, 1, 1}) + VoxelCoord{1, 1, 1}});
  const std::int32_t margin = std::max(units.box.min.x - around.min.x, around.max.x - units.box.max.x);
  Grid wall(around);
  for_each_voxel(grown, [&](const VoxelCoord& p) { wall.at(units.unit(p)) = 1; });
  Grid filled = wall;
  fill(filled);
  std::vector<VoxelCoord> layer, next;
  for_each(units.box, [&](const VoxelCoord& p) {
    if (filled.at(p) && !wall.at(p)) layer.push_back(p);
  });
  for (std::int32_t i = 0; i <= margin; ++i) {
    next.clear();
    for (const VoxelCoord& p : layer) {
      if (std::exchange(units.solid.at(p), 1) == 1) continue;
      for_each_neighbour(p, [&](const VoxelCoord& q, int, bool) {
        if (units.box.contains(q) && !units.solid.at(q)) next.push_back(q);
      });
    }
    std::swap(layer, next);
  }
  fill(units.solid);
}

}  // namespace

struct Limbs::State {
  explicit State(const Units& u) : origin(u.origin), edge(u.edge), cubes(u.box) {
    for_each(u.box, [&](const VoxelCoord& p) { cubes.solid[cubes.number(p)] = u.solid.at(p); });
  }
  VoxelCoord origin;  // in voxels
  std::int32_t edge;  // in voxels
  Cubes cubes;
  std::vector<VoxelCoord> roots, tips;
  std::vector<std::int32_t> length;
};

namespace {

std::vector<VoxelCoord> places_of(const std::vector<Cell>& cells, const Cubes& cubes) {
  std::vector<VoxelCoord> places;
  places.reserve(cells.size());
  for (const Cell c : cells) places.push_back(cubes.place(c));
  return places;
}

std::vector<Cell> numbers_of(const std::vector<VoxelCoord>& places, const Cubes& cubes) {
  std::vector<Cell> cells;
  cells.reserve(places.size());
  for (const VoxelCoord& p : places) cells.push_back(cubes.number(p));
  return cells;
}

}  // namespace

Limbs::Limbs(const BrickShelf& model, const BrickShelf& grown) {
  Units units = units_of(model, std::nullopt);
  fill_within(grown, units);
  state_ = std::make_unique<State>(units);
  State& s = *state_;
  const std::vector<Cell> roots = first_of_parts(by_depth(s.cubes), s.cubes);
  const Ways ways = ways_from(roots, s.cubes);
  const VoxelCoord size = units.box.size();
  const double diagonal = std::sqrt(double(size.x) * size.x + double(size.y) * size.y + double(size.z) * size.z);
  const std::vector<Cell> tips = tips_of(ways, s.cubes, kLeastLength * diagonal);
  const std::vector<std::int32_t> met = meetings_of(tips, ways, s.cubes);
  for (std::size_t i = 0; i < tips.size(); ++i) s.length.push_back(ways.length[tips[i]] - met[i]);
  s.roots = places_of(roots, s.cubes);
  s.tips = places_of(tips, s.cubes);
}

Limbs::~Limbs() = default;

std::size_t Limbs::count() const {
  return state_->tips.size();
}

std::string Limbs::key() const {
  const State& s = *state_;
  std::string key(s.cubes.solid.begin(), s.cubes.solid.end());
  for (const VoxelCoord& p : {s.origin, s.cubes.box.min, s.cubes.box.max})
    key += fmt::format(" {} {} {}", p.x, p.y, p.z);
  return key + fmt::format(" {}", s.edge);  // limbs follow from the cubes
}

CageFit Limbs::fit(const LatticeMesh& cage) const {
  const State& s = *state_;
  LatticeCoord corner;
  for (int i = 0; i < 3; ++i) corner[i] = std::int64_t(s.origin[i]) * kLatticePerVoxel;
  const std::int64_t edge = std::int64_t(s.edge) * kLatticePerVoxel;
  const LatticeBox bounds = box_of(cage.vertices);
  VoxelBox box = s.cubes.box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::min(box.min[i], std::int32_t(floor_div(bounds.min[i] - corner[i], edge)));
    box.max[i] = std::max(box.max[i], std::int32_t(floor_div(bounds.max[i] - corner[i], edge)) + 1);
  }
  Cubes around(box);
  for_each(s.cubes.box,
           [&](const VoxelCoord& p) { around.solid[around.number(p)] = s.cubes.solid[s.cubes.number(p)]; });
  mark_inside(cage, corner, double(edge), around);
  std::vector<Cell> model;
  CageFit fit;
  for (Cell c = 0; c < around.solid.size(); ++c) {
    fit.cubes += std::size_t(around.solid[c]);
    if (s.cubes.box.contains(around.place(c)) && s.cubes.solid[s.cubes.number(around.place(c))] != 0)
      model.push_back(c);
  }
  fit.reach = std::int32_t(ways_from(model, around).by_length.size()) - 1;
  if (s.tips.size() < 2) return fit;
  const Ways ways = ways_from(first_of_parts(numbers_of(s.roots, around), around), around);
  const std::vector<Cell> tips = numbers_of(s.tips, around);
  const std::vector<std::int32_t> met = meetings_of(tips, ways, around);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    if (2 * (ways.length[tips[i]] - met[i]) > s.length[i]) continue;
    const VoxelCoord& p = s.tips[i];
    fit.joined.push_back(corner +
                         LatticeCoord{(2 * p.x + 1) * edge / 2, (2 * p.y + 1) * edge / 2, (2 * p.z + 1) * edge / 2});
  }
  return fit;
}

}  // namespace bp
