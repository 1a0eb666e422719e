#include "lib/simplify/collapse_regions.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/core/parallel.h"
#include "lib/simplify/detail/collapse_order.h"
#include "lib/simplify/regions.h"

namespace bp {

namespace {

// The cells' sides have their turn before the faces wanted are reached: half of the way, nearly all of it, the rest.
constexpr double kNearly = 1.1;  // of the faces wanted
constexpr int kTurns = 5;        // at most
constexpr int kSets = 3;         // of cells: after so many turns all vertices have been free, or nearly
constexpr double kJam = 1e-3;    // of the faces: a turn that takes less is the last
// Regions with few faces are mostly sides, which stay fine while the middles are collapsed to spikes: with so many
// times the faces of one, the rest is for the whole.
constexpr std::uint64_t kLeast = 2;

/// A region at work.
struct Part {
  Part(const Piece& whole, const Region& r, std::vector<Quadric> quadrics, const SimplifyParams& p)
      : region(r),
        params(p),
        mesh(mesh_of(whole, r)),
        collapser(mesh, std::move(quadrics), params, counts),
        order(collapser) {}

  void put_back(Piece& whole) {
    if (collapser.sense() != nullptr) erase_turned_shells(mesh, *collapser.sense());
    bp::put_back(mesh, region, whole);
    order.count(counts);
  }

  const Region& region;
  SimplifyParams params;
  SimplifyCounts counts;
  HalfEdgeMesh mesh;
  Collapser collapser;
  StrictOrder order;
};

/// The quadrics of a whole that is cut into regions: none is held twice.
class QuadricsApart {
 public:
  /// Takes them from the whole.
  QuadricsApart(Piece& whole, std::span<const Region> regions) : of_region_(regions.size()) {
    std::vector<char> free(whole.vertices.size(), 0);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      for (std::size_t i = 0; i < regions[r].free.size(); ++i) {
        if (!regions[r].free[i]) continue;
        free[regions[r].vertices[i]] = 1;
        of_region_[r].emplace_back(VertexId(i), whole.quadrics[regions[r].vertices[i]]);
      }
    }
    for (VertexId v = 0; v < free.size(); ++v) {
      if (!free[v]) fixed_.emplace_back(v, whole.quadrics[v]);
    }
    std::vector<Quadric>().swap(whole.quadrics);
  }
  /// Per vertex of the region; nothing for those that are not free.
  [[nodiscard]] std::vector<Quadric> give(std::size_t number, const Region& region) {
    std::vector<Quadric> quadrics(region.vertices.size());
    for (const auto& [v, q] : of_region_[number]) quadrics[v] = q;
    List().swap(of_region_[number]);
    return quadrics;
  }
  void take(std::size_t number, const Part& part) {
    for (VertexId v = 0; v < part.region.free.size(); ++v) {
      if (part.region.free[v] && part.mesh.vertex_alive(v))
        of_region_[number].emplace_back(part.region.vertices[v], part.collapser.quadric(v));
    }
  }
  void put_back(Piece& whole) const {
    whole.quadrics.resize(whole.vertices.size());
    for (const auto& [v, q] : fixed_) whole.quadrics[v] = q;
    for (const List& some : of_region_) {
      for (const auto& [v, q] : some) whole.quadrics[v] = q;
    }
  }

 private:
  using List = std::vector<std::pair<VertexId, Quadric>>;
  List fixed_;
  std::vector<List> of_region_;
};

void turn(Piece& whole, int number, std::uint64_t enough, const SimplifyParams& params, SimplifyCounts& counts) {
  const std::vector<Region> regions = regions_of(whole, params.faces_per_region, number);
  QuadricsApart quadrics(whole, regions);
  std::vector<std::unique_ptr<Part>> parts(regions.size());
  parallel_for(std::int64_t(regions.size()), [&](std::int64_t k) {
    const auto i = std::size_t(k);
    SimplifyParams own = params;
    own.whole.faces_elsewhere = whole.triangles.size() - regions[i].faces.size();
    parts[i] = std::make_unique<Part>(whole, regions[i], quadrics.give(i, regions[i]), own);
  });
  std::vector<CostOrder*> orders;
  for (const auto& part : parts) orders.push_back(&part->order);
  take_cheapest(orders, whole.triangles.size() - enough);
  std::vector<SimplifyCounts> told(parts.size());
  parallel_for(std::int64_t(parts.size()), [&](std::int64_t k) {
    const auto i = std::size_t(k);
    parts[i]->put_back(whole);
    quadrics.take(i, *parts[i]);
    told[i] = parts[i]->counts;
    parts[i].reset();
  });
  counts.refused = {};  // of the turn before
  for (const SimplifyCounts& some : told) counts.add_beside(some);
  quadrics.put_back(whole);
  drop_removed(whole);
}

}  // namespace

bool has_regions(std::uint64_t faces, const SimplifyParams& params) {
  constexpr std::uint64_t kFew = 4;
  return faces > kFew * params.faces_per_region && params.limits == nullptr;
}

void collapse_in_regions(Piece& whole, const SimplifyParams& params, SimplifyCounts& counts) {
  SimplifyParams own = params;
  own.whole.volume6 = std::abs(double(volume6_of(whole.vertices, whole.triangles)));
  if (whole.quadrics.empty()) whole.quadrics = quadrics_of(HalfEdgeMesh(whole.vertices, whole.triangles, kEverywhere));
  const std::uint64_t least = std::max(params.faces, kLeast * params.faces_per_region);
  const auto wanted = double(least);
  const double halfway = std::sqrt(double(whole.triangles.size()) * wanted);
  for (int number = 0; number < kTurns && whole.triangles.size() > least; ++number) {
    const double enough = number == 0 ? std::max(halfway, wanted) : number == 1 ? kNearly * wanted : wanted;
    const std::size_t before = whole.triangles.size();
    if (double(before) <= enough) continue;
    turn(whole, number, std::uint64_t(enough), own, counts);
    if (number + 1 >= kSets && double(before - whole.triangles.size()) < kJam * double(before)) return;
  }
}

}  // namespace bp
