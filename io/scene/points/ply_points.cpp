#include <array>
#include <bit>
#include <optional>

#include "io/scene/detail/ply/ply_cursor.h"
#include "io/scene/detail/ply/ply_vertices.h"
#include "io/scene/points/scene_points.h"
#include "io/scene/points/text_copy.h"

// PLY: x, y, z of the element "vertex", and nx, ny, nz if they are there. Only these numbers are written anew.

namespace bp {

namespace {

using Three = std::array<std::size_t, 3>;  // numbers of properties

/// The vertices, and the elements before them.
struct VertexElement {
  PlyElement element;
  std::vector<PlyElement> before;
  Three position{};
  std::optional<Three> normal;

  [[nodiscard]] std::size_t offset_of(std::size_t property) const {
    std::size_t offset = 0;
    for (std::size_t k = 0; k < property; ++k) offset += bytes_of(element.properties[k].type);
    return offset;
  }
};

bool is_real(PlyType type) {
  return type == PlyType::f32 || type == PlyType::f64;
}

std::optional<Three> normal_of(const PlyElement& e) {
  const Three normal{e.index_of("nx"), e.index_of("ny"), e.index_of("nz")};
  for (const std::size_t k : normal) {
    if (k == e.properties.size() || !is_real(e.properties[k].type)) return {};
  }
  return normal;
}

VertexElement vertices_of(const PlyHeader& header, const std::string& name) {
  VertexElement v;
  for (const PlyElement& e : header.elements) {
    if (e.name != "vertex") {
      v.before.push_back(e);
      continue;
    }
    if (e.has_lists()) fail(ErrorCode::bad_input, "{}: its vertices have lists, and cannot be moved", name);
    v.element = e;
    const PlyPosition position = ply_position_of(e, name);
    for (std::size_t i = 0; i < 3; ++i) {
      v.position[i] = position.property[i];
      if (!is_real(e.properties[v.position[i]].type))
        fail(ErrorCode::bad_input, "{}: its vertices are whole numbers, and would be rounded", name);
    }
    v.normal = normal_of(e);
    return v;
  }
  fail(ErrorCode::bad_input, "{}: has no vertices", name);
}

void encode_real(std::byte* to, PlyType type, bool swap, double value) {
  if (type == PlyType::f32) {
    auto bits = std::bit_cast<std::uint32_t>(float(value));
    if (swap) bits = __builtin_bswap32(bits);
    std::memcpy(to, &bits, sizeof bits);
  } else {
    auto bits = std::bit_cast<std::uint64_t>(value);
    if (swap) bits = __builtin_bswap64(bits);
    std::memcpy(to, &bits, sizeof bits);
  }
}

/// Returns a cursor at the first vertex, for both kinds of file.
template <class Cursor>
Cursor cursor_at_vertices(const SceneFilePtr& file, const PlyHeader& header, const VertexElement& v) {
  Cursor cursor(file, header);
  for (const PlyElement& e : v.before) {
    if constexpr (std::is_same_v<Cursor, PlyBinaryCursor>) {
      if (!cursor.skip_records(e))
        fail(ErrorCode::bad_input, "{}: its vertices come after lists ('{}'), and cannot be moved", file->name(),
             e.name);
    } else {
      cursor.check_count(e);
      for (std::uint64_t i = 0; i < e.count; ++i) cursor.end_record();
    }
  }
  cursor.check_count(v.element);
  return cursor;
}

class BinaryPlyPoints final : public ScenePoints {
 public:
  BinaryPlyPoints(SceneFilePtr file, const PlyHeader& header)
      : file_(std::move(file)), vertices_(vertices_of(header, file_->name())) {
    const PlyBinaryCursor cursor = cursor_at_vertices<PlyBinaryCursor>(file_, header, vertices_);
    start_ = cursor.mark().offset;
    swap_ = cursor.swap();
    record_ = std::size_t(vertices_.element.fixed_bytes());
  }
  bool read(std::vector<Vec3d>& out) override {
    load(false);
    out = std::move(batch_.positions);
    return !out.empty();
  }
  [[nodiscard]] std::uint64_t count() const override { return vertices_.element.count; }
  void write(const MovePoints& move, OutputFile& out) override {
    TextCopy copy(file_, out);
    done_ = 0;
    std::uint64_t at = start_;
    for (load(true); !batch_.positions.empty(); load(true)) {
      const PointBatch before = batch_;
      move(batch_);
      store(vertices_.position, before.positions, batch_.positions);
      if (vertices_.normal) store(*vertices_.normal, before.normals, batch_.normals);
      copy.replace(at, at + bytes_.size(), std::string(reinterpret_cast<const char*>(bytes_.data()), bytes_.size()));
      at += bytes_.size();
    }
    copy.finish();
  }

 private:
  void load(bool with_normals) {
    const auto n = std::size_t(std::min<std::uint64_t>(kBatch, vertices_.element.count - done_));
    bytes_.resize(n * record_);
    if (file_->read_at(start_ + done_ * record_, bytes_) != bytes_.size())
      fail(ErrorCode::bad_input, "{}: ends within its vertices; the file is truncated", file_->name());
    done_ += n;
    take(vertices_.position, n, batch_.positions);
    take(vertices_.normal.value_or(Three{}), with_normals && vertices_.normal ? n : 0, batch_.normals);
  }
  void take(const Three& property, std::size_t n, std::vector<Vec3d>& out) const {
    out.resize(n);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const PlyType type = vertices_.element.properties[property[axis]].type;
      const std::byte* from = bytes_.data() + vertices_.offset_of(property[axis]);
      for (std::size_t i = 0; i < n; ++i) out[i][axis] = decode_real(from + i * record_, type, swap_);
    }
  }
  void store(const Three& property, const std::vector<Vec3d>& before, const std::vector<Vec3d>& after) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const PlyType type = vertices_.element.properties[property[axis]].type;
      std::byte* to = bytes_.data() + vertices_.offset_of(property[axis]);
      for (std::size_t i = 0; i < after.size(); ++i) {
        if (after[i][axis] != before[i][axis]) encode_real(to + i * record_, type, swap_, after[i][axis]);
      }
    }
  }

  SceneFilePtr file_;
  VertexElement vertices_;
  std::uint64_t start_ = 0, done_ = 0;
  std::size_t record_ = 0;
  bool swap_ = false;
  std::vector<std::byte> bytes_;
  PointBatch batch_;
};

class TextPlyPoints final : public ScenePoints {
 public:
  TextPlyPoints(SceneFilePtr file, const PlyHeader& header)
      : file_(std::move(file)),
        header_(header),
        vertices_(vertices_of(header, file_->name())),
        text_(file_, header.data) {
    (void)cursor_at_vertices<PlyAsciiCursor>(file_, header_, vertices_);
    restart();
  }
  bool read(std::vector<Vec3d>& out) override {
    load();
    out = std::move(batch_.positions);
    return !out.empty();
  }
  [[nodiscard]] std::uint64_t count() const override { return vertices_.element.count; }
  void write(const MovePoints& move, OutputFile& out) override {
    TextCopy copy(file_, out);
    restart();
    for (load(); !batch_.positions.empty(); load()) {
      move(batch_);
      for (const Number& n : numbers_) {
        const Vec3d& moved = n.of_normal ? batch_.normals[n.vertex] : batch_.positions[n.vertex];
        copy.replace(n.place, moved[n.axis], n.is_float);
      }
    }
    copy.finish();
  }

 private:
  struct Number {
    NumberPlace place;
    std::size_t vertex = 0;
    std::uint8_t axis = 0;
    bool of_normal = false, is_float = false;
  };
  void restart() {
    text_.seek(header_.data);
    done_ = 0;
    for (const PlyElement& e : vertices_.before) {
      for (std::uint64_t i = 0; i < e.count; ++i) text_.next_line();
    }
  }
  void load() {
    batch_ = {};
    numbers_.clear();
    for (; done_ < vertices_.element.count && batch_.positions.size() < kBatch; ++done_) load_vertex();
  }
  void load_vertex() {
    const std::size_t vertex = batch_.positions.size();
    batch_.positions.emplace_back();
    if (vertices_.normal) batch_.normals.emplace_back();
    for (std::size_t k = 0; k < vertices_.element.properties.size(); ++k) {
      if (!text_.word_anywhere()) text_.fail_here("the file ends in the middle of its data; it is truncated");
      Number n{{text_.offset(), 0, 0}, vertex, 0, false, vertices_.element.properties[k].type == PlyType::f32};
      if (!is_wanted(k, n)) {
        text_.skip_word();
        continue;
      }
      if (!text_.real(n.place.value)) text_.fail_here("a number was expected; is the file damaged?");
      n.place.end = text_.offset();
      (n.of_normal ? batch_.normals : batch_.positions).back()[n.axis] = n.place.value;
      numbers_.push_back(n);
    }
    text_.next_line();
  }
  [[nodiscard]] bool is_wanted(std::size_t property, Number& n) const {
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      n.axis = axis;
      n.of_normal = vertices_.normal && (*vertices_.normal)[axis] == property;
      if (n.of_normal || vertices_.position[axis] == property) return true;
    }
    return false;
  }

  SceneFilePtr file_;
  PlyHeader header_;
  VertexElement vertices_;
  TextScanner text_;
  std::uint64_t done_ = 0;
  PointBatch batch_;
  std::vector<Number> numbers_;
};

}  // namespace

std::unique_ptr<ScenePoints> ply_points(SceneFilePtr file) {
  const PlyHeader header = read_ply_header(file);
  if (header.format == PlyHeader::Format::ascii) return std::make_unique<TextPlyPoints>(std::move(file), header);
  return std::make_unique<BinaryPlyPoints>(std::move(file), header);
}

}  // namespace bp
