#include "io/scene/detail/ply/packed_ply.h"

#include <algorithm>
#include <bit>
#include <mutex>
#include <span>

#include "io/scene/detail/block_cache.h"
#include "io/scene/detail/ply/ply_cursor.h"
#include "io/scene/detail/ply/ply_values.h"
#include "lib/core/parallel.h"
#include "lib/core/pool.h"

namespace bp {

namespace {

/// The positions of numbers in the file.
struct Layout {
  bool swap = false;
  std::uint64_t vertices = 0, vertex_count = 0, stride = 0;
  PlyType type[3]{};      // of x, y, z
  std::size_t at[3]{};    // offsets in the record
  bool together = false;  // floats side by side, as in memory
  std::uint64_t faces = 0, face_count = 0;
  std::size_t before = 0, after = 0;  // bytes of a face's record before and after the list
  PlyType count_type = PlyType::u8, index_type = PlyType::i32;

  [[nodiscard]] std::size_t record_bytes(std::uint64_t corners) const {
    return before + bytes_of(count_type) + std::size_t(corners) * bytes_of(index_type) + after;
  }
};

bool lay_out_vertices(const PlyElement& vertex, Layout& layout) {
  const char* const names[] = {"x", "y", "z"};
  layout.stride = vertex.fixed_bytes();
  layout.vertex_count = vertex.count;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t property = vertex.index_of(names[i]);
    if (property == vertex.properties.size()) return false;
    layout.type[i] = vertex.properties[property].type;
    for (std::size_t k = 0; k < property; ++k) layout.at[i] += bytes_of(vertex.properties[k].type);
  }
  layout.together = !layout.swap && layout.at[1] == layout.at[0] + 4 && layout.at[2] == layout.at[1] + 4 &&
                    std::all_of(layout.type, layout.type + 3, [](PlyType t) { return t == PlyType::f32; });
  return true;
}

bool lay_out_faces(const PlyElement& face, Layout& layout) {
  bool found = false;
  layout.face_count = face.count;
  for (const PlyProperty& p : face.properties) {
    if (!p.is_list) {
      (found ? layout.after : layout.before) += bytes_of(p.type);
      continue;
    }
    if (found || (p.name != "vertex_indices" && p.name != "vertex_index")) return false;
    found = true;
    layout.count_type = p.count_type;
    layout.index_type = p.type;
  }
  return found && is_integer(layout.count_type) && is_integer(layout.index_type);
}

/// Returns nothing unless the file is as packed_ply.h describes.
std::optional<Layout> layout_of(const PlyHeader& header, std::uint64_t file_bytes) {
  Layout layout;
  layout.swap = (header.format == PlyHeader::Format::big_endian) != (std::endian::native == std::endian::big);
  bool has_vertices = false;
  std::uint64_t at = header.data.offset;
  for (std::size_t i = 0; i < header.elements.size(); ++i) {
    const PlyElement& element = header.elements[i];
    if (element.name == "face") {
      layout.faces = at;
      for (const PlyElement& e : std::span(header.elements).subspan(i + 1)) {
        if (e.name == "tristrips") return {};
      }
      if (!has_vertices || !lay_out_faces(element, layout)) return {};
      const std::size_t least = layout.record_bytes(0);
      return element.count <= (file_bytes - at) / least ? std::optional(layout) : std::nullopt;
    }
    const std::uint64_t size = element.fixed_bytes();
    if (element.has_lists() || element.name == "tristrips") return {};
    if (size > 0 && element.count > (file_bytes - at) / size) return {};
    if (element.name == "vertex" && !has_vertices) {
      has_vertices = true;
      layout.vertices = at;
      if (!lay_out_vertices(element, layout)) return {};
    }
    at += size * element.count;
  }
  return {};
}

class PackedPly final : public TwoStepSource {
 public:
  PackedPly(SceneFilePtr file, const SceneOptions& options, const Layout& layout, PlyHeader header)
      : file_(std::move(file)),
        header_(std::move(header)),
        budget_(options.memory_bytes),
        fans_(options.fans),
        layout_(layout),
        at_(layout.faces) {}

  [[nodiscard]] std::uint64_t points() const override { return layout_.vertex_count; }

  /// Returns the bounds of all vertices: faces seldom leave out the outermost ones.
  [[nodiscard]] std::optional<Bounds3d> bounds() override {
    Bounds3d all;
    std::mutex mutex;
    parallel_ranges(std::int64_t(layout_.vertex_count), kMeasured, [&](std::int64_t begin, std::int64_t end) {
      std::vector<std::byte> records;
      read_vertices(std::uint64_t(begin), std::uint64_t(end), records);
      Bounds3d part;
      const std::byte* record = records.data();
      for (std::int64_t i = begin; i < end; ++i, record += layout_.stride)
        part.add(layout_.together ? floats(record + layout_.at[0]) : position(record));
      const std::lock_guard lock(mutex);
      all.merge(part);
    });
    return all;
  }

  bool next(RawBatch& batch) override {
    batch.records = batch.bad_faces = batch.count = 0;
    if (record_ == layout_.face_count) {
      check_end();
      return false;
    }
    for (std::size_t want = RawSource::kBatch * layout_.record_bytes(3); batch.records == 0;) {
      batch.bytes.resize(std::size_t(std::min<std::uint64_t>(want, file_->size() - at_)));
      batch.bytes.resize(file_->read_at(at_, batch.bytes));
      const std::size_t first_bytes = walk(batch);
      if (batch.records == 0 && batch.bytes.size() < want) fail_truncated();
      want = std::max(want + 1, first_bytes);  // a record with many corners
    }
    return true;
  }

  void complete(RawBatch& batch) const override {
    batch.triangles.resize(batch.count);  // keeps at least the final number; old triangles are not cleared
    batch.inner_edges.clear();
    if (layout_.index_type == PlyType::u32 && !layout_.swap) {
      complete(batch, [](const std::byte* from) { return std::uint64_t(load_bits<std::uint32_t>(from, false)); });
    } else if (layout_.index_type == PlyType::i32 && !layout_.swap) {
      complete(batch, [](const std::byte* from) {
        return std::uint64_t(std::int32_t(load_bits<std::uint32_t>(from, false)));
      });
    } else {
      complete(batch, [this](const std::byte* from) {
        return std::uint64_t(decode_integer(from, layout_.index_type, layout_.swap));
      });
    }
  }

  void rewind() override {
    at_ = layout_.faces;
    record_ = bad_faces_ = 0;
  }

 private:
  static constexpr std::int64_t kReadBytes = std::int64_t(4) << 20;
  static constexpr std::int64_t kMeasured = std::int64_t(1) << 14;  // vertices at a time: some hundred kilobytes

  [[nodiscard]] Vec3d position(const std::byte* record) const {
    Vec3d p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = decode_real(record + layout_.at[i], layout_.type[i], layout_.swap);
    return p;
  }

  [[nodiscard]] static Vec3d floats(const std::byte* from) {
    float p[3];
    std::memcpy(p, from, sizeof p);
    return {p[0], p[1], p[2]};
  }

  [[nodiscard]] std::int64_t corners_at(const std::byte* list) const {
    return layout_.count_type == PlyType::u8 ? std::int64_t(*list)
                                             : decode_integer(list, layout_.count_type, layout_.swap);
  }

  /// Counts the whole records at the front of the block, up to kBatch triangles, and moves on behind them. Returns the
  /// size of the first record, as far as the block tells.
  std::size_t walk(RawBatch& batch) {
    const std::size_t count_bytes = bytes_of(layout_.count_type), index_bytes = bytes_of(layout_.index_type);
    const std::size_t empty_bytes = layout_.record_bytes(0), end = batch.bytes.size();
    std::size_t at = 0, first_bytes = empty_bytes;
    if (layout_.count_type == PlyType::u8) {  // triangles, in most files
      const std::byte* const count = batch.bytes.data() + layout_.before;
      const std::size_t size = layout_.record_bytes(3);
      const std::uint64_t most =
          std::min<std::uint64_t>({layout_.face_count - record_, RawSource::kBatch, std::uint64_t(end / size)});
      while (batch.records < most && count[at] == std::byte{3}) {
        at += size;
        ++batch.records;
      }
      batch.count = batch.records;
      record_ += batch.records;
    }
    while (record_ < layout_.face_count && batch.count < RawSource::kBatch &&
           end - at >= layout_.before + count_bytes) {
      const std::int64_t n = corners_at(batch.bytes.data() + at + layout_.before);
      if (n < 0) fail_here(at, "a list has a size that is not a count");
      if (n > std::int64_t(PolygonSource::kMaxCorners)) fail_here(at, fmt::format("a face of {} corners", n));
      const std::size_t size = empty_bytes + std::size_t(n) * index_bytes;
      if (at == 0) first_bytes = size;
      if (size > end - at) break;
      at += size;
      batch.count += n > 2 ? std::uint64_t(n) - 2 : 0;
      ++batch.records;
      ++record_;
    }
    at_ += at;
    return first_bytes;
  }

  /// Calls body(list, n) for each record of a batch: its list of n indices.
  template <class Body>
  void for_each_face(const RawBatch& batch, const Body& body) const {
    const std::size_t count_bytes = bytes_of(layout_.count_type), index_bytes = bytes_of(layout_.index_type);
    const std::byte* at = batch.bytes.data();
    for (std::uint64_t r = 0; r < batch.records; ++r) {
      at += layout_.before;
      const auto n = std::size_t(corners_at(at));
      const std::byte* const list = at + count_bytes;
      at = list + n * index_bytes + layout_.after;
      body(list, n);
    }
  }

  /// Completes a batch. Vertices that follow each other in the file are mostly neighbours in space: then one read gets
  /// those of a batch. They lie in the caches of this core, so holding all vertices would be no faster.
  template <class Index>
  void complete(RawBatch& batch, const Index& index) const {
    const std::size_t index_bytes = bytes_of(layout_.index_type);
    std::uint64_t first = layout_.vertex_count, end = 0;
    for_each_face(batch, [&](const std::byte* list, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) {
        const std::uint64_t i = index(list + k * index_bytes);
        if (i >= layout_.vertex_count) continue;
        first = std::min(first, i);
        end = std::max(end, i + 1);
      }
    });
    if (first >= end) return expand(batch, index, nullptr, 0);
    if ((end - first) * layout_.stride <= batch.count * sizeof(TriangleD)) {
      read_vertices(first, end, batch.vertices);
      return expand(batch, index, batch.vertices.data(), first);
    }
    std::call_once(hold_once_, [&] { isolated([&] { hold_vertices(); }); });
    if (held_) return expand(batch, index, held_.get(), 0);
    const Pool<std::unique_ptr<BlockCache>>::Lease cache(*caches_);
    std::vector<std::byte> record(layout_.stride);
    expand(batch, index, [&](std::uint64_t i) {
      cache->read(layout_.vertices + i * layout_.stride, record.data(), record.size());
      return position(record.data());
    });
  }

  /// `records`: those of the vertices from number `first` on.
  template <class Index>
  void expand(RawBatch& batch, const Index& index, const std::byte* records, std::uint64_t first) const {
    const std::uint64_t stride = layout_.stride;
    if (layout_.together) {
      const std::byte* const x = records + layout_.at[0];
      expand(batch, index, [x, first, stride](std::uint64_t i) { return floats(x + (i - first) * stride); });
    } else {
      expand(batch, index, [&](std::uint64_t i) { return position(records + (i - first) * stride); });
    }
  }

  /// Makes triangles as PolygonSource does.
  template <class Index, class Vertex>
  void expand(RawBatch& batch, const Index& index, const Vertex& vertex) const {
    const std::size_t index_bytes = bytes_of(layout_.index_type);
    const std::uint64_t limit = layout_.vertex_count;
    FaceTriangles cut(fans_);
    std::size_t made = 0;
    for_each_face(batch, [&](const std::byte* list, std::size_t n) {
      if (n == 3) {
        const std::uint64_t a = index(list), b = index(list + index_bytes), c = index(list + 2 * index_bytes);
        if (a < limit && b < limit && c < limit) {
          batch.triangles[made++] = {vertex(a), vertex(b), vertex(c)};
        } else {
          ++batch.bad_faces;
        }
        return;
      }
      bool good = n >= 3;
      for (std::size_t i = 0; i < n; ++i) good = index(list + i * index_bytes) < limit && good;
      if (!good) {
        ++batch.bad_faces;
        return;
      }
      const auto place = [&](std::size_t k) { return vertex(index(list + k * index_bytes)); };
      cut.cut(n, place);
      batch.inner_edges.resize(made);
      for (std::size_t i = 0; i < cut.triangles(); ++i) {
        batch.triangles[made++] = cut.places(cut[i], place);
        batch.inner_edges.push_back(cut.inner_edges(i));
      }
    });
    batch.triangles.resize(made);
  }

  /// Reads the records of the vertices [begin, end).
  void read_vertices(std::uint64_t begin, std::uint64_t end, std::vector<std::byte>& out) const {
    out.resize(std::size_t((end - begin) * layout_.stride));
    if (file_->read_at(layout_.vertices + begin * layout_.stride, out) < out.size()) fail_truncated();
  }

  /// Reads all vertices, or, if there are too many, prepares to read them one by one.
  void hold_vertices() const {
    const std::uint64_t bytes = layout_.vertex_count * layout_.stride;
    if (bytes > budget_) {
      const int threads = thread_count();
      std::vector<std::unique_ptr<BlockCache>> caches;
      for (int i = 0; i < threads; ++i)
        caches.push_back(std::make_unique<BlockCache>(file_, budget_ / std::uint64_t(threads)));
      caches_ = std::make_unique<Pool<std::unique_ptr<BlockCache>>>(std::move(caches));
      return;
    }
    std::unique_ptr<std::byte[]> held(new std::byte[std::size_t(bytes)]);  // not zeroed
    parallel_ranges(std::int64_t(bytes), kReadBytes, [&](std::int64_t begin, std::int64_t end) {
      const std::span<std::byte> part(held.get() + begin, std::size_t(end - begin));
      if (file_->read_at(layout_.vertices + std::uint64_t(begin), part) < part.size()) fail_truncated();
    });
    held_ = std::move(held);
  }

  /// Checks that nothing follows the elements after the faces.
  void check_end() const {
    PlyBinaryCursor cursor(file_, header_);
    cursor.seek({at_});
    bool behind = false;
    for (const PlyElement& e : header_.elements) {
      if (behind && !cursor.skip_records(e)) skip_lists(cursor, e);
      behind = behind || e.name == "face";
    }
    cursor.check_end();
  }
  static void skip_lists(PlyBinaryCursor& cursor, const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& p : element.properties) {
        const std::int64_t n = p.is_list ? cursor.integer(p.count_type) : 1;
        if (n < 0) cursor.fail_here("a list has a size that is not a count; is the file damaged?");
        cursor.skip(p.type, std::uint64_t(n));
      }
    }
  }

  [[noreturn]] void fail_here(std::size_t within, const std::string& what) const {
    fail(ErrorCode::bad_input, "{}: byte {}: {}; is the file damaged?", file_->name(), at_ + within, what);
  }
  [[noreturn]] void fail_truncated() const {
    fail(ErrorCode::bad_input, "{}: ends at byte {}, in the middle of its data; the file is truncated", file_->name(),
         file_->size());
  }

  const SceneFilePtr file_;
  const PlyHeader header_;
  const std::uint64_t budget_;
  const bool fans_;
  const Layout layout_;
  std::uint64_t at_, record_ = 0;  // of the next face
  mutable std::once_flag hold_once_;
  mutable std::unique_ptr<std::byte[]> held_;  // records of all vertices
  mutable std::unique_ptr<Pool<std::unique_ptr<BlockCache>>> caches_;
};

}  // namespace

RawSourcePtr open_packed_ply(SceneFilePtr file, const SceneOptions& options, const PlyHeader& header) {
  const std::optional<Layout> layout = layout_of(header, file->size());
  return layout ? std::make_unique<PackedPly>(std::move(file), options, *layout, header) : nullptr;
}

}  // namespace bp
