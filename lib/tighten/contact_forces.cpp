#include "lib/tighten/contact_forces.h"

namespace bp {

float ContactForces::of(FaceId face, std::uint32_t point) const {
  if (forces_.empty()) return 0;
  for (std::uint32_t i = first_[face]; i < first_[face + 1]; ++i) {
    if (forces_[i].point == point) return forces_[i].size;
  }
  return 0;
}

void ContactForces::set(std::span<const Force> forces, std::size_t faces) {
  first_.assign(faces + 1, 0);
  for (const Force& f : forces) ++first_[f.face + 1];
  for (std::size_t f = 1; f <= faces; ++f) first_[f] += first_[f - 1];
  forces_.resize(forces.size());
  std::vector<std::uint32_t> next = first_;
  for (const Force& f : forces) forces_[next[f.face]++] = f;
}

}  // namespace bp
