#pragma once
#include <vector>

#include "lib/deform/detail/wide.h"
#include "lib/deform/formulas/green.h"
#include "lib/deform/formulas/mean_value.h"

namespace bp::detail {

/// Numbers of the formulas in the CPU's memory, aligned as Vec.
template <class Real, class T = Real>
class Shelf {
 public:
  void resize(std::size_t n) { slots_.resize(n); }
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] BP_INLINE const T& get(std::size_t i) const { return slots_[i].item; }
  BP_INLINE void put(std::size_t i, const T& item) { slots_[i].item = item; }
  [[nodiscard]] T& operator[](std::size_t i) { return slots_[i].item; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return slots_[i].item; }

 private:
  struct alignas(sizeof(Real)) Slot {
    T item;
  };
  std::vector<Slot> slots_;
};

template <class Real>
struct GreenScratch {
  Shelf<Real, GreenVertex<Real>> vertices;
  Shelf<Real, GreenEdge<Real>> edges;
  Shelf<Real> sums, face_weights;

  void resize(const Cage& cage) {
    vertices.resize(cage.vertices.size()), sums.resize(cage.vertices.size());
    edges.resize(cage.edges.size());
    face_weights.resize(cage.faces.size());
  }
};

/// Memory of the coordinates of kWide points, kept from call to call.
struct CoordinateScratch {
  Shelf<Wide, MeanVertex<Wide>> vertices;
  Shelf<Wide, MeanEdge<Wide>> edges;
  Shelf<Wide, MeanFace<Wide>> faces;
  Shelf<Wide> sums;
  GreenScratch<Wide> green;

  void resize(const Cage& cage, bool for_green) {
    if (for_green) return green.resize(cage);
    vertices.resize(cage.vertices.size()), sums.resize(cage.vertices.size());
    edges.resize(cage.edges.size());
  }
};

}  // namespace bp::detail
