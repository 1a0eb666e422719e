#pragma once
#include <functional>
#include <span>
#include <vector>

#include "lib/pass/bake/textured_triangle.h"
#include "lib/store/scratch.h"

namespace bp {

/// Puts neighbouring triangles together, out of core: runs are sorted in memory and wait in the store; then all are
/// merged.
class TriangleSorter {
 public:
  /// `bounds` of all triangles. `memory_bytes`: for a run.
  TriangleSorter(const Bounds3d& bounds, Scratch& store, std::uint64_t memory_bytes);

  void add(const TexturedTriangle& triangle);
  /// Ends the input. Calls body() for groups of neighbours, at most `most` triangles each, none of which is far larger
  /// than another. The groups do not depend on the memory.
  void finish(std::size_t most, const std::function<void(std::span<const TexturedTriangle>)>& body);

 private:
  struct Keyed {
    std::uint64_t key;
    TexturedTriangle triangle;
  };
  class Run;
  class Groups;
  [[nodiscard]] std::uint64_t key_of(const TriangleD& t) const;
  [[nodiscard]] std::vector<std::uint32_t> order() const;
  void put_run();

  const Bounds3d bounds_;
  const double side_;
  Scratch& store_;
  const std::size_t most_waiting_;
  std::vector<Keyed> waiting_;
  std::vector<std::vector<Scratch::Handle>> runs_;
};

}  // namespace bp
