#pragma once
#include <array>
#include <vector>

#include "lib/core/parallel.h"
#include "lib/mesh/half_edge_mesh.h"

/// Sorts the faces of a mesh into blocks, for work that changes data at their corners. Faces in different blocks of one
/// phase have no common vertex, so these blocks are worked on at the same time.
namespace bp {

class FaceBlocks {
 public:
  /// Keeps a reference. Until build() there is one block.
  explicit FaceBlocks(const HalfEdgeMesh& mesh) : mesh_(mesh) {}

  /// Makes the blocks for the present mesh. Blocks belong to patches of vertices: they stay valid when edges flip, and
  /// then only few more faces fall into the last block. `vertices`: the living vertices, with neighbours in space near
  /// each other. Linear.
  void build(const std::vector<VertexId>& vertices);
  [[nodiscard]] bool built() const { return !patches_.empty(); }

  [[nodiscard]] std::size_t count() const { return built() ? kPhases * kPerPhase + 1 : 1; }
  /// Returns the block of a face. The last block holds the few faces that no phase can take.
  [[nodiscard]] std::size_t of(FaceId f) const;
  /// Calls act(block) for all blocks, phase after phase, and those of a phase in parallel.
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
  std::vector<std::array<std::uint8_t, kPhases>> patches_;  // for each vertex, its patch in each phase
};

}  // namespace bp
