#pragma once
#include <algorithm>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

/// Takes collapses in the order of their costs, on one mesh or on parts of it side by side.
namespace bp {

class CostOrder {
 public:
  virtual ~CostOrder() = default;
  [[nodiscard]] virtual std::uint64_t face_count() const = 0;
  /// Appends the costs of waiting collapses, or lower bounds of these.
  virtual void add_costs(std::vector<double>& costs) const = 0;
  /// Takes the cheapest collapses until `enough` faces are left. Returns false if the collapses for `most` or less run
  /// out before.
  virtual bool run(double most, std::uint64_t enough) = 0;
};

/// Takes the cheapest collapses of all parts together, until `excess` faces are gone or nothing can be taken; in
/// parallel. Costs rise by steps: within a step, each part may take a share of the excess in proportion to its faces.
/// The result does not depend on the number of threads.
void take_cheapest(std::span<CostOrder* const> parts, std::uint64_t excess);

/// Returns how many faces each part of a surface must lose for all to lose `excess` faces: in proportion to its faces,
/// in whole collapses.
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

/// An edge that waits for its turn, by its half-edge. `serial` tells the valid entry of an edge from outdated ones.
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
