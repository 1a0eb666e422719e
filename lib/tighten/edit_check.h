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
  std::uint64_t beyond_reach = 0;  ///< of those refused for their growth

  EditCounts& operator+=(const EditCounts& more) {
    tries += more.tries;
    refused += more.refused;
    beyond_reach += more.beyond_reach;
    return *this;
  }
};

/// A proxy that is edited, as a check reads it. All must outlive the check.
struct EditedProxy {
  const HalfEdgeMesh& mesh;
  const FaceTree& tree;
  const Enclosed& enclosed;
  const ContactPoints& contacts;
  const EdgeLimit& edge_limit;
  StepLimits* limits;         ///< counts what it allows as taken
  const LatticeBox room;      ///< for new vertices
  const double& reach_units;  ///< as ShapeLimits::reach
};

/// Whether a change may be made, decided exactly (docs/bounding.md, "Tightening"). A check changes nothing of the
/// proxy: checks on several threads may look at one proxy at the same time, unless it has limits.
class EditCheck {
 public:
  explicit EditCheck(const EditedProxy& proxy);

  [[nodiscard]] bool allows_move(VertexId v, const LatticeCoord& to);
  [[nodiscard]] bool allows_collapse(HalfEdgeId h, const LatticeCoord& to);
  [[nodiscard]] bool allows_flip(HalfEdgeId h);
  /// As ProxyEditor::cut(). opposite(h) has three faces.
  [[nodiscard]] bool allows_cut(HalfEdgeId h);

  /// What must stay inside and stood in the way, in the coordinates of the contact points; null if something else did.
  [[nodiscard]] const Blocker* blocker() const { return blocked_ ? &blocker_ : nullptr; }

  void put_boxes(EditBoxes& boxes) const;  ///< of the faces that would be there after the last question

  EditCounts counts;  ///< of all questions

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
  // Of the change at hand:
  std::vector<NewFace> faces_;
  std::vector<FaceId> replaced_;
  std::vector<Tetrahedron> swept_;
  double least_quality_ = 1;  // of the faces replaced
  LatticeBox star_;           // around them
  Blocker blocker_;
  bool blocked_ = false;
};

}  // namespace bp
