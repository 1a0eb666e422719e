#pragma once
#include <optional>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/pass/leaf/scene_leaf.h"

namespace bp {

/// A leaf as one mesh: faces of all parts share points, and each face has three corners with looks of their own. Faces
/// around a point that look alike there share a corner (a wedge [Hop99]). Surfaces that touch at one place without a
/// common edge have a point each.
class LeafMesh {
 public:
  using Index = std::uint32_t;
  /// How a corner looks.
  struct Look {
    Index part = 0;
    std::array<float, 3> normal{};
    std::array<float, 2> uv{};
    LinearColor color;
    std::array<float, 2> second_uv{};
    /// Returns whether a picture shows no edge between both; normals have no say.
    [[nodiscard]] bool joins(const Look& other) const {
      return part == other.part && uv == other.uv && color == other.color && second_uv == other.second_uv;
    }
  };
  struct Corner {
    Index point = 0;
    Look look;
  };
  using Face = std::array<Index, 3>;  ///< numbers of its corners

  explicit LeafMesh(const SceneLeaf& leaf);
  /// Returns what is left, with the origin, the unit and the materials of the leaf that the mesh was made from.
  [[nodiscard]] SceneLeaf leaf(const SceneLeaf& whole) const;

  [[nodiscard]] std::size_t point_count() const { return points_.size(); }
  [[nodiscard]] std::size_t face_count() const { return alive_; }  ///< of faces that are left
  [[nodiscard]] bool is_alive(Index f) const { return is_alive_[f] != 0; }
  /// Returns a point's place in the leaf's units, from its origin.
  [[nodiscard]] const Vec3d& at(Index point) const { return points_[point].at; }
  /// Returns the faces around a point.
  [[nodiscard]] const std::vector<Index>& faces_of(Index point) const { return points_[point].faces; }
  [[nodiscard]] const Face& face(Index f) const { return faces_[f]; }
  [[nodiscard]] const Corner& corner(Index c) const { return corners_[c]; }
  [[nodiscard]] const Look& look_at(Index f, std::size_t k) const { return corners_[faces_[f][k]].look; }
  [[nodiscard]] Index point_of(Index f, std::size_t k) const { return corners_[faces_[f][k]].point; }
  /// Returns which corner of the face lies at the point; none: 3.
  [[nodiscard]] std::size_t place_in(Index f, Index point) const;
  /// Returns the points that share a face with the point, each as often as faces have both.
  [[nodiscard]] std::vector<Index> neighbours(Index point) const;
  /// Returns the corners at a point, each once.
  [[nodiscard]] std::vector<Index> corners_of(Index point) const;

  /// A corner at an end of an edge that collapses, and what becomes of it.
  struct Change {
    Index corner = 0;
    Index into = 0;  ///< another corner takes its place; else the corner itself
    Look look;       ///< of `into`
  };
  /// Moves the point `u` to a place, takes `v` into it, and changes the corners of both. Faces with both ends are gone.
  /// Where two faces of a part come to lie on each other, one is gone, too. If they turned their backs to each other,
  /// both sides of the other one are shown, or each shows its own side if they look different.
  void collapse(Index u, Index v, const Vec3d& to, const std::vector<Change>& changes);
  /// Takes a face away.
  void erase(Index f);

 private:
  void part_fans(Index point);
  void give_point(Index point, const std::vector<Index>& fan);
  void erase_doubles(Index point);
  [[nodiscard]] bool joins(Index f, Index g) const;
  [[nodiscard]] bool turns_like(Index f, Index g) const;

  struct Point {
    Vec3d at{};
    std::vector<Index> faces;
  };
  std::vector<Point> points_;
  std::vector<Corner> corners_;
  std::vector<Face> faces_;
  std::vector<char> is_alive_;    // by face
  std::vector<LeafSides> sides_;  // by face
  std::size_t alive_ = 0;
};

}  // namespace bp
