#pragma once
#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "io/scene/detail/block_cache.h"
#include "io/scene/detail/ply/packed_layout.h"
#include "io/scene/scene_file.h"
#include "lib/core/box.h"
#include "lib/core/pool.h"

namespace bp {

/// Says that a file ends in the middle of its data.
[[noreturn]] void fail_truncated(const SceneFile& file);

/// The vertices of a packed PLY, read from their places in the file. Thread-safe.
class PackedVertices {
 public:
  /// Keeps a reference to `layout`. `budget`: bytes for vertices that are held.
  PackedVertices(SceneFilePtr file, const PackedLayout& layout, std::uint64_t budget)
      : file_(std::move(file)), layout_(layout), budget_(budget) {}

  /// Returns the bounds of all vertices: faces seldom leave out the outermost ones.
  [[nodiscard]] Bounds3d bounds() const;

  /// Calls body(vertex), where vertex(i) returns the position of a vertex in [range[0], range[1]). Vertices that follow
  /// each other in the file are mostly neighbours in space: then one read into `room` gets those of a batch, if they
  /// take at most `most_bytes`. They lie in the caches of this core, so holding all vertices would be no faster.
  template <class Body>
  void visit(const std::array<std::uint64_t, 2>& range, std::uint64_t most_bytes, std::vector<std::byte>& room,
             const Body& body) const {
    const auto [first, end] = range;
    if (first >= end) return visit(nullptr, 0, body);
    if ((end - first) * layout_.stride <= most_bytes) {
      read(first, end, room);
      return visit(room.data(), first, body);
    }
    std::call_once(hold_once_, [&] { hold(); });
    if (held_) return visit(held_.get(), 0, body);
    const Pool<std::unique_ptr<BlockCache>>::Lease cache(*caches_);
    std::vector<std::byte> record(layout_.stride);
    body([&](std::uint64_t i) {
      cache->read(layout_.vertices + i * layout_.stride, record.data(), record.size());
      return layout_.position(record.data());
    });
  }

 private:
  /// `records`: those of the vertices from number `first` on.
  template <class Body>
  void visit(const std::byte* records, std::uint64_t first, const Body& body) const {
    const std::uint64_t stride = layout_.stride;
    if (layout_.together) {
      const std::byte* const x = records + layout_.at[0];
      body([x, first, stride](std::uint64_t i) { return PackedLayout::floats(x + (i - first) * stride); });
    } else {
      body([&](std::uint64_t i) { return layout_.position(records + (i - first) * stride); });
    }
  }
  /// Reads the records of the vertices [begin, end).
  void read(std::uint64_t begin, std::uint64_t end, std::vector<std::byte>& out) const;
  /// Reads all vertices, or, if there are too many, prepares to read them one by one.
  void hold() const;

  const SceneFilePtr file_;
  const PackedLayout& layout_;
  const std::uint64_t budget_;
  mutable std::once_flag hold_once_;
  mutable std::unique_ptr<std::byte[]> held_;  // records of all vertices
  mutable std::unique_ptr<Pool<std::unique_ptr<BlockCache>>> caches_;
};

}  // namespace bp
