#include "lib/tighten/face_blocks.h"

#include <algorithm>

namespace bp {

/// Makes the patches of each phase. The patches of a phase have their middles at vertices whose faces no earlier phase
/// has put into a block.
void FaceBlocks::build(const std::vector<VertexId>& vertices) {
  patches_.resize(mesh_.vertex_capacity());
  for (auto& of_phases : patches_) of_phases.fill(kNone);
  std::vector<VertexId> along = vertices;
  std::vector<char> is_left(mesh_.vertex_capacity());
  for (std::size_t phase = 0; phase < kPhases && !along.empty(); ++phase) {
    set_patches(phase, along, vertices);
    std::fill(is_left.begin(), is_left.end(), 0);
    for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
      if (!mesh_.alive(f) || of(f) + 1 < count()) continue;
      for (HalfEdgeId h = 3 * f; h < 3 * f + 3; ++h) is_left[mesh_.from(h)] = 1;
    }
    std::erase_if(along, [&](VertexId v) { return is_left[v] == 0; });
  }
}

/// Grows the patches of a phase at the same pace from vertices far apart. A vertex that they do not reach joins the
/// patch of the vertex before it in space.
void FaceBlocks::set_patches(std::size_t phase, const std::vector<VertexId>& along,
                             const std::vector<VertexId>& vertices) {
  std::vector<VertexId> from;
  for (std::size_t i = 0; i < kPerPhase; ++i) {
    const VertexId v = along[(2 * i + 1) * along.size() / (2 * kPerPhase)];
    if (patches_[v][phase] != kNone) continue;
    patches_[v][phase] = std::uint8_t(i);
    from.push_back(v);
  }
  grow(phase, from);
  std::uint8_t last = 0;
  for (const VertexId v : vertices) {
    if (patches_[v][phase] == kNone) {
      patches_[v][phase] = last;
      from.assign(1, v);
      grow(phase, from);
    }
    last = patches_[v][phase];
  }
}

void FaceBlocks::grow(std::size_t phase, std::vector<VertexId>& from) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::uint8_t patch = patches_[from[i]][phase];
    mesh_.for_each_outgoing(from[i], [&](HalfEdgeId h) {
      const VertexId w = mesh_.to(h);
      if (patches_[w][phase] != kNone) return;
      patches_[w][phase] = patch;
      from.push_back(w);
    });
  }
}

/// Returns the block of the first phase in which the face's corners have a patch in common.
std::size_t FaceBlocks::of(FaceId f) const {
  if (!built()) return 0;
  const auto& a = patches_[mesh_.from(3 * f)];
  const auto &b = patches_[mesh_.from(3 * f + 1)], &c = patches_[mesh_.from(3 * f + 2)];
  for (std::size_t phase = 0; phase < kPhases; ++phase) {
    if (a[phase] != kNone && a[phase] == b[phase] && a[phase] == c[phase]) return phase * kPerPhase + a[phase];
  }
  return kPhases * kPerPhase;
}

}  // namespace bp
