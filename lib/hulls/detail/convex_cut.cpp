#include "lib/hulls/detail/convex_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/parallel.h"
#include "lib/hulls/convex_hull.h"

namespace bp {

namespace {

constexpr int kPlaces = 12;     // places that are tried along each axis at first
constexpr double kOpen = 0.05;  // extra cost of a hull that must be cut again, and of halves of different size
constexpr double kGains =
    0.25;  // of the volume between hull and solid: a cut that takes less away is judged by two cuts

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
  return hull6 <= (1 + kNearlyConvex) * volume6;
}

struct Piece {
  SolidCell solid;
  bool empty = true;  // it has no part of the solid
  LatticeBox box;     // box of its points
  double hull6 = 0, volume6 = 0;
  double excess6 = 0;  // of the hull; 0: it is as good as convex

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

/// Returns one place in each of kPlaces windows: where the section changes most, or the middle.
std::vector<Cut> first_cuts(const Piece& piece) {
  std::vector<Cut> cuts;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t low = piece.box.min[axis], length = piece.box.max[axis] - low;
    if (length < 2) continue;
    std::vector<SolidCell::Step> best(kPlaces);
    for (std::int64_t i = 0; i < kPlaces; ++i) best[std::size_t(i)] = {low + (2 * i + 1) * length / (2 * kPlaces), 0};
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

/// Sets their costs: the volume of the hulls, and a share of the volume of hulls that must be cut again. So a hollow
/// box, of which no single cut takes anything away, is peeled side by side; else it would be halved for ever.
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
    if (low + high > least + 2 * kOpen * piece.hull6) return;  // its halves cannot change that
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

/// Returns the least volume of the hulls of a half, as it is or cut once more in the middle.
double cut_again_volume6(const Piece& half_piece) {
  double least = half_piece.hull6;
  if (half_piece.excess6 == 0) return least;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t low = half_piece.box.min[axis], high = half_piece.box.max[axis];
    if (high - low < 4) continue;
    const Cut middle{axis, low + (high - low) / 2, 0};
    least = std::min(least, hull_volume6(half(half_piece.solid, middle, false)) +
                                hull_volume6(half(half_piece.solid, middle, true)));
  }
  return least;
}

/// Returns, for each axis, the cheapest cut and the one nearest to the middle.
std::vector<Cut> cuts_to_compare(const Piece& piece, const std::vector<Cut>& cuts) {
  std::vector<Cut> few;
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = 0.5 * double(piece.box.min[axis] + piece.box.max[axis]);
    const Cut* least = nullptr;
    const Cut* nearest = nullptr;
    for (const Cut& cut : cuts) {
      if (cut.axis != axis) continue;
      if (least == nullptr || cut.cost < least->cost) least = &cut;
      if (nearest == nullptr || std::abs(double(cut.at) - middle) < std::abs(double(nearest->at) - middle))
        nearest = &cut;
    }
    if (least != nullptr) few.push_back(*least);
    if (nearest != least) few.push_back(*nearest);
  }
  return few;
}

/// Sets the costs of a few cuts by the volume after one more cut of each half. The hull of a ring is a disc, and so are
/// those of its halves and slices. Only its quarters show which of them was the better step.
void weigh_ahead(const Piece& piece, std::vector<Cut>& cuts) {
  std::vector<std::array<double, 2>> costs(cuts.size()), hulls6(cuts.size());
  parallel_for(std::int64_t(2 * cuts.size()), [&](std::int64_t i) {
    const std::size_t k = std::size_t(i / 2), upper = std::size_t(i % 2);
    const Piece part(half(piece.solid, cuts[k], upper != 0));
    hulls6[k][upper] = part.excess6 > 0 ? part.hull6 : 0;
    costs[k][upper] = cut_again_volume6(part) + kOpen * hulls6[k][upper];
  });
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const auto [low, high] = hulls6[k];
    cuts[k].cost = costs[k][0] + costs[k][1] + (low > 0 && high > 0 ? kOpen * std::abs(low - high) : 0);
  }
}

/// Returns nothing if the piece is too thin to be cut.
std::optional<Cut> best_cut(const Piece& piece) {
  std::vector<Cut> cuts = first_cuts(piece);
  if (cuts.empty()) return {};
  weigh(piece, cuts);
  Cut best = cheapest(cuts);
  if (piece.hull6 - best.cost < kGains * piece.excess6) {
    std::vector<Cut> few = cuts_to_compare(piece, cuts);
    weigh_ahead(piece, few);
    const Cut ahead = cheapest(few);
    if (ahead.axis != best.axis || ahead.at != best.at) return ahead;
  }
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
  pieces.reserve(std::max(count, solids.size()) + 1);
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
  cells.reserve(pieces.size());
  for (Piece& piece : pieces) cells.push_back(std::move(piece.solid));
  return cells;
}

}  // namespace bp
