#include "lib/hulls/detail/convex_merge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/parallel.h"
#include "lib/mesh/box_tree.h"

namespace bp {

namespace {

ConvexHull join(const ConvexHull& a, const ConvexHull& b) {
  std::vector<LatticeCoord> points = a.vertices;
  points.insert(points.end(), b.vertices.begin(), b.vertices.end());
  return *hull_of(points);
}

constexpr double kJoined = 2;      // times the volume that an uncut cell may have between hull and solid
constexpr double kBetween = 0.05;  // of two hulls: the volume that may lie between them if they need not be joined

/// Hulls, each with the partner that it would best be joined with.
class Merger {
 public:
  Merger(std::vector<Wrapped> hulls, double tolerance6) : tolerance6_(tolerance6), alive_(hulls.size(), 1) {
    std::vector<std::uint32_t> all;
    for (Wrapped& wrapped : hulls) {
      all.push_back(std::uint32_t(all.size()));
      volumes_.push_back(volume6_of(wrapped.hull));
      solids_.push_back(wrapped.solid6);
      numbers_.push_back(wrapped.solid);
      given_.push_back(char(wrapped.given));
      boxes_.push_back(box_of(wrapped.hull.vertices));
      hulls_.push_back(std::move(wrapped.hull));
    }
    best_.resize(hulls_.size());
    find(all);
  }

  std::vector<Wrapped> run(std::size_t count) {
    std::size_t left = hulls_.size();
    for (; left > count && join_cheapest(); --left) {
    }
    across_ = false;
    find(living());
    for (; left > 1 && join_cheapest(); --left) {
    }
    std::vector<Wrapped> kept;
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
      if (alive_[i]) kept.push_back({std::move(hulls_[i]), solids_[i], numbers_[i], given_[i] != 0});
    }
    return kept;
  }

 private:
  static constexpr std::size_t kNear = 16;  // hulls tried as partners of one
  struct Partner {
    std::uint32_t with = 0;
    double cost = std::numeric_limits<double>::infinity();
  };

  [[nodiscard]] std::vector<std::uint32_t> living() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < hulls_.size(); ++i) {
      if (alive_[i]) all.push_back(i);
    }
    return all;
  }

  /// Joins the cheapest pair: across solids at any cost, within them if joined hulls are as good as separate ones.
  /// Returns false if there is none.
  bool join_cheapest() {
    std::optional<std::uint32_t> least;
    for (const std::uint32_t i : living()) {
      if (std::isfinite(best_[i].cost) && (!least || best_[i].cost < best_[*least].cost) &&
          (across_ || as_good_joined(i)))
        least = i;
    }
    if (least) unite(std::min(*least, best_[*least].with), std::max(*least, best_[*least].with));
    return least.has_value();
  }

  [[nodiscard]] bool as_good_joined(std::uint32_t i) const {
    const Partner& partner = best_[i];
    const double apart6 = volumes_[i] + volumes_[partner.with], solid6 = solids_[i] + solids_[partner.with];
    const double excess6 = apart6 + partner.cost - solid6;
    return partner.cost <= kBetween * apart6 && excess6 <= kJoined * std::max(tolerance6_, kNearlyConvex * solid6);
  }

  [[nodiscard]] double box_growth(std::uint32_t i, std::uint32_t j) const {
    double volume = 1;
    for (int k = 0; k < 3; ++k)
      volume *= double(std::max(boxes_[i].max[k], boxes_[j].max[k]) - std::min(boxes_[i].min[k], boxes_[j].min[k]));
    return 6 * volume - volumes_[i] - volumes_[j];
  }

  /// Returns the best partner among the kNear hulls with which i has the least box.
  [[nodiscard]] Partner partner_of(std::uint32_t i) const {
    std::vector<std::pair<double, std::uint32_t>> near;
    for (std::uint32_t j = 0; j < hulls_.size(); ++j) {
      if (alive_[j] && j != i && (across_ || numbers_[j] == numbers_[i])) near.emplace_back(box_growth(i, j), j);
    }
    const std::size_t n = std::min(kNear, near.size());
    std::partial_sort(near.begin(), near.begin() + std::ptrdiff_t(n), near.end());
    Partner best;
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t j = near[k].second;
      const double cost = volume6_of(join(hulls_[i], hulls_[j])) - volumes_[i] - volumes_[j];
      if (cost < best.cost) best = {j, cost};
    }
    return best;
  }

  void find(const std::vector<std::uint32_t>& of) {
    parallel_for(std::int64_t(of.size()),
                 [&](std::int64_t k) { best_[of[std::size_t(k)]] = partner_of(of[std::size_t(k)]); });
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    hulls_[a] = join(hulls_[a], hulls_[b]);
    volumes_[a] = volume6_of(hulls_[a]);
    solids_[a] += solids_[b];
    const std::uint32_t gone = numbers_[b];  // two solids that are joined become one
    std::replace(numbers_.begin(), numbers_.end(), gone, numbers_[a]);
    boxes_[a] = box_of(hulls_[a].vertices);
    alive_[b] = given_[a] = 0;
    std::vector<std::uint32_t> stale{a};
    for (std::uint32_t i = 0; i < hulls_.size(); ++i) {
      if (alive_[i] && i != a && (best_[i].with == a || best_[i].with == b)) stale.push_back(i);
    }
    find(stale);
    if (!std::isfinite(best_[a].cost)) return;
    Partner& best = best_[best_[a].with];  // nobody else has compared with the new hull
    if (best_[a].cost < best.cost) best = {a, best_[a].cost};
  }

  double tolerance6_;
  bool across_ = true;  // whether hulls of different solids may be joined
  std::vector<ConvexHull> hulls_;
  std::vector<char> alive_, given_;
  std::vector<double> volumes_, solids_;  // six times the volume of the hull, and of the solid in it
  std::vector<std::uint32_t> numbers_;    // numbers of the solids
  std::vector<LatticeBox> boxes_;
  std::vector<Partner> best_;
};

}  // namespace

std::vector<Wrapped> merge_hulls(std::vector<Wrapped> hulls, std::size_t count, double tolerance6) {
  return Merger(std::move(hulls), tolerance6).run(count);
}

}  // namespace bp
