#include "io/scene/detail/ply/packed_ply.h"

#include <algorithm>
#include <bit>

#include "io/scene/detail/block_cache.h"
#include "io/scene/detail/ply/ply_values.h"
#include "lib/core/parallel.h"
#include "lib/core/pool.h"

namespace bp {

namespace {

/// Where numbers stand in the file.
struct Layout {
  bool swap = false;
  std::uint64_t vertices = 0, vertex_count = 0, stride = 0;
  PlyType type[3]{};      // of x, y, z
  std::size_t at[3]{};    // in the record
  bool together = false;  // floats side by side, as they lie in memory
  std::uint64_t faces = 0, face_count = 0;
  std::size_t before = 0, after = 0;  // bytes of a face's record around the list
  PlyType count_type = PlyType::u8, index_type = PlyType::i32;

  [[nodiscard]] std::size_t record_bytes(std::uint64_t corners) const {
    return before + bytes_of(count_type) + std::size_t(corners) * bytes_of(index_type) + after;
  }
};

bool is_integer(PlyType type) {
  return type != PlyType::f32 && type != PlyType::f64;
}

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

/// Nothing unless the file is as packed_ply.h says.
std::optional<Layout> layout_of(const PlyHeader& header, std::uint64_t file_bytes) {
  Layout layout;
  layout.swap = (header.format == PlyHeader::Format::big_endian) != (std::endian::native == std::endian::big);
  bool has_vertices = false;
  std::uint64_t at = header.data.offset;
  for (std::size_t i = 0; i < header.elements.size(); ++i) {
    const PlyElement& element = header.elements[i];
    if (element.name == "face") {
      layout.faces = at;
      const bool last = std::none_of(header.elements.begin() + std::ptrdiff_t(i) + 1, header.elements.end(),
                                     [](const PlyElement& e) { return e.name == "face" || e.name == "tristrips"; });
      if (!has_vertices || !last || !lay_out_faces(element, layout)) return {};
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

class PackedPly final : public RawSource {
 public:
  PackedPly(SceneFilePtr file, const SceneOptions& options, const Layout& layout)
      : file_(std::move(file)),
        budget_(options.memory_bytes),
        fans_(options.fans),
        layout_(layout),
        at_(layout.faces) {}

  [[nodiscard]] std::uint64_t points() const override { return layout_.vertex_count; }

  bool read(std::vector<TriangleD>& out) override {
    const bool more = next(one_);
    complete(one_);
    bad_faces_ += one_.bad_faces;
    out.swap(one_.triangles);
    return more && (!out.empty() || read(out));  // a batch may hold bad faces only
  }

  bool next(RawBatch& batch) override {
    batch.records = batch.bad_faces = batch.count = 0;
    if (record_ == layout_.face_count) return false;
    hold_vertices();
    for (std::size_t want = RawSource::kBatch * layout_.record_bytes(3); batch.records == 0;) {
      batch.bytes.resize(std::size_t(std::min<std::uint64_t>(want, file_->size() - at_)));
      batch.bytes.resize(file_->read_at(at_, batch.bytes));
      const std::size_t first_bytes = walk(batch);
      if (batch.records == 0 && batch.bytes.size() < want) fail_truncated();
      want = std::max(want + 1, first_bytes);  // a record of many corners
    }
    return true;
  }

  void complete(RawBatch& batch) const override {
    batch.triangles.clear();
    batch.inner_edges.clear();
    batch.triangles.reserve(batch.count);
    const auto index = [&](const std::byte* from) {
      return std::uint64_t(decode_integer(from, layout_.index_type, layout_.swap));
    };
    if (batch.records == 0) return;
    if (!held_) {
      const Pool<std::unique_ptr<BlockCache>>::Lease cache(*caches_);
      std::vector<std::byte> record(layout_.stride);
      expand(batch, index, [&](std::uint64_t i) {
        cache->read(layout_.vertices + i * layout_.stride, record.data(), record.size());
        return position(record.data());
      });
    } else if (layout_.together && !layout_.swap && bytes_of(layout_.index_type) == 4) {
      const bool is_signed = layout_.index_type == PlyType::i32;
      const std::byte* const base = held_.get() + layout_.at[0];
      const auto word = [is_signed](const std::byte* from) {
        const auto bits = load_bits<std::uint32_t>(from, false);
        return is_signed ? std::uint64_t(std::int32_t(bits)) : std::uint64_t(bits);
      };
      expand(batch, word, [&, stride = layout_.stride](std::uint64_t i) {
        float p[3];
        std::memcpy(p, base + i * stride, sizeof p);
        return Vec3d{p[0], p[1], p[2]};
      });
    } else {
      expand(batch, index, [&](std::uint64_t i) { return position(held_.get() + i * layout_.stride); });
    }
  }

  void rewind() override {
    at_ = layout_.faces;
    record_ = bad_faces_ = 0;
  }

 private:
  static constexpr std::int64_t kReadBytes = std::int64_t(4) << 20;

  [[nodiscard]] Vec3d position(const std::byte* record) const {
    Vec3d p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = decode_real(record + layout_.at[i], layout_.type[i], layout_.swap);
    return p;
  }

  [[nodiscard]] std::int64_t corners_at(const std::byte* list) const {
    return layout_.count_type == PlyType::u8 ? std::int64_t(*list)
                                             : decode_integer(list, layout_.count_type, layout_.swap);
  }

  /// Counts the whole records at the front of the block, up to kBatch triangles, and moves on behind them. Returns the
  /// size of the first, as far as the block tells.
  std::size_t walk(RawBatch& batch) {
    const std::size_t count_bytes = bytes_of(layout_.count_type), index_bytes = bytes_of(layout_.index_type);
    const std::size_t empty_bytes = layout_.record_bytes(0), end = batch.bytes.size();
    std::size_t at = 0, first_bytes = empty_bytes;
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

  /// As PolygonSource makes them.
  template <class Index, class Vertex>
  void expand(RawBatch& batch, const Index& index, const Vertex& vertex) const {
    const std::size_t count_bytes = bytes_of(layout_.count_type), index_bytes = bytes_of(layout_.index_type);
    const std::uint64_t limit = layout_.vertex_count;
    const std::byte* at = batch.bytes.data();
    FaceTriangles cut(fans_);
    for (std::uint64_t r = 0; r < batch.records; ++r) {
      at += layout_.before;
      const auto n = std::size_t(corners_at(at));
      const std::byte* const list = at + count_bytes;
      at = list + n * index_bytes + layout_.after;
      bool good = n >= 3;
      for (std::size_t i = 0; i < n; ++i) good = index(list + i * index_bytes) < limit && good;
      if (!good) {
        ++batch.bad_faces;
        continue;
      }
      const auto place = [&](std::size_t k) { return vertex(index(list + k * index_bytes)); };
      if (n == 3) {
        batch.triangles.push_back({place(0), place(1), place(2)});
        continue;
      }
      cut.cut(n, place);
      batch.inner_edges.resize(batch.triangles.size());
      for (std::size_t i = 0; i < cut.triangles(); ++i) {
        batch.triangles.push_back(cut.places(cut[i], place));
        batch.inner_edges.push_back(cut.inner_edges(i));
      }
    }
  }

  /// Reads the vertices, or, if there are too many, makes ready to read them one by one.
  void hold_vertices() {
    if (held_ || caches_) return;
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

  [[noreturn]] void fail_here(std::size_t within, const std::string& what) const {
    fail(ErrorCode::bad_input, "{}: byte {}: {}; is the file damaged?", file_->name(), at_ + within, what);
  }
  [[noreturn]] void fail_truncated() const {
    fail(ErrorCode::bad_input, "{}: ends at byte {}, in the middle of its data; the file is truncated", file_->name(),
         file_->size());
  }

  const SceneFilePtr file_;
  const std::uint64_t budget_;
  const bool fans_;
  const Layout layout_;
  std::uint64_t at_, record_ = 0;      // of the next face
  std::unique_ptr<std::byte[]> held_;  // records of all vertices
  std::unique_ptr<Pool<std::unique_ptr<BlockCache>>> caches_;
  RawBatch one_;
};

}  // namespace

RawSourcePtr open_packed_ply(SceneFilePtr file, const SceneOptions& options, const PlyHeader& header) {
  const std::optional<Layout> layout = layout_of(header, file->size());
  return layout ? std::make_unique<PackedPly>(std::move(file), options, *layout) : nullptr;
}

}  // namespace bp
