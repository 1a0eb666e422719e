#include "lib/hulls/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "lib/core/disjoint_sets.h"
#include "lib/core/parallel.h"
#include "lib/hulls/convex_budget.h"
#include "lib/hulls/detail/convex_cut.h"
#include "lib/hulls/detail/convex_merge.h"
#include "lib/hulls/detail/convex_shape.h"
#include "lib/hulls/detail/convex_simplify.h"
#include "lib/hulls/detail/convex_tighten.h"

namespace bp {

namespace {

using Face = std::array<std::uint32_t, 3>;

/// Returns the part of `mesh` made of these faces, with only the vertices that they use, in the order of first use.
LatticeMesh part_of(const LatticeMesh& mesh, const std::vector<Face>& faces) {
  LatticeMesh part;
  part.frame = mesh.frame;
  part.provenance = mesh.provenance;
  std::map<std::uint32_t, std::uint32_t> renamed;
  for (Face f : faces) {
    for (std::uint32_t& v : f) {
      const auto [found, is_new] = renamed.emplace(v, std::uint32_t(part.vertices.size()));
      if (is_new) part.vertices.push_back(mesh.vertices[v]);
      v = found->second;
    }
    part.triangles.push_back(f);
  }
  return part;
}

constexpr double kSmall = 2e-3;            // of the volume: what a hull may have above the solid in it
constexpr double kGrowth = 0.01;           // of a hull's volume, for fewer corners
constexpr std::uint64_t kFewestFaces = 4;  // of a closed surface
constexpr std::size_t kFacesOfBox = 12;
// Joining knows more than the first cuts do, so more cells are cut than hulls are wanted.
constexpr std::size_t kCellsPerHull = 4;

LatticeMesh mesh_of(const LatticeMesh& mesh, ConvexHull hull) {
  LatticeMesh made;
  made.frame = mesh.frame;
  made.provenance = mesh.provenance;
  made.vertices = std::move(hull.vertices);
  made.triangles = std::move(hull.triangles);
  return made;
}

void append(LatticeMesh& mesh, const LatticeMesh& other) {
  const auto first = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

/// Returns outer shells with the cavities in them. A cavity that is not found to lie in any shell is filled.
std::vector<SolidCell> solids_of(const LatticeMesh& mesh) {
  std::vector<LatticeMesh> outer, cavities;
  for (LatticeMesh& part : components_of(mesh)) (volume6_of(part) > 0 ? outer : cavities).push_back(std::move(part));
  std::vector<SolidCell> shells(outer.begin(), outer.end());
  for (const LatticeMesh& cavity : cavities) {
    std::optional<std::size_t> around;
    for (std::size_t i = 0; i < shells.size(); ++i) {
      if (!shells[i].cell().holds(box_of(cavity.vertices)) || !shells[i].holds(cavity.vertices[0])) continue;
      if (!around || shells[*around].cell().holds(shells[i].cell())) around = i;
    }
    if (around) append(outer[*around], cavity);
  }
  if (cavities.empty()) return shells;
  return {outer.begin(), outer.end()};
}

double volume6_of(const std::vector<ConvexHull>& hulls) {
  double sum = 0;
  for (const ConvexHull& hull : hulls) sum += volume6_of(hull);
  return sum;
}

/// Hulls, with marks for those that are as they were given.
struct Hulls {
  std::vector<ConvexHull> hulls;
  std::vector<char> given;
};

/// Sets corners of different hulls apart, which may make slivers again.
void set_apart(Hulls& made) {
  for (int round = 0; round < 4; ++round) {
    set_corners_apart(made.hulls);
    bool fine = true;
    for (std::size_t i = 0; i < made.hulls.size(); ++i) {
      ConvexHull& hull = made.hulls[i];
      draw_diagonals(hull);
      if (made.given[i] || slivers_of(hull) == 0) continue;
      fine = false;
      hull = without_slivers(std::move(hull));
    }
    if (fine) return;
  }
  set_corners_apart(made.hulls);
}

/// Returns hulls around `wrapped` with no more faces than are wanted, as far as that is possible without reaching out
/// of their boxes. A single hull may always reach out.
Hulls simplified(const std::vector<Wrapped>& wrapped, const HullLimits& limits, bool& short_of_faces) {
  Hulls made;
  for (const Wrapped& w : wrapped) made.hulls.push_back(w.hull), made.given.push_back(char(w.given));
  parallel_for(std::int64_t(wrapped.size()), [&](std::int64_t i) {
    ConvexHull& hull = made.hulls[std::size_t(i)];
    if (!made.given[std::size_t(i)])
      hull = without_slivers(with_fewer_corners(std::move(hull), limits.corners, kGrowth));
  });
  if (limits.faces > 0 && face_count(made.hulls) > limits.faces) {
    short_of_faces = true;
    keep_to_faces(made.hulls, limits.faces, kNearBox);
    if (made.hulls.size() == 1) keep_to_faces(made.hulls, limits.faces, kFarOut);
  }
  parallel_for(std::int64_t(wrapped.size()), [&](std::int64_t i) {
    ConvexHull& hull = made.hulls[std::size_t(i)];
    const std::vector<LatticeCoord>& corners = wrapped[std::size_t(i)].hull.vertices;
    if (made.given[std::size_t(i)] && hull.vertices == corners) return;
    made.given[std::size_t(i)] = 0;
    hull = tightened(std::move(hull), corners);
  });
  return made;
}

/// Returns the number of hulls, at most limits.hulls, that leaves the least volume within the faces.
Hulls few_hulls(const std::vector<Wrapped>& wrapped, const HullLimits& limits, double small6, bool& short_of_faces) {
  constexpr double kWorse = 1.03;  // relative volume at which fewer hulls are not tried any more
  Hulls best;
  double least6 = std::numeric_limits<double>::infinity();
  for (std::size_t count = limits.hulls; count > 0;) {
    const std::vector<Wrapped> joined = merge_hulls(wrapped, count, small6);
    count = std::min(count, joined.size());
    Hulls made = simplified(joined, limits, short_of_faces);
    if (!short_of_faces) return made;
    // There are too few faces for each hull, unless all are boxes.
    if (face_count(made.hulls) > limits.faces && count > 1) {
      count = std::max(count * 3 / 4, std::min(count - 1, std::size_t(limits.faces) / kFacesOfBox));
      continue;
    }
    const double now6 = volume6_of(made.hulls);
    if (now6 > kWorse * least6) break;
    if (now6 < least6) least6 = now6, best = std::move(made);
    count = count * 3 / 4;
  }
  return best;
}

/// Returns the hull of each cell's part of its solid, and the given hulls, each as a solid of its own.
std::vector<Wrapped> wrap(const std::vector<SolidCell>& cells, const std::vector<ConvexHull>& given) {
  std::vector<std::optional<ConvexHull>> found(cells.size());
  parallel_for(std::int64_t(cells.size()), [&](std::int64_t i) {
    found[std::size_t(i)] = hull_of(cells[std::size_t(i)].points(SolidCell::Rounding::outward));
  });
  std::vector<Wrapped> wrapped;
  std::map<const void*, std::uint32_t> numbers;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t solid = numbers.emplace(cells[i].solid(), std::uint32_t(numbers.size())).first->second;
    if (found[i])
      wrapped.push_back({std::move(*found[i]), cells[i].volume6(), solid});  // a cell may have no part of the solid
  }
  auto solid = std::uint32_t(numbers.size());
  for (const ConvexHull& hull : given) wrapped.push_back({hull, volume6_of(hull), solid++, true});
  return wrapped;
}

/// Makes the parts; limits.hulls must be above 0. `volume6`: of everything that the hulls are around.
ConvexParts parts_within(const LatticeMesh& mesh, const std::vector<SolidCell>& solids, const HullLimits& limits,
                         const std::vector<ConvexHull>& given, double volume6) {
  ConvexParts parts;
  parts.solids = solids.size() + given.size();
  const double small6 = kSmall * volume6;
  const std::vector<Wrapped> wrapped = wrap(cut_to_convex(solids, kCellsPerHull * limits.hulls, small6), given);
  Hulls made = few_hulls(wrapped, limits, small6, parts.short_of_faces);
  set_apart(made);
  parts.limited = made.hulls.size() >= limits.hulls;
  for (ConvexHull& hull : made.hulls) parts.hulls.push_back(mesh_of(mesh, std::move(hull)));
  return parts;
}

}  // namespace

std::vector<LatticeMesh> components_of(const LatticeMesh& mesh) {
  DisjointSets joined(mesh.vertices.size());
  for (const Face& f : mesh.triangles) {
    for (const std::uint32_t v : f) joined.unite(v, f[0]);
  }
  std::map<std::uint32_t, std::size_t> number;
  std::vector<std::vector<Face>> faces;
  for (const Face& f : mesh.triangles) {
    const auto [found, is_new] = number.emplace(joined.find(f[0]), faces.size());
    if (is_new) faces.emplace_back();
    faces[found->second].push_back(f);
  }
  std::vector<LatticeMesh> parts;
  parts.reserve(faces.size());
  for (const std::vector<Face>& f : faces) parts.push_back(part_of(mesh, f));
  return parts;
}

std::size_t most_hulls(const HullLimits& limits, std::size_t parts) {
  return limits.hulls > 0 ? limits.hulls : std::max(kMostHulls, parts);
}

std::size_t most_given(std::size_t hulls) {
  return kCellsPerHull * hulls;
}

double volume_of(const ConvexParts& parts) {
  double sum = 0;
  for (const LatticeMesh& hull : parts.hulls)
    sum += double(volume6_of(hull)) / 6 * std::pow(hull.frame.voxel / kLatticePerVoxel, 3);
  return sum;
}

ConvexParts convex_parts(const LatticeMesh& mesh, const HullLimits& limits, const std::vector<ConvexHull>& given) {
  constexpr double kLoose = 1.5;  // volume over the solid's: above it, more hulls and faces may be worth their cost
  constexpr double kClearlyLess = 0.85;  // of the volume: below it, they are
  const std::vector<SolidCell> solids = solids_of(mesh);
  const double volume6 = double(volume6_of(mesh)) + volume6_of(given);
  HullLimits within = limits;
  within.hulls = most_hulls(limits, solids.size());
  if (limits.faces > 0) within.faces = std::max(limits.faces, kFewestFaces);
  ConvexParts parts = parts_within(mesh, solids, within, given, volume6);
  const double solid = volume6 / 6 * std::pow(mesh.frame.voxel / kLatticePerVoxel, 3);
  const bool more_hulls = limits.hulls == 0 && within.hulls < kMostLooseHulls && parts.limited;
  const bool more_faces = within.faces < limits.loose_faces && parts.short_of_faces;
  if ((!more_hulls && !more_faces) || volume_of(parts) < kLoose * solid) return parts;
  if (limits.hulls == 0) within.hulls = std::max(within.hulls, kMostLooseHulls);
  within.faces = std::max(within.faces, limits.loose_faces);
  ConvexParts more = parts_within(mesh, solids, within, given, volume6);
  return volume_of(more) < kClearlyLess * volume_of(parts) ? more : parts;
}

}  // namespace bp
