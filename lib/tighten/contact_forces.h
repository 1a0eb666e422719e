#pragma once
#include <span>
#include <vector>

#include "lib/mesh/half_edge_mesh.h"

/// Forces with which contact points press on faces: what a joint program ends with, the next one begins with. Between
/// the two little changes, so a few rounds of it do.
namespace bp {

class ContactForces {
 public:
  struct Force {
    FaceId face;
    std::uint32_t point;
    float size;
  };
  [[nodiscard]] bool empty() const { return forces_.empty(); }
  /// 0 if there is none. Linear in those of the face.
  [[nodiscard]] float of(FaceId face, std::uint32_t point) const;
  /// In place of those there. `faces`: above all numbers of faces. Linear.
  void set(std::span<const Force> forces, std::size_t faces);

 private:
  std::vector<Force> forces_;         // by faces
  std::vector<std::uint32_t> first_;  // per face: in forces_; and the end
};

}  // namespace bp
