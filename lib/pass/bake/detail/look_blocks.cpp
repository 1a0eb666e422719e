#include "lib/pass/bake/detail/look_blocks.h"

#include <cstring>

namespace bp {

namespace {

std::vector<TriangleD> corners_of(const std::vector<TexturedTriangle>& triangles) {
  std::vector<TriangleD> corners;
  corners.reserve(triangles.size());
  for (const TexturedTriangle& t : triangles) corners.push_back(t.corners);
  return corners;
}

}  // namespace

LookBlock::LookBlock(const std::vector<TexturedTriangle>& triangles) : triangles_(corners_of(triangles)) {
  colors_.reserve(triangles.size());
  textures_.reserve(triangles.size());
  for (const TexturedTriangle& t : triangles) {
    colors_.push_back(t.colors);
    textures_.push_back(t.texture);
  }
}

std::uint64_t LookBlock::bytes() const {
  return triangles_.bytes() + colors_.size() * (sizeof(TriangleColors) + sizeof(TriangleTexture));
}

void LookBlocks::add(std::span<const TexturedTriangle> triangles) {
  Bounds3d& box = boxes_.emplace_back();
  for (const TexturedTriangle& t : triangles) box.merge(bounds_of(t.corners));
  handles_.push_back(store_->put(std::as_bytes(triangles)));
}

void LookBlocks::close(std::uint64_t memory_bytes) {
  std::vector<TriangleD> boxes;
  boxes.reserve(boxes_.size());
  for (const Bounds3d& b : boxes_) boxes.push_back({b.min, b.max, b.max});
  tree_ = std::make_unique<TriangleBvh>(boxes);
  at_work_ = std::make_unique<LruCache<LookBlock>>(memory_bytes, boxes_.size());
}

std::shared_ptr<const LookBlock> LookBlocks::get(std::uint32_t block) const {
  return at_work_->get(block, [&] { return std::make_shared<const LookBlock>(load(block)); });
}

std::vector<TexturedTriangle> LookBlocks::load(std::uint32_t block) const {
  std::vector<std::byte> bytes;
  store_->get(handles_[block], bytes);
  std::vector<TexturedTriangle> triangles(bytes.size() / sizeof(TexturedTriangle));
  std::memcpy(triangles.data(), bytes.data(), bytes.size());
  return triangles;
}

}  // namespace bp
