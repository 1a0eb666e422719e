#include <algorithm>
#include <cstring>
#include <mutex>

#include "io/files/lower.h"
#include "io/scene/byte_stream.h"
#include "io/scene/detail/ahead/stl_blocks.h"
#include "io/scene/detail/text/text_scanner.h"
#include "io/scene/raw_source.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"

// STL, ASCII and binary. Many binary files start with "solid", too, so the size decides first: 84 bytes and 50 for each
// of the triangles that bytes 80 to 83 promise. Words count only after that: "solid", and a "facet" or an "endsolid"
// near the start.

namespace bp {

namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50;

static_assert(std::endian::native == std::endian::little, "binary STL is decoded in place");

class BinaryStl final : public TwoStepSource {
 public:
  BinaryStl(SceneFilePtr file, std::uint64_t triangles) : file_(std::move(file)), triangles_(triangles) {
    const std::uint64_t room = (file_->size() - kHeaderBytes) / kTriangleBytes;
    if (triangles < room) {  // other readers use the size
      fail(ErrorCode::bad_input,
           "{}: the number of triangles in its header is {}, and it holds {}; the file is damaged", file_->name(),
           triangles, room);
    }
    if (triangles > room) {
      fail(ErrorCode::bad_input,
           "{}: the number of triangles in its header is {}, and it has room for {}; the file is truncated",
           file_->name(), triangles, room);
    }
    check_data_end(*file_, kHeaderBytes + triangles_ * kTriangleBytes);
  }
  bool next(RawBatch& batch) override {
    batch.bad_faces = 0;
    batch.records = std::min<std::uint64_t>(kBatch, triangles_ - next_);
    fetch(next_, batch);
    next_ += batch.records;
    return batch.records > 0;
  }
  void complete(RawBatch& batch) const override {
    batch.triangles.resize(batch.records);
    const std::byte* record = batch.bytes.data();
    for (TriangleD& t : batch.triangles) {
      t = decode(record);
      record += kTriangleBytes;
    }
  }
  [[nodiscard]] std::optional<Bounds3d> bounds() override {
    Bounds3d all;
    std::mutex mutex;
    parallel_ranges(std::int64_t(triangles_), std::int64_t(kBatch), [&](std::int64_t begin, std::int64_t end) {
      RawBatch batch;
      batch.records = std::uint64_t(end - begin);
      fetch(std::uint64_t(begin), batch);
      Bounds3d part;
      for (std::uint64_t i = 0; i < batch.records; ++i) {
        for (const Vec3d& p : decode(batch.bytes.data() + i * kTriangleBytes)) part.add(p);
      }
      const std::lock_guard lock(mutex);
      all.merge(part);
    });
    return all;
  }
  void rewind() override { next_ = 0; }

 private:
  static TriangleD decode(const std::byte* record) {
    float c[9];
    std::memcpy(c, record + 12, sizeof c);  // after the normal
    return {{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}}};
  }
  void fetch(std::uint64_t first, RawBatch& batch) const {
    batch.bytes.resize(std::size_t(batch.records) * kTriangleBytes);
    if (file_->read_at(kHeaderBytes + first * kTriangleBytes, batch.bytes) < batch.bytes.size())
      fail(ErrorCode::bad_input, "{}: ends in the middle of its data; the file is truncated", file_->name());
  }
  const SceneFilePtr file_;
  const std::uint64_t triangles_;
  std::uint64_t next_ = 0;
};

/// A plain file is read on all cores, in blocks.
class AsciiStl final : public RawSource {
 public:
  explicit AsciiStl(const SceneFilePtr& file) : text_(file), blocks_(file) { rewind(); }
  bool read(std::vector<TriangleD>& out) override;
  bool next(RawBatch& batch) override;
  void complete(RawBatch& batch) const override {
    if (*has_blocks_) blocks_.read(std::size_t(batch.records), batch.triangles);
  }
  [[nodiscard]] std::optional<Bounds3d> bounds() override {
    const std::optional<Bounds3d> all = blocks_.find();
    has_blocks_ = all.has_value();
    return all;
  }
  void rewind() override {
    block_ = 0;
    text_.seek({});
    in_solid_ = in_facet_ = false;
    corners_ = facet_corners_ = 0;
    bad_faces_ = 0;
  }
  [[nodiscard]] Unfollowed unfollowed() const override {
    Unfollowed u;
    u.lines = text_.odd_lines();
    return u;
  }

 private:
  void statement(std::string_view word, std::vector<TriangleD>& out);
  void read_vertex(std::vector<TriangleD>& out);
  void begin_or_end_solid(bool begins);
  void begin_facet();
  void end_facet();
  void end_polygon();
  void skip_name();

  TextScanner text_;
  StlBlocks blocks_;
  std::optional<bool> has_blocks_;  // whether the file is plain, once it is known
  std::size_t block_ = 0;           // the next one
  bool in_solid_ = false, in_facet_ = false;
  std::uint64_t corners_ = 0;        // corners of the open polygon
  std::uint64_t facet_corners_ = 0;  // of the open facet, or since the last one
  Vec3d first_{}, previous_{};
};

bool AsciiStl::next(RawBatch& batch) {
  if (!has_blocks_) has_blocks_ = thread_count() > 1 && blocks_.find().has_value();
  if (!*has_blocks_) return RawSource::next(batch);
  batch.bad_faces = 0;
  batch.records = block_;
  return block_++ < blocks_.size();
}

bool AsciiStl::read(std::vector<TriangleD>& out) {
  out.clear();
  while (out.size() < kBatch) {
    if (!text_.word_anywhere()) {
      if (in_solid_) text_.fail_here("the file ends before 'endsolid'; it is truncated");
      end_facet();
      break;
    }
    // The most frequent word of the file is compared without a copy.
    const std::string_view word = text_.word();
    if (word == "vertex") {
      read_vertex(out);
    } else {
      statement(word, out);
    }
  }
  return !out.empty();
}

void AsciiStl::statement(std::string_view raw, std::vector<TriangleD>& out) {
  const std::string word = lower(raw);
  if (word != raw) text_.doubt();  // some programs know lower case only
  if (word == "vertex") return read_vertex(out);
  if (word == "facet") return begin_facet();
  if (word == "outer") {
    if (corners_ > 0) end_polygon();
    if (text_.word_anywhere() && text_.word() != "loop") text_.doubt();
    return;
  }
  if (word == "endloop") return end_polygon();
  if (word == "endfacet") {
    if (!in_facet_) text_.doubt();
    return end_facet();
  }
  if (word == "solid" || word == "endsolid" || word == "color") {  // a name of any number of words follows
    if (word != "color") begin_or_end_solid(word == "solid");
    return skip_name();
  }
  text_.fail_here("'{}' does not belong into an ASCII STL file; is the file damaged?", word);
}

void AsciiStl::begin_or_end_solid(bool begins) {
  if (in_facet_) text_.doubt();  // some programs pass over a facet that does not end
  end_facet();
  in_solid_ = begins;
}

/// Begins a facet and skips "normal x y z". Some programs pass over a facet outside of a solid, or behind one that does
/// not end.
void AsciiStl::begin_facet() {
  constexpr int kNumbers = 3;
  bool is_odd = in_facet_ || !in_solid_;
  end_facet();
  in_facet_ = true;
  is_odd = !text_.word_anywhere() || text_.word() != "normal" || is_odd;
  for (int i = 0; i < kNumbers && text_.word_anywhere(); ++i) {
    is_odd = is_odd || !begins_number(text_.peek());
    text_.skip_word();
  }
  if (is_odd) text_.doubt();
}

/// Ends a facet. Other programs make a triangle of every three corners.
void AsciiStl::end_facet() {
  if (corners_ > 0) end_polygon();
  if (facet_corners_ != (in_facet_ ? 3 : 0)) text_.doubt();
  facet_corners_ = 0;
  in_facet_ = false;
}

void AsciiStl::end_polygon() {
  if (corners_ < 3) ++bad_faces_;
  corners_ = 0;
}

/// Moves to the next line. Some programs read the statements in a name.
void AsciiStl::skip_name() {
  std::string name;
  const std::uint64_t line = text_.line();
  for (; !text_.at_end() && text_.peek() != '\n' && text_.peek() != '\r'; text_.step()) {
    if (name.size() <= kLongestName) name += text_.peek();
  }
  (void)text_.next_line();
  if (names_facets(name)) text_.doubt(line);
}

void AsciiStl::read_vertex(std::vector<TriangleD>& out) {
  Vec3d p;
  for (double& c : p) {
    if (!text_.word_anywhere() || !text_.real(c)) text_.fail_here("a vertex needs three numbers; is the file damaged?");
  }
  if (corners_ == 0) first_ = p;
  if (corners_ >= 2) out.push_back({first_, previous_, p});
  previous_ = p;
  ++corners_;
  ++facet_corners_;
}

bool looks_ascii(const std::string& start) {
  const std::size_t word = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (word == std::string::npos || start.compare(word, 5, "solid") != 0 || start.find('\0') != std::string::npos)
    return false;
  return start.find("facet") != std::string::npos || start.find("endsolid") != std::string::npos;
}

}  // namespace

RawSourcePtr open_stl(SceneFilePtr file, const SceneOptions&) {
  std::string start(1024, '\0');
  start.resize(file->read_at(0, std::as_writable_bytes(std::span(start))));
  std::uint32_t triangles = 0;
  const bool has_header = start.size() >= kHeaderBytes;
  if (has_header) std::memcpy(&triangles, start.data() + 80, sizeof triangles);
  const bool fits = has_header && kHeaderBytes + kTriangleBytes * std::uint64_t(triangles) == file->size();
  if (!fits && looks_ascii(lower(start))) return std::make_unique<AsciiStl>(file);
  if (!has_header) {
    fail(ErrorCode::bad_input, "{}: of {} bytes is neither an ASCII nor a binary STL file; is it complete?",
         file->name(), file->size());
  }
  return std::make_unique<BinaryStl>(file, triangles);
}

}  // namespace bp
