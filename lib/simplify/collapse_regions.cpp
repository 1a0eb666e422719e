#include "lib/simplify/collapse_regions.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/core/parallel.h"
#include "lib/simplify/detail/bulk_order.h"
#include "lib/simplify/detail/collapse_order.h"
#include "lib/simplify/regions.h"

namespace bp {

namespace {

// Faces along the cells' sides have their turn before the wanted number of faces is reached: turns end halfway, at
// nearly all of the way, and at its end.
constexpr double kNearly = 1.1;  // times the wanted faces
constexpr int kTurns = 5;        // at most
constexpr int kSets = 3;  // sets of cells with different sides: after so many turns nearly all vertices have been free
constexpr double kJam = 1e-3;  // share of the faces: a turn that takes less is the last
// A surface with fewer than this many times the faces of a region is not cut. Regions with few faces consist mostly of
// sides, which stay fine while their middles are collapsed to spikes.
constexpr std::uint64_t kLeast = 2;
// The bulk has some regions for every thread, each with at most kBulkMost times the faces of a region of the strict
// order; a turn leaves at least 1 / kBulkLeft of a strict region's faces in each. Faces along sides stay fine until
// their turn, so large surfaces have three turns.
constexpr std::uint64_t kBulkRegions = 32, kBulkMost = 32, kBulkLeft = 4;
constexpr int kBulkTurns = 2, kBulkTurnsOfMany = 3;
constexpr std::uint64_t kMany = 128;  // times the faces of a region of the strict order

void count_left(const StrictOrder& order, SimplifyCounts& counts) {
  order.count(counts);
}
void count_left(const BulkOrder&, SimplifyCounts&) {}

/// A region at work, with its order.
template <class Order>
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
    count_left(order, counts);
  }

  const Region& region;
  SimplifyParams params;
  SimplifyCounts counts;
  HalfEdgeMesh mesh;
  Collapser collapser;
  Order order;
};

/// The quadrics of a whole surface, given to regions and taken back, so that none is held twice.
class QuadricsApart {
 public:
  /// Takes the quadrics from the whole.
  QuadricsApart(Piece& whole, std::span<const Region> regions) : of_region_(regions.size()) {
    std::vector<char> free(whole.vertices.size(), 0);  // each vertex is free in one region at most
    parallel_for(std::int64_t(regions.size()), [&](std::int64_t k) {
      const Region& region = regions[std::size_t(k)];
      for (std::size_t i = 0; i < region.free.size(); ++i) {
        if (!region.free[i]) continue;
        free[region.vertices[i]] = 1;
        of_region_[std::size_t(k)].emplace_back(VertexId(i), whole.quadrics[region.vertices[i]]);
      }
    });
    for (VertexId v = 0; v < free.size(); ++v) {
      if (!free[v]) fixed_.emplace_back(v, whole.quadrics[v]);
    }
    std::vector<Quadric>().swap(whole.quadrics);
  }
  /// Returns the quadrics per vertex of the region; those of vertices that are not free are zero.
  [[nodiscard]] std::vector<Quadric> give(std::size_t number, const Region& region) {
    std::vector<Quadric> quadrics(region.vertices.size());
    for (const auto& [v, q] : of_region_[number]) quadrics[v] = q;
    List().swap(of_region_[number]);
    return quadrics;
  }
  template <class Order>
  void take(std::size_t number, const Part<Order>& part) {
    for (VertexId v = 0; v < part.region.free.size(); ++v) {
      if (part.region.free[v] && part.mesh.vertex_alive(v))
        of_region_[number].emplace_back(part.region.vertices[v], part.collapser.quadric(v));
    }
  }
  void put_back(Piece& whole) const {
    whole.quadrics.resize(whole.vertices.size());
    for (const auto& [v, q] : fixed_) whole.quadrics[v] = q;
    parallel_for(std::int64_t(of_region_.size()), [&](std::int64_t k) {
      for (const auto& [v, q] : of_region_[std::size_t(k)]) whole.quadrics[v] = q;
    });
  }

 private:
  using List = std::vector<std::pair<VertexId, Quadric>>;
  List fixed_;
  std::vector<List> of_region_;
};

/// Does one turn: cuts the surface into regions of `per_region` faces, makes an order for each, calls work(orders) on
/// all of them, and puts the regions back.
template <class Order, class Work>
void turn(Piece& whole, std::uint64_t per_region, int number, const SimplifyParams& params, SimplifyCounts& counts,
          const Work& work) {
  const std::vector<Region> regions = regions_of(whole, per_region, number);
  QuadricsApart quadrics(whole, regions);
  std::vector<std::unique_ptr<Part<Order>>> parts(regions.size());
  parallel_for(std::int64_t(regions.size()), [&](std::int64_t k) {
    const auto i = std::size_t(k);
    SimplifyParams own = params;
    own.whole.faces_elsewhere = whole.triangles.size() - regions[i].faces.size();
    parts[i] = std::make_unique<Part<Order>>(whole, regions[i], quadrics.give(i, regions[i]), own);
  });
  std::vector<Order*> orders;
  for (const auto& part : parts) orders.push_back(&part->order);
  work(orders);
  std::vector<SimplifyCounts> told(parts.size());
  parallel_for(std::int64_t(parts.size()), [&](std::int64_t k) {
    const auto i = std::size_t(k);
    parts[i]->put_back(whole);
    quadrics.take(i, *parts[i]);
    told[i] = parts[i]->counts;
    parts[i].reset();
  });
  counts.refused = {};  // these were counts of the turn before
  for (const SimplifyCounts& some : told) counts.add_beside(some);
  quadrics.put_back(whole);
  drop_removed(whole);
}

SimplifyParams params_of_regions(Piece& whole, const SimplifyParams& params) {
  SimplifyParams own = params;
  own.whole.volume6 = std::abs(double(volume6_of(whole.vertices, whole.triangles)));
  if (whole.quadrics.empty()) whole.quadrics = quadrics_of(whole);
  return own;
}

/// Returns the faces per region for the bulk of a surface that has `faces` now.
std::uint64_t bulk_per_region(std::uint64_t faces, const BulkEnd& end, std::uint64_t per_region) {
  const double left = double(per_region) / kBulkLeft, share = double(end.faces) / double(faces);
  const auto least = std::max(per_region, std::uint64_t(left / share));
  return std::max(least, std::min(faces / kBulkRegions, kBulkMost * per_region));
}

}  // namespace

bool has_bulk_regions(std::uint64_t faces, const BulkEnd& end, const SimplifyParams& params) {
  return params.faces > 0 && faces > end.faces && has_regions(faces / 2, params) &&
         has_regions(kBulkLeft * end.faces, params);
}

void collapse_bulk_in_regions(Piece& whole, const BulkEnd& end, const SimplifyParams& params, SimplifyCounts& counts) {
  const SimplifyParams own = params_of_regions(whole, params);
  const double from = double(whole.triangles.size()), share = double(end.faces) / from;
  const int turns = whole.triangles.size() > kMany * params.faces_per_region ? kBulkTurnsOfMany : kBulkTurns;
  for (int number = 1; number <= turns; ++number) {
    const auto wanted = std::uint64_t(from * std::pow(share, double(number) / turns));
    if (whole.triangles.size() <= wanted) continue;
    const std::uint64_t excess = whole.triangles.size() - wanted;
    turn<BulkOrder>(whole, bulk_per_region(whole.triangles.size(), end, params.faces_per_region), number, own, counts,
                    [&](std::span<BulkOrder* const> orders) {
                      std::uint64_t faces = 0;  // sum over regions; several regions know the faces along sides
                      for (const BulkOrder* order : orders) faces += order->face_count();
                      collapse_bulk(orders, {kFirstBound, end.cost}, faces - std::min(faces, excess));
                    });
  }
}

bool has_regions(std::uint64_t faces, const SimplifyParams& params) {
  constexpr std::uint64_t kFew = 4;
  return faces > kFew * params.faces_per_region && params.limits == nullptr;
}

void collapse_in_regions(Piece& whole, const SimplifyParams& params, SimplifyCounts& counts) {
  const SimplifyParams own = params_of_regions(whole, params);
  const std::uint64_t least = std::max(params.faces, kLeast * params.faces_per_region);
  const auto wanted = double(least);
  const double halfway = std::sqrt(double(whole.triangles.size()) * wanted);
  for (int number = 0; number < kTurns && whole.triangles.size() > least; ++number) {
    const double enough = number == 0 ? std::max(halfway, wanted) : number == 1 ? kNearly * wanted : wanted;
    const std::size_t before = whole.triangles.size();
    if (double(before) <= enough) continue;
    turn<StrictOrder>(whole, params.faces_per_region, number, own, counts, [&](std::span<StrictOrder* const> orders) {
      take_cheapest(std::vector<CostOrder*>(orders.begin(), orders.end()), before - std::uint64_t(enough));
    });
    if (number + 1 >= kSets && double(before - whole.triangles.size()) < kJam * double(before)) return;
  }
}

}  // namespace bp
