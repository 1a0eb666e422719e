#pragma once
#include "lib/grid/stream.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/surface/piece.h"

/// Dense surface: the boundary of the union of voxels, as the faces between an occupied and an empty voxel, each split
/// into two triangles, counter-clockwise from outside. Exact: it contours the solid and nothing else. Closed and
/// 2-manifold if the voxels were repaired (repair.h).
namespace bp {

/// A dense surface brick by brick, so that it need not be in memory as a whole. A face belongs to the brick that its
/// least corner lies in.
class SurfaceSource {
 public:
  explicit SurfaceSource(const GridFrame& frame) : frame_(frame) {}
  virtual ~SurfaceSource() = default;
  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  /// Returns the bricks that may have faces, in the order z, y, x.
  [[nodiscard]] virtual std::vector<BrickCoord> bricks() const = 0;
  /// Returns a box around the vertices; it has no meaning if there are none.
  [[nodiscard]] virtual LatticeBox box() const = 0;
  /// Returns the faces of a brick. The piece's cell is the closed brick. Thread-safe.
  [[nodiscard]] virtual Piece piece(BrickCoord brick) const = 0;

 private:
  GridFrame frame_;
};

/// The surface of the voxels on a shelf. The shelf must not change while this exists.
class ShelfSurface final : public SurfaceSource {
 public:
  ShelfSurface(const BrickShelf& shelf, const GridFrame& frame) : SurfaceSource(frame), shelf_(shelf) {}
  [[nodiscard]] std::vector<BrickCoord> bricks() const override;
  [[nodiscard]] LatticeBox box() const override;               ///< reads all voxels, in parallel
  [[nodiscard]] Piece piece(BrickCoord brick) const override;  ///< about 0.3 ms

 private:
  const BrickShelf& shelf_;
};

/// A dense surface in memory: its vertices are corners of voxels, and its faces lie in sides of voxels.
class MeshSurface final : public SurfaceSource {
 public:
  explicit MeshSurface(const LatticeMesh& dense);  ///< keeps a reference; 4 bytes a face
  [[nodiscard]] std::vector<BrickCoord> bricks() const override { return bricks_; }
  [[nodiscard]] LatticeBox box() const override { return box_of(dense_.vertices); }
  [[nodiscard]] Piece piece(BrickCoord brick) const override;

 private:
  const LatticeMesh& dense_;
  std::vector<BrickCoord> bricks_;
  std::vector<std::uint32_t> begin_;  // per brick: its first place in faces_; one more at the end
  std::vector<std::uint32_t> faces_;  // face numbers, brick by brick
};

/// Returns the number of triangles of all bricks. Cost: making all of them.
[[nodiscard]] std::uint64_t count_faces(const SurfaceSource& surface);

/// Returns all bricks as one piece.
[[nodiscard]] Piece whole_piece(const SurfaceSource& surface);

/// Returns all bricks as one mesh. The result does not depend on threads. Memory: 2 triangles for each voxel face, 12
/// bytes each, and 24 bytes for each vertex.
[[nodiscard]] LatticeMesh dense_surface(const BrickShelf& shelf, const GridFrame& frame);

}  // namespace bp
