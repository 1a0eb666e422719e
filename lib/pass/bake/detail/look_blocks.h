#pragma once
#include <memory>
#include <vector>

#include "lib/core/lru_cache.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/bake/textured_triangle.h"
#include "lib/store/scratch.h"

namespace bp {

/// Some neighbouring triangles, ready for searches.
class LookBlock {
 public:
  explicit LookBlock(const std::vector<TexturedTriangle>& triangles);
  [[nodiscard]] const TriangleBvh& triangles() const { return triangles_; }
  /// Returns the colours of an item of triangles().
  [[nodiscard]] const TriangleColors& colors(std::uint32_t item) const { return colors_[triangles_.item(item).id]; }
  [[nodiscard]] const TriangleTexture& texture(std::uint32_t item) const { return textures_[triangles_.item(item).id]; }
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  TriangleBvh triangles_;
  std::vector<TriangleColors> colors_;
  std::vector<TriangleTexture> textures_;
};

/// All triangles of a scene, in blocks that wait in a store. Blocks in use are in memory. Thread-safe after close().
class LookBlocks {
 public:
  /// The most triangles of a block: so few that its hierarchy is built without other threads.
  static constexpr std::size_t kTriangles = 2048;
  /// The most bytes of a triangle in use.
  static constexpr std::uint64_t kBytesEach = sizeof(TriangleBvh::Item) + 2 * 80 + 64;

  explicit LookBlocks(std::unique_ptr<Scratch> store) : store_(std::move(store)) {}

  void add(std::span<const TexturedTriangle> triangles);
  /// Ends the blocks after the last add(). `memory_bytes` is for blocks in use; blocks that someone holds come on top.
  void close(std::uint64_t memory_bytes);

  [[nodiscard]] Scratch& store() { return *store_; }
  [[nodiscard]] std::shared_ptr<const LookBlock> get(std::uint32_t block) const;
  /// Returns the triangles as the store keeps them.
  [[nodiscard]] std::vector<TexturedTriangle> load(std::uint32_t block) const;
  [[nodiscard]] const Bounds3d& box(std::uint32_t block) const { return boxes_[block]; }
  /// Calls f(block) for each block whose box meets this one, in any order.
  template <class F>
  void visit(const Bounds3d& box, const F& f) const {
    tree_->visit(box, [&](const TriangleBvh::Item& item) { return f(item.id), false; });
  }

 private:
  std::unique_ptr<Scratch> store_;
  std::vector<Scratch::Handle> handles_;
  std::vector<Bounds3d> boxes_;
  std::unique_ptr<TriangleBvh> tree_;  // over triangles that stand for the blocks' boxes
  mutable std::unique_ptr<LruCache<LookBlock>> at_work_;
};

}  // namespace bp
