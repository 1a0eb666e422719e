#pragma once
#include <algorithm>
#include <functional>

#include "lib/core/indexed_mesh.h"
#include "lib/grid/stream.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/pass/context.h"
#include "tests/support/memory_shelf.h"

/// Streams of voxels in memory, for tests of the meshing stage.
namespace bp::test {

using Solid = std::function<bool(VoxelCoord)>;

[[nodiscard]] inline BitBox bits_of(const VoxelBox& box, const Solid& solid) {
  BitBox bits(voxels_of(bricks_of(box)));
  for_each(box, [&](VoxelCoord p) {
    if (solid(p)) bits.set(p);
  });
  return bits;
}

/// One layer, or two with a closing. Voxels of edge 1, bounds as the box.
class VoxelSource final : public BrickSource {
 public:
  VoxelSource(const VoxelBox& box, const Solid& solid) { begin(box, solid); }
  VoxelSource(const VoxelBox& box, const Solid& solid, const Solid& closing) {
    begin(box, solid);
    header_.has_closing = true;
    add(Layer::closing, bits_of(box, closing));
    sort();
  }
  [[nodiscard]] const StreamHeader& header() const override { return header_; }
  [[nodiscard]] StreamHeader& header() { return header_; }
  void set_slab_axis(int axis) {
    header_.slab_axis = axis;
    sort();
  }
  bool read(Brick& out) override {
    if (next_ == bricks_.size()) return false;
    out = bricks_[next_++];
    return true;
  }

 private:
  void begin(const VoxelBox& box, const Solid& solid) {
    header_.bricks = bricks_of(box);
    for (const VoxelCoord& p : {box.min, box.max}) header_.bounds.add({double(p.x), double(p.y), double(p.z)});
    add(Layer::solid, bits_of(box, solid));
    sort();
  }
  void sort() {
    std::sort(bricks_.begin(), bricks_.end(),
              [this](const Brick& a, const Brick& b) { return slab_order(header_.slab_axis, a, b); });
  }
  void add(Layer layer, const BitBox& bits) {
    MemoryShelf shelf;
    store_voxels(bits, shelf);
    for (const BrickCoord c : shelf.coords()) {
      Brick brick;
      brick.coord = c;
      brick.layer = layer;
      brick.fill = shelf.get(c, brick.bits);
      bricks_.push_back(brick);
    }
  }
  StreamHeader header_;
  std::vector<Brick> bricks_;
  std::size_t next_ = 0;
};

[[nodiscard]] inline ShelfFactory memory_shelves() {
  return [] { return std::make_unique<MemoryShelf>(); };
}
[[nodiscard]] inline PassContext memory_context() {
  PassContext context;
  context.make_shelf = memory_shelves();
  return context;
}

/// In scene units, as bpcheck would read it.
[[nodiscard]] inline IndexedMesh indexed(const LatticeMesh& mesh) {
  IndexedMesh out;
  for (const LatticeCoord& p : mesh.vertices) out.vertices.push_back(mesh.frame.world(p));
  out.triangles = mesh.triangles;
  return out;
}

}  // namespace bp::test
