#pragma once
#include <array>
#include <vector>

#include "lib/core/parallel.h"
#include "lib/mesh/half_edge_mesh.h"

/// The faces of a mesh in blocks, for what changes something at their corners: those of a phase have no vertex in
/// common, so they can be taken at the same time.
namespace bp {

class FaceBlocks {
 public:
  /// Keeps a reference. One block, until build().
  explicit FaceBlocks(const HalfEdgeMesh& mesh) : mesh_(mesh) {}

  /// For the mesh as it is; when its edges flip, the blocks are those of the same patches of vertices, and as good for
  /// all but a few faces. `vertices`: the living ones, those near in space near each other. Linear.
  void build(const std::vector<VertexId>& vertices);
  [[nodiscard]] bool built() const { return !patches_.empty(); }

  [[nodiscard]] std::size_t count() const { return built() ? kPhases * kPerPhase + 1 : 1; }
  /// The last one is for faces that are in none of a phase: few.
  [[nodiscard]] std::size_t of(FaceId f) const;
  /// act(block) for all of them, phase after phase. Parallel.
  template <class Act>
  void for_each(const Act& act) const {
    for (std::size_t first = 0; first + 1 < count(); first += kPerPhase)
      parallel_for(std::int64_t(kPerPhase), [&](std::int64_t i) { act(first + std::size_t(i)); });
    act(count() - 1);
  }

 private:
  static constexpr std::size_t kPhases = 4, kPerPhase = 24;
  static constexpr std::uint8_t kNone = 255;

  void set_patches(std::size_t phase, const std::vector<VertexId>& along, const std::vector<VertexId>& vertices);
  void grow(std::size_t phase, std::vector<VertexId>& from);

  const HalfEdgeMesh& mesh_;
  std::vector<std::array<std::uint8_t, kPhases>> patches_;  // per vertex: the one that it is in, in each phase
};

}  // namespace bp
