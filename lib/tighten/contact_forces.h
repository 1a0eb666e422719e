#pragma once
#include <span>
#include <vector>

#include "lib/mesh/half_edge_mesh.h"

/// Keeps the forces with which contact points press on faces from one joint fit to the next. Little changes in between,
/// so the next fit needs few rounds if it begins with them.
namespace bp {

class ContactForces {
 public:
  struct Force {
    FaceId face;
    std::uint32_t point;
    float size;
  };
  [[nodiscard]] bool empty() const { return forces_.empty(); }
  /// Returns the force of a point on a face; 0 if there is none. Linear in the forces on the face.
  [[nodiscard]] float of(FaceId face, std::uint32_t point) const;
  /// Replaces all forces. `faces`: a bound above all numbers of faces. Linear.
  void set(std::span<const Force> forces, std::size_t faces);

 private:
  std::vector<Force> forces_;         // sorted by face
  std::vector<std::uint32_t> first_;  // for each face, its first force in forces_; and the end
};

}  // namespace bp
