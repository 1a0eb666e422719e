#include <algorithm>
#include <optional>

#include "io/scene/detail/ahead/face_maker.h"
#include "io/scene/detail/ahead/ply_blocks.h"
#include "io/scene/detail/ply/packed_ply.h"
#include "io/scene/detail/ply/ply_cursor.h"
#include "io/scene/detail/ply/ply_vertices.h"
#include "io/scene/detail/vertex_pool.h"
#include "io/scene/raw_source.h"
#include "lib/core/parallel.h"

// PLY (Turk 1994), ASCII and binary of both byte orders. Elements other than vertex, face and tristrips, and properties
// other than x, y, z and the vertex lists, are skipped; if colours are asked for, red, green and blue of vertices and
// faces are read, too. Vertices of a binary file whose records have one size are not loaded at all: they are read in
// place, through a block cache. Elements may come in any order. Files as most programs write them are read faster:
// binary ones by detail/ply/packed_ply.h, others by detail/ahead/ply_blocks.h.

namespace bp {

namespace {

/// Turns a strip into triangles: each corner closes one with the two before it, every other one mirrored.
class Strip {
 public:
  void restart() { length_ = 0; }
  /// Adds a corner; returns true if it closes the triangle now in `corners`.
  bool add(std::uint64_t corner, std::vector<std::uint64_t>& corners) {
    const bool closes = length_ >= 2;
    if (closes && length_ % 2 == 0) corners.assign({a_, b_, corner});
    if (closes && length_ % 2 == 1) corners.assign({b_, a_, corner});
    a_ = b_;
    b_ = corner;
    ++length_;
    return closes;
  }

 private:
  std::uint64_t a_ = 0, b_ = 0, length_ = 0;
};

template <class Cursor>
class PlySource final : public PolygonSource {
 public:
  PlySource(const SceneFilePtr& file, const SceneOptions& options, PlyHeader header)
      : PolygonSource(options),
        header_(std::move(header)),
        has_colors_(options.colors && ply_has_colors(header_)),
        fans_(options.fans),
        cursor_(file, header_) {
    find_parts(file, options);
    rewind_faces();
  }
  bool next(RawBatch& batch) override;
  void complete(RawBatch& batch) const override {
    if (blocks_) blocks_->read_faces(std::size_t(batch.records), *pool_, fans_, batch);
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t(0);

  bool next_face(std::vector<std::uint64_t>& corners) override;
  [[nodiscard]] std::uint64_t vertex_count() const override { return vertex_count_; }
  [[nodiscard]] Vec3d vertex(std::uint64_t i) override { return packed_ ? (*packed_)[i] : (*pool_)[i]; }
  [[nodiscard]] bool has_colors() const override { return has_colors_; }
  [[nodiscard]] Unfollowed unfollowed() const override {
    Unfollowed u;
    u.lines = cursor_.odd_lines();
    const auto shows = [](const PlyElement& e) { return holds_faces(e) && e.count > 0; };
    u.hidden = std::count_if(header_.elements.begin(), header_.elements.end(), shows) > 1 ? 1 : 0;  // one of the kinds
    return u;
  }
  /// Returns the bounds of all vertices where they are loaded: faces seldom leave out those that are farthest out.
  [[nodiscard]] std::optional<Bounds3d> bounds() override {
    return pool_ ? std::optional(loaded_bounds_) : std::nullopt;
  }
  [[nodiscard]] LinearColor corner_color(std::uint64_t i) override {
    if (!vertex_numbers_) return face_color_;
    return vertex_numbers_->color(packed_colors_ ? (*packed_colors_)[i] : (*color_pool_)[i]);
  }
  void rewind_faces() override {
    cursor_.seek(start_);
    element_ = first_;
    record_ = 0;
    strip_left_ = 0;
    block_ = 0;
  }

  void find_parts(const SceneFilePtr& file, const SceneOptions& options);
  void take_vertices(const SceneFilePtr& file, const SceneOptions& options, const PlyElement& element);
  void load_vertices(const PlyElement& element, const PlyPosition& position);
  bool load_in_blocks(const SceneFilePtr& file, const SceneOptions& options, const PlyPosition& position);
  void find_blocks();
  void skip_property(const PlyProperty& p);
  void skip_element(const PlyElement& element);
  std::uint64_t list_size(const PlyProperty& list);
  std::uint64_t corner(const PlyProperty& list);
  void read_face(const PlyElement& element, std::size_t list, std::vector<std::uint64_t>& corners);
  bool next_of_strip(const PlyElement& element, std::size_t list, std::vector<std::uint64_t>& corners);
  void end_strip(const PlyElement& element, std::size_t list);
  static bool holds_faces(const PlyElement& e) { return e.name == "face" || e.name == "tristrips"; }
  static std::size_t vertex_list(const PlyElement& e);

  PlyHeader header_;
  const bool has_colors_, fans_;
  Cursor cursor_;
  std::uint64_t vertex_count_ = 0;
  std::unique_ptr<PlyPackedVertices> packed_;
  std::unique_ptr<VertexPool> pool_;
  std::optional<PlyBlocks> blocks_;                   // if faces may be read in blocks
  std::size_t block_ = 0;                             // the next one
  Bounds3d loaded_bounds_;                            // bounds of the pool
  std::optional<PlyColors> vertex_numbers_;           // set if colours are asked for and present
  std::unique_ptr<PlyPackedVertices> packed_colors_;  // colours, in place as packed_
  std::unique_ptr<VertexPool> color_pool_;            // colours, in memory as pool_
  std::optional<PlyColors> face_numbers_;             // colours of the current element
  LinearColor face_color_;                            // colour of the last face
  typename Cursor::Mark start_{};                     // position of the first element with faces
  std::size_t first_ = kNone;                         // number of that element
  std::size_t element_ = 0;                           // the current element
  std::uint64_t record_ = 0;                          // the next record of that element
  std::uint64_t strip_left_ = 0;                      // indices left in the open strip
  Strip strip_;
};

template <class Cursor>
void PlySource<Cursor>::find_parts(const SceneFilePtr& file, const SceneOptions& options) {
  bool has_vertices = false;
  for (std::size_t i = 0; i < header_.elements.size(); ++i) {
    const PlyElement& element = header_.elements[i];
    cursor_.check_count(element);
    if (first_ == kNone && holds_faces(element)) {
      first_ = i;
      start_ = cursor_.mark();
    }
    if (has_vertices && first_ != kNone) break;
    if (element.name == "vertex" && !has_vertices) {
      has_vertices = true;
      take_vertices(file, options, element);
    } else {
      skip_element(element);
    }
  }
  if (first_ == kNone) first_ = header_.elements.size();  // the file has points only
}

template <class Cursor>
void PlySource<Cursor>::take_vertices(const SceneFilePtr& file, const SceneOptions& options,
                                      const PlyElement& element) {
  const PlyPosition position = ply_position_of(element, file->name());
  vertex_count_ = element.count;
  if (has_colors_) vertex_numbers_ = PlyColors::of(element);
  if constexpr (std::is_same_v<Cursor, PlyBinaryCursor>) {
    if (!element.has_lists()) {
      packed_ = std::make_unique<PlyPackedVertices>(file, options.memory_bytes, cursor_.mark().offset, element,
                                                    position, cursor_.swap());
      if (vertex_numbers_)
        packed_colors_ = std::make_unique<PlyPackedVertices>(file, options.memory_bytes / 2, cursor_.mark().offset,
                                                             element, *vertex_numbers_, cursor_.swap());
      cursor_.skip_records(element);
      return;
    }
  }
  if (load_in_blocks(file, options, position)) return;
  pool_ = std::make_unique<VertexPool>(options.memory_bytes, temp_dir_of(options));
  loaded_bounds_ = {};
  if (vertex_numbers_) color_pool_ = std::make_unique<VertexPool>(options.memory_bytes / 2, temp_dir_of(options));
  load_vertices(element, position);
}

template <class Cursor>
void PlySource<Cursor>::load_vertices(const PlyElement& element, const PlyPosition& position) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Vec3d p{}, rgb{};
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const std::size_t axis = position.axis_of(k), channel = vertex_numbers_ ? vertex_numbers_->axis_of(k) : 3;
      if (axis < 3) {
        p[axis] = cursor_.real(element.properties[k].type);
      } else if (channel < 3) {
        rgb[channel] = cursor_.real(element.properties[k].type);
      } else {
        skip_property(element.properties[k]);
      }
    }
    pool_->push(p);
    loaded_bounds_.add(p);
    if (color_pool_) color_pool_->push(rgb);
    cursor_.end_record();
  }
}

/// Loads the vertices of an ASCII file on all cores, if they come first. Returns false if a line is not plain.
template <class Cursor>
bool PlySource<Cursor>::load_in_blocks(const SceneFilePtr& file, const SceneOptions& options,
                                       const PlyPosition& position) {
  if constexpr (std::is_same_v<Cursor, PlyAsciiCursor>) {
    const PlyElement& vertex = header_.elements[0];
    if (vertex.name != "vertex" || vertex.has_lists() || vertex_numbers_) return false;
    PlyBlocks blocks(file, header_.data);
    pool_ = std::make_unique<VertexPool>(options.memory_bytes, temp_dir_of(options));
    const bool plain = blocks.read_vertices(vertex, position, [&](const std::vector<Vec3d>& vertices) {
      for (const Vec3d& p : vertices) {
        pool_->push(p);
        loaded_bounds_.add(p);
      }
    });
    if (!plain) return false;
    cursor_.seek_behind_blocks(blocks.faces());
    const bool faces_follow = header_.elements.size() == 2 && PlyBlocks::has_plain_form(header_.elements[1]);
    if (faces_follow && !has_colors_ && !pool_->spilled() && thread_count() > 1) blocks_.emplace(std::move(blocks));
    return true;
  }
  return false;
}

/// Reads the faces in blocks if all of them are plain.
template <class Cursor>
bool PlySource<Cursor>::next(RawBatch& batch) {
  if constexpr (std::is_same_v<Cursor, PlyAsciiCursor>) {
    if (blocks_ && blocks_->size() == 0) find_blocks();
  }
  if (!blocks_) return PolygonSource::next(batch);
  return next_block(batch, block_, blocks_->size());
}

template <class Cursor>
void PlySource<Cursor>::find_blocks() {
  const std::optional<TextMark> end = blocks_->find_faces(header_.elements[1]);
  if (!end) return blocks_.reset();
  cursor_.seek(*end);
  cursor_.check_end();
}

template <class Cursor>
void PlySource<Cursor>::skip_property(const PlyProperty& p) {
  cursor_.skip(p.type, p.is_list ? list_size(p) : 1);
}

template <class Cursor>
void PlySource<Cursor>::skip_element(const PlyElement& element) {
  if (element.properties.empty() || cursor_.skip_records(element)) return;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& p : element.properties) skip_property(p);
    cursor_.end_record();
  }
}

template <class Cursor>
std::uint64_t PlySource<Cursor>::list_size(const PlyProperty& list) {
  const std::int64_t size = cursor_.integer(list.count_type);
  if (size < 0)
    cursor_.fail_here(fmt::format("a list '{}' has a size that is not a count; is the file damaged?", list.name));
  return std::uint64_t(size);
}

template <class Cursor>
std::uint64_t PlySource<Cursor>::corner(const PlyProperty& list) {
  const std::int64_t index = cursor_.integer(list.type);
  return index < 0 ? kNoVertex : std::uint64_t(index);
}

template <class Cursor>
std::size_t PlySource<Cursor>::vertex_list(const PlyElement& e) {
  std::size_t i = e.index_of("vertex_indices");
  if (i == e.properties.size()) i = e.index_of("vertex_index");
  return i < e.properties.size() && e.properties[i].is_list ? i : kNone;
}

template <class Cursor>
bool PlySource<Cursor>::next_face(std::vector<std::uint64_t>& corners) {
  for (; element_ < header_.elements.size(); ++element_, record_ = 0) {
    const PlyElement& element = header_.elements[element_];
    const std::size_t list = holds_faces(element) ? vertex_list(element) : kNone;
    if (record_ == 0 && strip_left_ == 0) cursor_.check_count(element);
    if (record_ == 0 && has_colors_) face_numbers_ = PlyColors::of(element);
    if (list == kNone) {
      if (holds_faces(element)) this->bad_faces_ += element.count;  // faces of a kind that is not read
      skip_element(element);
    } else if (element.name == "face" && record_ < element.count) {
      ++record_;
      read_face(element, list, corners);
      return true;
    } else if (element.name == "tristrips" && next_of_strip(element, list, corners)) {
      return true;
    }
  }
  if (first_ < header_.elements.size()) cursor_.check_end();
  return false;
}

template <class Cursor>
void PlySource<Cursor>::read_face(const PlyElement& element, std::size_t list, std::vector<std::uint64_t>& corners) {
  corners.clear();
  Vec3d rgb{};
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& p = element.properties[k];
    const std::size_t channel = face_numbers_ ? face_numbers_->axis_of(k) : 3;
    if (channel < 3) {
      rgb[channel] = cursor_.real(p.type);
      continue;
    }
    if (k != list) {
      skip_property(p);
      continue;
    }
    const std::uint64_t size = list_size(p);
    if (size > kMaxCorners) cursor_.fail_here(fmt::format("a face of {} corners; is the file damaged?", size));
    for (std::uint64_t i = 0; i < size; ++i) corners.push_back(corner(p));
  }
  face_color_ = face_numbers_ ? face_numbers_->color(rgb) : kWhite;
  cursor_.end_record();
}

// Reads one triangle at a time: a strip may be as long as the file.
template <class Cursor>
bool PlySource<Cursor>::next_of_strip(const PlyElement& element, std::size_t list,
                                      std::vector<std::uint64_t>& corners) {
  for (;;) {
    while (strip_left_ > 0) {
      const std::int64_t index = cursor_.integer(element.properties[list].type);
      const bool closes = index >= 0 && strip_.add(std::uint64_t(index), corners);
      if (index < 0) strip_.restart();
      if (--strip_left_ == 0) end_strip(element, list);
      if (closes) return true;
    }
    if (record_ == element.count) return false;
    ++record_;
    for (std::size_t k = 0; k < list; ++k) skip_property(element.properties[k]);
    strip_left_ = list_size(element.properties[list]);
    strip_.restart();
    if (strip_left_ == 0) end_strip(element, list);
  }
}

template <class Cursor>
void PlySource<Cursor>::end_strip(const PlyElement& element, std::size_t list) {
  for (std::size_t k = list + 1; k < element.properties.size(); ++k) skip_property(element.properties[k]);
  cursor_.end_record();
}

}  // namespace

RawSourcePtr open_ply(SceneFilePtr file, const SceneOptions& options) {
  PlyHeader header = read_ply_header(file);
  if (header.format == PlyHeader::Format::ascii)
    return std::make_unique<PlySource<PlyAsciiCursor>>(file, options, std::move(header));
  // The packed reader knows no colours, and tells of no odd lines.
  const bool packs = !(options.colors && ply_has_colors(header)) && header.ends.odd() + header.odd_lines == 0;
  if (RawSourcePtr packed = packs ? open_packed_ply(file, options, header) : nullptr) return packed;
  return std::make_unique<PlySource<PlyBinaryCursor>>(file, options, std::move(header));
}

}  // namespace bp
