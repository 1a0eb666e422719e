#include "io/scene/detail/vertex_pool.h"

namespace bp {

VertexPool::VertexPool(std::uint64_t budget_bytes, std::string temp_dir)
    : budget_bytes_(budget_bytes), temp_dir_(std::move(temp_dir)) {}

void VertexPool::open_chunk() {
  // Once spilled, the cache gets the budget, and every full chunk is written at once.
  if (spilled() || (chunks_.size() + 1) * kChunk * sizeof(Vec3d) > budget_bytes_) spill();
  chunks_.emplace_back(new Vec3d[kChunk]);
}

void VertexPool::spill() {
  if (chunks_.empty()) return;
  if (!scratch_) {
    scratch_ = std::make_shared<ScratchFile>(temp_dir_);
    cache_ = std::make_unique<BlockCache>(view_of(scratch_, "scratch file"), budget_bytes_);
  }
  for (auto& chunk : chunks_) {
    scratch_->append(std::as_bytes(std::span(chunk.get(), kChunk)));
    chunk.reset();
  }
  spilled_ += chunks_.size() * kChunk;
  chunks_.clear();
}

Vec3d VertexPool::read_spilled(std::uint64_t i) {
  Vec3d p;
  cache_->read(i * sizeof(Vec3d), p.data(), sizeof p);
  return p;
}

}  // namespace bp
