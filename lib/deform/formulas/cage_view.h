#pragma once
#include "lib/deform/cage.h"

namespace bp::detail {

/// The numbers of a face for Green coordinates, in the unit of the cage.
struct GreenFace {
  Vec3d normal{};                   ///< of length 1; 0 if the face has no area: then all its coordinates are 0
  std::array<Vec3d, 3> out{};       ///< unit vectors in its plane, out of it across edge i
  std::array<double, 3> per{};      ///< one over the height of corner i
  std::array<double, 3> angle{};    ///< product of `out` of the other two edges
  double twice_area = 0, part = 0;  ///< part: 1 / 4 pi, or 0
};

/// A cage in the form that the formulas take, on the CPU or on a device.
struct CageView {
  const Vec3d* vertices = nullptr;
  const Cage::Edge* edges = nullptr;
  const Cage::Face* faces = nullptr;
  const GreenFace* green = nullptr;      ///< by face; null if the coordinates are of another kind
  const double* edge_lengths = nullptr;  ///< for Green coordinates
  std::uint32_t vertex_count = 0, edge_count = 0, face_count = 0;
  Vec3d origin{};
  double diagonal = 1;
  std::array<Vec3d, 3> spread{};

  [[nodiscard]] BP_HD std::uint32_t columns() const { return vertex_count + (green != nullptr ? face_count : 0); }
};

[[nodiscard]] inline CageView view_of(const Cage& cage) {
  return {cage.vertices.data(),
          cage.edges.data(),
          cage.faces.data(),
          nullptr,
          nullptr,
          std::uint32_t(cage.vertices.size()),
          std::uint32_t(cage.edges.size()),
          std::uint32_t(cage.faces.size()),
          cage.origin,
          cage.diagonal,
          cage.spread};
}

}  // namespace bp::detail
