#include "io/scene/detail/ply/packed_ply.h"

#include <algorithm>

#include "io/scene/detail/ply/packed_layout.h"
#include "io/scene/detail/ply/packed_vertices.h"
#include "io/scene/detail/ply/ply_cursor.h"

namespace bp {

namespace {

/// Calls body(list, n) for each record of a batch: its list of n indices.
template <class Body>
void for_each_face(const PackedLayout& layout, const RawBatch& batch, const Body& body) {
  const std::size_t count_bytes = bytes_of(layout.count_type), index_bytes = bytes_of(layout.index_type);
  const std::byte* at = batch.bytes.data();
  for (std::uint64_t r = 0; r < batch.records; ++r) {
    at += layout.before;
    const auto n = std::size_t(layout.corners_at(at));
    const std::byte* const list = at + count_bytes;
    at = list + n * index_bytes + layout.after;
    body(list, n);
  }
}

/// Makes triangles as PolygonSource does.
template <class Index, class Vertex>
void expand(const PackedLayout& layout, bool fans, RawBatch& batch, const Index& index, const Vertex& vertex) {
  const std::size_t index_bytes = bytes_of(layout.index_type);
  const std::uint64_t limit = layout.vertex_count;
  FaceTriangles cut(fans);
  std::size_t made = 0;
  for_each_face(layout, batch, [&](const std::byte* list, std::size_t n) {
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

void skip_lists(PlyBinaryCursor& cursor, const PlyElement& element) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& p : element.properties) {
      const std::int64_t n = p.is_list ? cursor.integer(p.count_type) : 1;
      if (n < 0) cursor.fail_here("a list has a size that is not a count; is the file damaged?");
      cursor.skip(p.type, std::uint64_t(n));
    }
  }
}

class PackedPly final : public TwoStepSource {
 public:
  PackedPly(SceneFilePtr file, const SceneOptions& options, const PackedLayout& layout, PlyHeader header)
      : file_(std::move(file)),
        header_(std::move(header)),
        fans_(options.fans),
        layout_(layout),
        vertices_(file_, layout_, options.memory_bytes),
        at_(layout.faces) {}

  [[nodiscard]] std::uint64_t points() const override { return layout_.vertex_count; }
  [[nodiscard]] std::optional<Bounds3d> bounds() override { return vertices_.bounds(); }

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
      if (batch.records == 0 && batch.bytes.size() < want) fail_truncated(*file_);
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
      const std::int64_t n = layout_.corners_at(batch.bytes.data() + at + layout_.before);
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

  template <class Index>
  void complete(RawBatch& batch, const Index& index) const {
    const std::size_t index_bytes = bytes_of(layout_.index_type);
    std::uint64_t first = layout_.vertex_count, end = 0;
    for_each_face(layout_, batch, [&](const std::byte* list, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) {
        const std::uint64_t i = index(list + k * index_bytes);
        if (i >= layout_.vertex_count) continue;
        first = std::min(first, i);
        end = std::max(end, i + 1);
      }
    });
    vertices_.visit({first, end}, batch.count * sizeof(TriangleD), batch.vertices,
                    [&](const auto& vertex) { expand(layout_, fans_, batch, index, vertex); });
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

  [[noreturn]] void fail_here(std::size_t within, const std::string& what) const {
    fail(ErrorCode::bad_input, "{}: byte {}: {}; is the file damaged?", file_->name(), at_ + within, what);
  }

  const SceneFilePtr file_;
  const PlyHeader header_;
  const bool fans_;
  const PackedLayout layout_;
  PackedVertices vertices_;
  std::uint64_t at_, record_ = 0;  // of the next face
};

}  // namespace

RawSourcePtr open_packed_ply(SceneFilePtr file, const SceneOptions& options, const PlyHeader& header) {
  const std::optional<PackedLayout> layout = packed_layout_of(header, file->size());
  return layout ? std::make_unique<PackedPly>(std::move(file), options, *layout, header) : nullptr;
}

}  // namespace bp
