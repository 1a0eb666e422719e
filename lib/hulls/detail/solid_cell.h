#pragma once
#include <array>
#include <memory>
#include <vector>

#include "lib/mesh/box_tree.h"
#include "lib/mesh/lattice_mesh.h"

/// The part of a solid within a box.
namespace bp {

/// The part of a closed mesh within a cell: everything from half a lattice unit below `cell.min` to half a unit above
/// `cell.max`, so that no vertex lies on a side of the cell. Cells are cut from cells.
class SolidCell {
 public:
  /// Makes the whole solid that a closed, embedded surface bounds.
  explicit SolidCell(LatticeMesh mesh);
  /// Returns the part of this one within `cell`, which must lie in its own cell.
  [[nodiscard]] SolidCell within(const LatticeBox& cell) const;
  [[nodiscard]] const LatticeBox& cell() const { return cell_; }
  /// Returns a pointer that is equal for cells of the same solid.
  [[nodiscard]] const void* solid() const { return surface_.get(); }

  /// Returns whether the point half a unit above p along each axis lies in the whole solid. Linear.
  [[nodiscard]] bool holds(const LatticeCoord& p) const;

  enum class Rounding { nearest, outward };
  /// Returns points whose hull contains the solid within the cell. With `outward` (decided in integers) it also
  /// contains a strip of half a unit around the cell's cuts: each point of the open solid lies in the open hull of one
  /// of the cells that cover it. The points are vertices, places where edges meet sides of the cell and edges of the
  /// cell meet the surface, and corners of the cell.
  [[nodiscard]] std::vector<LatticeCoord> points(Rounding rounding) const;
  /// Returns six times its volume, in floating point.
  [[nodiscard]] double volume6() const;

  /// A place to cut, half a unit above `at`. `weight`: area of the surface that is level there.
  struct Step {
    std::int64_t at;
    double weight;
  };
  /// Returns the places along an axis where the section changes: next to faces that are nearly perpendicular to it, so
  /// that the solid at the face is on one side as a whole. They are in the order of the axis.
  [[nodiscard]] std::vector<Step> steps(int axis) const;

 private:
  SolidCell() = default;
  using Face = std::array<std::uint32_t, 3>;

  [[nodiscard]] bool holds_vertex(const LatticeCoord& p) const;
  void add_edge_points(Rounding rounding, std::vector<LatticeCoord>& out) const;
  void add_side_points(Rounding rounding, std::vector<LatticeCoord>& out) const;

  struct Surface {
    LatticeMesh mesh;
    std::vector<LatticeBox> boxes;  // boxes of its triangles
  };
  std::shared_ptr<const Surface> surface_;  // of the whole solid
  LatticeBox cell_;
  std::vector<std::uint32_t> faces_;                 // faces whose boxes meet the cell
  std::array<std::vector<std::uint32_t>, 3> tubes_;  // faces whose boxes do so seen along an axis
};

}  // namespace bp
