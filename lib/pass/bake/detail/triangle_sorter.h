#pragma once
#include <functional>
#include <span>
#include <vector>

#include "lib/pass/bake/textured_triangle.h"
#include "lib/store/scratch.h"

namespace bp {

/// Puts triangles that lie near each other together, out of core: runs are sorted in memory and wait in the store; then
/// all are merged.
class TriangleSorter {
 public:
  /// `bounds`: of all of them. `memory_bytes`: for a run.
  TriangleSorter(const Bounds3d& bounds, Scratch& store, std::uint64_t memory_bytes);

  void add(const TexturedTriangle& triangle);
  /// After the last: all, neighbours together, at most `most` at once, and none that is far larger than another. The
  /// same groups for any memory.
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
