#include <algorithm>
#include <optional>

#include "io/scene/detail/ahead/face_maker.h"
#include "io/scene/detail/ahead/obj_blocks.h"
#include "io/scene/detail/obj/obj_look.h"
#include "io/scene/detail/obj/obj_parts.h"
#include "io/scene/detail/obj/obj_vectors.h"
#include "io/scene/detail/text/text_scanner.h"
#include "io/scene/raw_source.h"

// Wavefront OBJ: the lines "v" and "f" ("fo"). A free-form surface, and another file that is called, count as a face
// that cannot be read; everything else is skipped. A vertex, or a face, of another form than nearly all programs write
// is read and counted, since others read it in other ways. If colours or walls are asked for, "usemtl" and "mtllib" are
// read, too, and the three numbers after a vertex' position (an extension of many programs). One pass streams faces
// while the vertices before them are added to the pool. A face that names a later vertex makes all other vertices load
// at once, so that a vertex is called missing only if the file does not have it. If the bounds were asked for, all
// vertices are known before the first face, and the faces of a file with plain lines only are read on all cores.

namespace bp {

namespace {

class ObjSource final : public PolygonSource {
 public:
  ObjSource(const SceneFilePtr& file, const SceneOptions& options)
      : PolygonSource(options),
        file_(file),
        text_(file),
        fans_(options.fans),
        walls_only_(options.walls_only),
        vectors_(file, options),
        look_(file, options),
        parts_(options) {}
  [[nodiscard]] bool has_colors() const override { return vectors_.has_colors || look_.has_colors(); }
  [[nodiscard]] bool has_textures() const override { return look_.has_textures(); }
  [[nodiscard]] std::optional<Bounds3d> bounds() override;
  bool next(RawBatch& batch) override {
    return blocks_ ? next_block(batch, block_, blocks_->size()) : PolygonSource::next(batch);
  }
  void complete(RawBatch& batch) const override {
    if (blocks_) blocks_->read_faces(std::size_t(batch.records), vectors_.vertices, fans_, batch);
  }

 private:
  bool next_face(std::vector<std::uint64_t>& corners) override;
  [[nodiscard]] std::uint64_t vertex_count() const override { return vectors_.vertices.size(); }
  [[nodiscard]] Vec3d vertex(std::uint64_t i) override { return vectors_.vertices[i]; }
  [[nodiscard]] LinearColor corner_color(std::uint64_t i) override {
    const bool has_own = vectors_.colors && i < vectors_.colors->size();
    return has_own ? color_from_srgb((*vectors_.colors)[i]) : look_.color();
  }
  [[nodiscard]] std::uint32_t face_material() const override { return look_.texture(); }
  [[nodiscard]] std::array<float, 2> corner_uv(std::size_t k) override;
  [[nodiscard]] PackedNormal corner_normal(std::size_t k) override;
  [[nodiscard]] std::uint64_t lines() const override { return lines_; }
  [[nodiscard]] Unfollowed unfollowed() const override {
    Unfollowed u;
    u.lines = text_.odd_lines();
    u.hidden = elements_ > 0 ? 1 : 0;  // some programs draw the faces beside them as lines or points
    return u;
  }
  void rewind_faces() override {
    lines_ = elements_ = 0;
    block_ = 0;
    text_.seek({});
    vectors_.rewind();
    look_.rewind();
    parts_.rewind();
  }

  /// Moves to the next line. For some programs it belongs to this one, if that goes on where nothing was read, as in a
  /// comment.
  void end_line() {
    const std::uint64_t line = text_.line();
    if (text_.next_line()) text_.doubt(line);
  }
  void use_name(char key);
  void read_corners(std::vector<std::uint64_t>& corners);
  void check_last_line(const std::vector<std::uint64_t>& corners);

  SceneFilePtr file_;
  TextScanner text_;
  const bool fans_, walls_only_;
  ObjVectors vectors_;
  ObjLook look_;
  ObjParts parts_;
  std::optional<ObjBlocks> blocks_;                            // if faces are read in blocks
  std::size_t block_ = 0;                                      // the next one
  std::vector<std::uint64_t> corner_places_, corner_normals_;  // of the face; kNoVertex: none
  std::uint64_t lines_ = 0, elements_ = 0;                     // of this pass: lines "l"; lines "l" and "p"
};

bool ObjSource::next_face(std::vector<std::uint64_t>& corners) {
  for (; !text_.at_end(); end_line()) {
    if (!text_.word_on_line()) continue;
    const char key = obj_keyword(text_);
    const bool is_shown = !look_.is_passed_over() && parts_.is_wanted();
    if (key == 'v' || key == 't' || key == 'n') {
      vectors_.read(key, text_);
    } else if (key == 'u' || key == 'm' || key == 'o' || key == 'g') {
      use_name(key);
    } else if (key == 'l' || key == 'p') {
      lines_ += key == 'l' ? 1 : 0;
      ++elements_;
    } else if (key == '1') {
      text_.doubt();
    } else if (key == 's' && is_shown) {
      corners.clear();  // a face without corners
      end_line();
      return true;
    } else if (key == 'f' && is_shown) {
      read_corners(corners);
      check_last_line(corners);
      if (parts_.filter().asks_for_triangles()) parts_.note(corners, vectors_.vertices);
      end_line();
      return true;
    }
  }
  vectors_.all_loaded = true;
  return false;
}

void ObjSource::use_name(char key) {
  const bool asks = parts_.filter().asks();
  if (!asks && (key == 'o' || key == 'g')) return;
  const std::string name = text_.rest_of_line();
  if (asks && key != 'm') parts_.use(key, name);
  if (key == 'm') look_.load(name, text_);
  if (key == 'u') look_.use(name);
}

/// Returns the bounds of all vertices: faces seldom leave out those that are farthest out. The pool then holds all
/// vertices before the first face.
std::optional<Bounds3d> ObjSource::bounds() {
  VertexPool& pool = vectors_.vertices;
  if (vectors_.colors || !parts_.filter().takes_all() || pool.size() > 0) return {};
  Bounds3d all;
  ObjBlocks blocks(file_);
  vectors_.all_loaded = blocks.read_vertices([&](const std::vector<Vec3d>& vertices) {
    for (const Vec3d& p : vertices) {
      pool.push(p);
      all.add(p);
    }
  });
  if (blocks.has_plain_faces() && !pool.spilled() && !walls_only_ && !parts_.filter().asks())
    blocks_.emplace(std::move(blocks));
  return vectors_.all_loaded ? std::optional(all) : std::nullopt;
}

PackedNormal ObjSource::corner_normal(std::size_t k) {
  const std::uint64_t i = k < corner_normals_.size() ? corner_normals_[k] : kNoVertex;
  return vectors_.normals && i < vectors_.normals->size() ? pack_normal((*vectors_.normals)[i]) : 0;
}

std::array<float, 2> ObjSource::corner_uv(std::size_t k) {
  const std::uint64_t i = k < corner_places_.size() ? corner_places_[k] : kNoVertex;
  if (i >= vectors_.places->size()) return {};
  const Vec3d place = (*vectors_.places)[i];
  return look_.place(place[0], place[1]);
}

void ObjSource::read_corners(std::vector<std::uint64_t>& corners) {
  corners.clear();
  corner_places_.clear();
  corner_normals_.clear();
  while (text_.word_on_line() && text_.peek() != '#') {
    const ObjCorner corner = read_obj_corner(text_, vectors_.seen());
    if (look_.texture() != TriangleTexture::kNoMaterial || vectors_.normals) corner_places_.push_back(corner.place);
    if (vectors_.normals) corner_normals_.push_back(corner.normal);
    if (corners.size() == kMaxCorners)
      text_.fail_here("a face of more than {} corners; is the file intact?", kMaxCorners);
    corners.push_back(vectors_.vertex_of(corner.vertex, text_));
  }
  if (text_.peek() == '#') text_.doubt();  // some programs read the numbers of a comment
}

/// Checks a face on a last line without a line end. Many good files lack that end: only a face that cannot be whole
/// tells that the file was cut off.
void ObjSource::check_last_line(const std::vector<std::uint64_t>& corners) {
  if (!text_.at_end()) return;
  const bool whole = std::all_of(corners.begin(), corners.end(), [&](std::uint64_t i) { return i < vertex_count(); });
  if (corners.size() < 3 || !whole) text_.fail_here("the file ends in the middle of its data; it is truncated");
}

}  // namespace

RawSourcePtr open_obj(SceneFilePtr file, const SceneOptions& options) {
  return std::make_unique<ObjSource>(file, options);
}

}  // namespace bp
