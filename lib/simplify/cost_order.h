#pragma once
#include <algorithm>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

/// Collapses in the order of what they cost, on one mesh or on parts of it side by side.
namespace bp {

class CostOrder {
 public:
  virtual ~CostOrder() = default;
  [[nodiscard]] virtual std::uint64_t face_count() const = 0;
  /// Appends the costs, or lower bounds of them, of what waits.
  virtual void add_costs(std::vector<double>& costs) const = 0;
  /// Takes what costs least until `enough` faces are left; false if before that nothing is left for `most` or less.
  virtual bool run(double most, std::uint64_t enough) = 0;
};

/// Takes what costs least in all parts together, until `excess` faces fewer are left or nothing can be taken; in
/// parallel. Costs rise by steps: within one, parts take turns at shares of the excess by their faces. The result does
/// not depend on the number of threads.
void take_cheapest(std::span<CostOrder* const> parts, std::uint64_t excess);

/// What each of some parts of a surface is to lose, for all to lose `excess` faces: by its faces, in whole collapses.
template <class Part>
[[nodiscard]] std::vector<std::uint64_t> shares_by_faces(std::uint64_t excess, std::span<Part* const> parts) {
  std::uint64_t all = 0, faces = 0, given = 0;
  for (const Part* part : parts) all += part->face_count();
  const std::uint64_t pairs = (excess + 1) / 2;
  std::vector<std::uint64_t> shares;
  for (const Part* part : parts) {
    faces += part->face_count();
    const std::uint64_t until_here = pairs * faces / std::max<std::uint64_t>(all, 1);  // both are below 2^32
    shares.push_back(2 * (until_here - given));
    given = until_here;
  }
  return shares;
}

/// An edge that waits for its turn, by its half-edge; `serial` tells its valid entry from those out of date.
struct CostEntry {
  double cost;
  std::uint32_t edge;
  std::uint32_t serial;
  bool operator<(const CostEntry& o) const { return cost != o.cost ? cost > o.cost : edge > o.edge; }  // least first
};
class CostQueue : public std::priority_queue<CostEntry> {
 public:
  [[nodiscard]] const std::vector<CostEntry>& entries() const { return c; }  ///< in no order
};

}  // namespace bp
