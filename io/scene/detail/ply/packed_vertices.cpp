#include "io/scene/detail/ply/packed_vertices.h"

#include <span>

#include "lib/core/error.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::int64_t kReadBytes = std::int64_t(4) << 20;
constexpr std::int64_t kMeasured = std::int64_t(1) << 14;  // vertices at a time: some hundred kilobytes

}  // namespace

void fail_truncated(const SceneFile& file) {
  fail(ErrorCode::bad_input, "{}: ends at byte {}, in the middle of its data; the file is truncated", file.name(),
       file.size());
}

Bounds3d PackedVertices::bounds() const {
  Bounds3d all;
  std::mutex mutex;
  parallel_ranges(std::int64_t(layout_.vertex_count), kMeasured, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::byte> records;
    read(std::uint64_t(begin), std::uint64_t(end), records);
    Bounds3d part;
    const std::byte* record = records.data();
    for (std::int64_t i = begin; i < end; ++i, record += layout_.stride)
      part.add(layout_.together ? PackedLayout::floats(record + layout_.at[0]) : layout_.position(record));
    const std::lock_guard lock(mutex);
    all.merge(part);
  });
  return all;
}

void PackedVertices::read(std::uint64_t begin, std::uint64_t end, std::vector<std::byte>& out) const {
  out.resize(std::size_t((end - begin) * layout_.stride));
  if (file_->read_at(layout_.vertices + begin * layout_.stride, out) < out.size()) fail_truncated(*file_);
}

void PackedVertices::hold() const {
  isolated([&] {
    const std::uint64_t bytes = layout_.vertex_count * layout_.stride;
    if (bytes > budget_) {
      std::vector<std::unique_ptr<BlockCache>> caches;
      for (int i = 0; i < thread_count(); ++i)
        caches.push_back(std::make_unique<BlockCache>(file_, budget_ / std::uint64_t(thread_count())));
      caches_ = std::make_unique<Pool<std::unique_ptr<BlockCache>>>(std::move(caches));
      return;
    }
    std::unique_ptr<std::byte[]> held(new std::byte[std::size_t(bytes)]);  // not zeroed
    parallel_ranges(std::int64_t(bytes), kReadBytes, [&](std::int64_t begin, std::int64_t end) {
      const std::span<std::byte> part(held.get() + begin, std::size_t(end - begin));
      if (file_->read_at(layout_.vertices + std::uint64_t(begin), part) < part.size()) fail_truncated(*file_);
    });
    held_ = std::move(held);
  });
}

}  // namespace bp
