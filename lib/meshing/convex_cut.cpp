#include "lib/meshing/convex_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr int kPlaces = 12;       // tried along each axis at first
constexpr double kOpen = 0.05;    // what a hull counts more that must be cut again, and halves of different size
constexpr double kConvex = 0.02;  // above its volume, a hull is as good as the solid

double hull_volume6(const SolidCell& solid) {
  const std::optional<ConvexHull> hull = hull_of(solid.points(SolidCell::Rounding::nearest));
  return hull ? volume6_of(*hull) : 0;
}

struct Cut {
  int axis = 0;
  std::int64_t at = 0;
  double cost = std::numeric_limits<double>::infinity();
};

SolidCell half(const SolidCell& solid, const Cut& cut, bool upper) {
  LatticeBox cell = solid.cell();
  (upper ? cell.min : cell.max)[cut.axis] = cut.at + (upper ? 1 : 0);
  return solid.within(cell);
}

bool nearly_convex(double hull6, double volume6) {
  return hull6 <= (1 + kConvex) * volume6;
}

struct Piece {
  SolidCell solid;
  bool empty = true;  // it has nothing of the solid
  LatticeBox box;     // of its points
  double hull6 = 0, volume6 = 0;
  double excess6 = 0;  // of the hull; 0: as good as convex

  explicit Piece(SolidCell s) : solid(std::move(s)) {
    const std::vector<LatticeCoord> points = solid.points(SolidCell::Rounding::nearest);
    if (points.empty()) return;
    empty = false;
    box = box_of(points);
    const std::optional<ConvexHull> hull = hull_of(points);
    hull6 = hull ? volume6_of(*hull) : 0;
    volume6 = solid.volume6();
    excess6 = nearly_convex(hull6, volume6) ? 0 : hull6 - volume6;
  }
};

/// One place in each of kPlaces windows: where the section changes most, or the middle.
std::vector<Cut> first_cuts(const Piece& piece) {
  std::vector<Cut> cuts;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t low = piece.box.min[axis], length = piece.box.max[axis] - low;
    if (length < 2) continue;
    std::vector<SolidCell::Step> best(kPlaces);
    for (int i = 0; i < kPlaces; ++i) best[std::size_t(i)] = {low + (2 * i + 1) * length / (2 * kPlaces), 0};
    for (const SolidCell::Step& step : piece.solid.steps(axis)) {
      if (step.at < low || step.at >= low + length) continue;
      SolidCell::Step& b = best[std::size_t((step.at - low) * kPlaces / length)];
      if (step.weight > b.weight) b = step;
    }
    for (const SolidCell::Step& step : best) {
      if (step.at > low && step.at < low + length - 1) cuts.push_back({axis, step.at});
    }
  }
  return cuts;
}

/// Sets their costs: the volume of the hulls, and a share of those that need further cuts, or halves would be gone
/// from place to place where a cut alone gains nothing: a hollow box is peeled side by side.
void weigh(const Piece& piece, std::vector<Cut>& cuts) {
  std::vector<std::array<double, 2>> hulls6(cuts.size());
  parallel_for(std::int64_t(2 * cuts.size()), [&](std::int64_t i) {
    const std::size_t k = std::size_t(i / 2), upper = std::size_t(i % 2);
    hulls6[k][upper] = hull_volume6(half(piece.solid, cuts[k], upper != 0));
  });
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [low, high] : hulls6) least = std::min(least, low + high);
  parallel_for(std::int64_t(cuts.size()), [&](std::int64_t i) {
    const auto [low, high] = hulls6[std::size_t(i)];
    if (low + high > least + 2 * kOpen * piece.hull6) return;  // whatever its halves are
    Cut& cut = cuts[std::size_t(i)];
    const double volume6 = half(piece.solid, cut, false).volume6();
    const bool low_done = nearly_convex(low, volume6), high_done = nearly_convex(high, piece.volume6 - volume6);
    cut.cost = low + high + kOpen * ((low_done ? 0 : low) + (high_done ? 0 : high));
    if (!low_done && !high_done) cut.cost += kOpen * std::abs(low - high);
  });
}

const Cut& cheapest(const std::vector<Cut>& cuts) {
  return *std::min_element(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.cost < b.cost; });
}

/// Nothing if the piece is too thin to be cut.
std::optional<Cut> best_cut(const Piece& piece) {
  std::vector<Cut> cuts = first_cuts(piece);
  if (cuts.empty()) return {};
  weigh(piece, cuts);
  Cut best = cheapest(cuts);
  const std::int64_t low = piece.box.min[best.axis], high = piece.box.max[best.axis];
  for (std::int64_t reach = (high - low) / (2 * kPlaces), k = 0; reach > 0 && k < 3; reach /= 3, ++k) {
    std::vector<Cut> near;
    for (const std::int64_t at : {best.at - reach, best.at + reach}) {
      if (at > low && at < high - 1) near.push_back({best.axis, at});
    }
    if (near.empty()) break;
    weigh(piece, near);
    if (cheapest(near).cost < best.cost) best = cheapest(near);
  }
  return best;
}

}  // namespace

std::vector<SolidCell> cut_to_convex(std::vector<SolidCell> solids, std::size_t count, double tolerance6) {
  std::vector<Piece> pieces;
  for (SolidCell& solid : solids) pieces.emplace_back(std::move(solid));
  while (pieces.size() < count) {
    const auto worst = std::max_element(pieces.begin(), pieces.end(),
                                        [](const Piece& a, const Piece& b) { return a.excess6 < b.excess6; });
    if (worst == pieces.end() || worst->excess6 <= tolerance6) break;
    const std::optional<Cut> cut = best_cut(*worst);
    if (!cut) {
      worst->excess6 = 0;
      continue;
    }
    Piece low(half(worst->solid, *cut, false)), high(half(worst->solid, *cut, true));
    *worst = std::move(low);
    pieces.push_back(std::move(high));
    std::erase_if(pieces, [](const Piece& piece) { return piece.empty; });
  }
  std::vector<SolidCell> cells;
  for (Piece& piece : pieces) cells.push_back(std::move(piece.solid));
  return cells;
}

namespace {

ConvexHull join(const ConvexHull& a, const ConvexHull& b) {
  std::vector<LatticeCoord> points = a.vertices;
  points.insert(points.end(), b.vertices.begin(), b.vertices.end());
  return *hull_of(points);
}

constexpr double kJoined = 2;     // times what a cell may have between hull and solid that is not cut
constexpr double kBridge = 0.05;  // of two hulls, what may lie between them if they need not be joined

/// Hulls, and for each the partner that it would best be joined with.
class Merger {
 public:
  Merger(std::vector<Wrapped> hulls, double tolerance6) : tolerance6_(tolerance6), alive_(hulls.size(), 1) {
    std::vector<std::uint32_t> all;
    for (Wrapped& wrapped : hulls) {
      all.push_back(std::uint32_t(all.size()));
      volumes_.push_back(volume6_of(wrapped.hull));
      solids_.push_back(wrapped.solid6);
      boxes_.push_back(box_of(wrapped.hull.vertices));
      hulls_.push_back(std::move(wrapped.hull));
    }
    best_.resize(hulls_.size());
    find(all);
  }

  std::vector<ConvexHull> run(std::size_t count) {
    for (std::size_t left = hulls_.size(); left > 1; --left) {
      const std::optional<std::uint32_t> a = cheapest(left > count);
      if (!a) break;
      unite(std::min(*a, best_[*a].with), std::max(*a, best_[*a].with));
    }
    std::vector<ConvexHull> kept;
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
      if (alive_[i]) kept.push_back(std::move(hulls_[i]));
    }
    return kept;
  }

 private:
  static constexpr std::size_t kNear = 16;  // hulls tried as partners of one
  struct Partner {
    std::uint32_t with = 0;
    double cost = std::numeric_limits<double>::infinity();
  };

  /// What is joined next: whatever costs least if it must be, else what is as good joined as apart.
  [[nodiscard]] std::optional<std::uint32_t> cheapest(bool must) const {
    std::optional<std::uint32_t> least;
    for (std::uint32_t i = 0; i < hulls_.size(); ++i) {
      if (alive_[i] && (!least || best_[i].cost < best_[*least].cost) && (must || as_good_joined(i))) least = i;
    }
    return least;
  }

  [[nodiscard]] bool as_good_joined(std::uint32_t i) const {
    const Partner& partner = best_[i];
    const double apart6 = volumes_[i] + volumes_[partner.with], solid6 = solids_[i] + solids_[partner.with];
    const double excess6 = apart6 + partner.cost - solid6;
    return partner.cost <= kBridge * apart6 && excess6 <= kJoined * std::max(tolerance6_, kConvex * solid6);
  }

  [[nodiscard]] double box_growth(std::uint32_t i, std::uint32_t j) const {
    double volume = 1;
    for (int k = 0; k < 3; ++k)
      volume *= double(std::max(boxes_[i].max[k], boxes_[j].max[k]) - std::min(boxes_[i].min[k], boxes_[j].min[k]));
    return 6 * volume - volumes_[i] - volumes_[j];
  }

  /// Of the kNear hulls with which i has the least box.
  [[nodiscard]] Partner partner_of(std::uint32_t i) const {
    std::vector<std::pair<double, std::uint32_t>> near;
    for (std::uint32_t j = 0; j < hulls_.size(); ++j) {
      if (alive_[j] && j != i) near.emplace_back(box_growth(i, j), j);
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
    boxes_[a] = box_of(hulls_[a].vertices);
    alive_[b] = 0;
    std::vector<std::uint32_t> stale{a};
    for (std::uint32_t i = 0; i < hulls_.size(); ++i) {
      if (alive_[i] && i != a && (best_[i].with == a || best_[i].with == b)) stale.push_back(i);
    }
    find(stale);
    Partner& best = best_[best_[a].with];  // nobody else looked at what is new
    if (best_[a].cost < best.cost) best = {a, best_[a].cost};
  }

  double tolerance6_;
  std::vector<ConvexHull> hulls_;
  std::vector<char> alive_;
  std::vector<double> volumes_, solids_;  // times six: of the hull, of the solid in it
  std::vector<LatticeBox> boxes_;
  std::vector<Partner> best_;
};

}  // namespace

std::vector<ConvexHull> merge_hulls(std::vector<Wrapped> hulls, std::size_t count, double tolerance6) {
  return Merger(std::move(hulls), tolerance6).run(count);
}

}  // namespace bp
