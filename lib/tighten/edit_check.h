#pragma once
#include "lib/enclosed/contact_points.h"
#include "lib/enclosed/enclosed.h"
#include "lib/mesh/guard.h"
#include "lib/simplify/refusal.h"
#include "lib/simplify/shape_limits.h"
#include "lib/simplify/waves.h"

namespace bp {

struct EditCounts {
  std::uint64_t tries = 0;
  Refusals refused;
  std::uint64_t beyond_reach = 0;  ///< of the changes refused for their growth, those refused by the reach

  EditCounts& operator+=(const EditCounts& more) {
    tries += more.tries;
    refused += more.refused;
    beyond_reach += more.beyond_reach;
    return *this;
  }
};

/// The parts of a proxy that a check reads. All must outlive the check.
struct EditedProxy {
  const HalfEdgeMesh& mesh;
  const FaceTree& tree;
  const Enclosed& enclosed;
  const ContactPoints& contacts;
  const EdgeLimit& edge_limit;
  StepLimits* limits;         ///< counts what it allows as taken
  const LatticeBox room;      ///< for new vertices
  const double& reach_units;  ///< ShapeLimits::reach
};

/// Decides exactly whether a change may be made (docs/bounding.md, "Tightening"). A check changes nothing of the proxy,
/// so checks on several threads may read one proxy at the same time, unless it has limits.
class EditCheck {
 public:
  explicit EditCheck(const EditedProxy& proxy);

  [[nodiscard]] bool allows_move(VertexId v, const LatticeCoord& to);
  [[nodiscard]] bool allows_collapse(HalfEdgeId h, const LatticeCoord& to);
  [[nodiscard]] bool allows_flip(HalfEdgeId h);
  /// Decides about ProxyEditor::cut(). opposite(h) must have three faces.
  [[nodiscard]] bool allows_cut(HalfEdgeId h);

  /// Returns the enclosed thing that the last change would have cut into, in the coordinates of the contact points;
  /// null if the change failed for another reason.
  [[nodiscard]] const Blocker* blocker() const { return blocked_ ? &blocker_ : nullptr; }

  void put_boxes(EditBoxes& boxes) const;  ///< puts the boxes of the faces that the last change would make

  EditCounts counts;  ///< of all changes that were tested

 private:
  void begin();
  void add_old_face(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c, const LatticeCoord& to);
  [[nodiscard]] bool shape_is_fine();
  [[nodiscard]] bool cuts_off_contacts(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& u,
                                       const LatticeCoord& w) const;
  [[nodiscard]] bool keeps_enclosed();
  [[nodiscard]] bool stays_near();
  [[nodiscard]] bool fan_is_fine(const LatticeCoord& apex);
  [[nodiscard]] bool is_free(bool free);

  const EditedProxy proxy_;
  const HalfEdgeMesh& mesh_;
  Guard guard_;
  // The next members belong to the change that is tested.
  std::vector<NewFace> faces_;
  std::vector<FaceId> replaced_;
  std::vector<Tetrahedron> swept_;
  double least_quality_ = 1;  // the least quality of the replaced faces
  LatticeBox star_;           // box around the replaced faces
  Blocker blocker_;
  bool blocked_ = false;
};

}  // namespace bp
