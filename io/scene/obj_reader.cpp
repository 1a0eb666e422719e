#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

#include "io/scene/detail/ahead/face_maker.h"
#include "io/scene/detail/ahead/obj_blocks.h"
#include "io/scene/detail/mtl_file.h"
#include "io/scene/detail/text/text_scanner.h"
#include "io/scene/detail/vertex_pool.h"
#include "io/scene/part_names.h"
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
        pool_(options.memory_bytes, temp_dir_of(options)),
        materials_(options.document),
        walls_only_(options.walls_only),
        details_(options.details),
        parts_(options.parts, options.part_names) {
    if (options.colors) vertex_colors_.emplace(options.memory_bytes / 2, temp_dir_of(options));
    if (options.textures) places_.emplace(options.memory_bytes / 2, temp_dir_of(options));
    if (options.textures && options.surface) normals_.emplace(options.memory_bytes / 2, temp_dir_of(options));
    textures_ = options.textures;
  }
  [[nodiscard]] bool has_colors() const override { return has_colors_; }
  [[nodiscard]] bool has_textures() const override { return has_textures_; }
  [[nodiscard]] std::optional<Bounds3d> bounds() override;
  bool next(RawBatch& batch) override;
  void complete(RawBatch& batch) const override {
    if (blocks_) blocks_->read_faces(std::size_t(batch.records), pool_, fans_, batch);
  }

 private:
  bool next_face(std::vector<std::uint64_t>& corners) override;
  [[nodiscard]] std::uint64_t vertex_count() const override { return pool_.size(); }
  [[nodiscard]] Vec3d vertex(std::uint64_t i) override { return pool_[i]; }
  [[nodiscard]] LinearColor corner_color(std::uint64_t i) override;
  [[nodiscard]] std::uint32_t face_material() const override { return texture_; }
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
    seen_ = {};
    texture_ = TriangleTexture::kNoMaterial;
    materials_.clear();
    material_name_.clear();
    material_ = kWhite;
    passed_over_ = false;
    fits_ = {};
    names_ = {};
  }

  /// Consumes the keyword. Returns 'v', 'f', 'l', 'p', 'o' or 'g' for these words, 't' for "vt", 'n' for "vn", 's' for
  /// those of adds_unread_surface(), '1' for is_glued(), 'u' for "usemtl" and 'm' for "mtllib", 0 for any other,
  /// comments included.
  static char keyword(TextScanner& text);
  /// Moves to the next line. For some programs it belongs to this one, if that goes on where nothing was read, as in a
  /// comment.
  void end_line() {
    const std::uint64_t line = text_.line();
    if (text_.next_line()) text_.doubt(line);
  }
  [[nodiscard]] bool is_wanted() const { return parts_.takes_all() || fits_.object || fits_.group || fits_.material; }
  void read_vertex(TextScanner& text);
  void read_vertex_rest(TextScanner& text);
  static void read_vector(TextScanner& text, std::size_t numbers, VertexPool& pool);
  void use_material(char key, const std::string& name);
  void load_materials(const std::string& name);
  void use_name(char key, const std::string& name);
  void note_part(const std::vector<std::uint64_t>& corners);
  void read_corners(std::vector<std::uint64_t>& corners);
  void check_last_line(const std::vector<std::uint64_t>& corners);
  void read_corner_rest();
  std::uint64_t read_number_before(std::uint64_t seen);
  std::uint64_t resolve(std::int64_t index);
  void load_ahead();

  SceneFilePtr file_;
  TextScanner text_;
  const bool fans_;
  VertexPool pool_;
  std::optional<ObjBlocks> blocks_;          // if faces are read in blocks
  std::size_t block_ = 0;                    // the next one
  std::optional<VertexPool> vertex_colors_;  // if colours are asked for; up to the last vertex that has one
  std::optional<VertexPool> places_;         // "vt" lines, if asked for
  std::optional<VertexPool> normals_;        // "vn" lines, if asked for
  std::vector<std::uint64_t> corner_places_, corner_normals_;  // of the face; kNoVertex: none
  std::shared_ptr<TextureTable> textures_;
  MtlMaterials materials_;
  std::string material_name_;
  std::uint32_t texture_ = TriangleTexture::kNoMaterial;  // of material_name_
  LinearColor material_;
  bool has_colors_ = false, has_textures_ = false;
  const bool walls_only_, details_;
  const PartFilter parts_;
  struct {
    bool object = false, group = false, material = false;
  } fits_;  // which names of the next faces fit parts_
  struct {
    // Part: name of the last line "o" or "g", of which a group in an object tells more; material: of "usemtl".
    std::string part, material;
  } names_;
  bool passed_over_ = false;    // faces of the current material are left out
  ObjLines seen_;               // of this pass
  std::uint64_t lines_ = 0;     // lines "l" of this pass
  std::uint64_t elements_ = 0;  // lines "l" and "p" of this pass
  bool all_loaded_ = false;     // the pool holds every vertex of the file
};

bool ObjSource::next_face(std::vector<std::uint64_t>& corners) {
  for (; !text_.at_end(); end_line()) {
    if (!text_.word_on_line()) continue;
    const char key = keyword(text_);
    if (key == 'v') {
      if (seen_.vertices == pool_.size()) read_vertex(text_);
      ++seen_.vertices;
    } else if (key == 't') {
      if (places_ && seen_.places == places_->size()) read_vector(text_, 2, *places_);
      ++seen_.places;
    } else if (key == 'n') {
      if (normals_ && seen_.normals == normals_->size()) read_vector(text_, 3, *normals_);
      ++seen_.normals;
    } else if (key == 'u' || key == 'm' || (parts_.asks() && (key == 'o' || key == 'g'))) {
      const std::string name = text_.rest_of_line();
      if (parts_.asks() && key != 'm') use_name(key, name);
      if (key == 'u' || key == 'm') use_material(key, name);
    } else if (key == 'l' || key == 'p') {
      lines_ += key == 'l' ? 1 : 0;
      ++elements_;
    } else if (key == '1') {
      text_.doubt();
    } else if (key == 's' && !passed_over_ && is_wanted()) {
      corners.clear();  // a face without corners
      end_line();
      return true;
    } else if (key == 'f' && !passed_over_ && is_wanted()) {
      read_corners(corners);
      check_last_line(corners);
      if (parts_.asks_for_triangles()) note_part(corners);
      end_line();
      return true;
    }
  }
  all_loaded_ = true;
  return false;
}

char ObjSource::keyword(TextScanner& text) {
  const char first = text.peek();
  const bool is_ascii = static_cast<unsigned char>(first) < 0x80;
  if (is_ascii && std::string_view("vfumogslcbrp").find(first) == std::string_view::npos) return 0;
  const std::string_view word = text.word();
  if (word == "vt") return 't';
  if (word == "vn") return 'n';
  if (word == "fo") return 'f';  // its name in version 2
  if (is_glued(word)) return '1';
  if (std::string_view("scbr").find(first) != std::string_view::npos) return adds_unread_surface(word) ? 's' : 0;
  return word.size() == 1 || word == "usemtl" || word == "mtllib" ? first : 0;
}

/// Returns the bounds of all vertices: faces seldom leave out those that are farthest out. The pool then holds all
/// vertices before the first face.
std::optional<Bounds3d> ObjSource::bounds() {
  if (vertex_colors_ || !parts_.takes_all() || pool_.size() > 0) return {};
  Bounds3d all;
  ObjBlocks blocks(file_);
  all_loaded_ = blocks.read_vertices([&](const std::vector<Vec3d>& vertices) {
    for (const Vec3d& p : vertices) {
      pool_.push(p);
      all.add(p);
    }
  });
  if (blocks.has_plain_faces() && !pool_.spilled() && !walls_only_ && !parts_.asks())
    blocks_.emplace(std::move(blocks));
  return all_loaded_ ? std::optional(all) : std::nullopt;
}

bool ObjSource::next(RawBatch& batch) {
  if (!blocks_) return PolygonSource::next(batch);
  return next_block(batch, block_, blocks_->size());
}

void ObjSource::read_vertex(TextScanner& text) {
  Vec3d p;
  for (double& c : p) {
    if (!text.word_on_line() || !text.real(c)) text.fail_here("a vertex needs three numbers; is the file damaged?");
  }
  pool_.push(p);
  if (text.has_more()) read_vertex_rest(text);
}

// Reads what follows a position: a colour, or the weight of a rational curve's point. Some programs divide by a weight,
// and drop a vertex with other words behind it.
void ObjSource::read_vertex_rest(TextScanner& text) {
  double rest[4];
  std::size_t n = 0;
  while (n < std::size(rest) && text.has_more() && text.real(rest[n])) ++n;
  const bool is_known = n >= 3 || (n == 1 && rest[0] == 1);
  if (!is_known || text.has_more()) text.doubt();
  if (n < 3 || !vertex_colors_) return;
  while (vertex_colors_->size() + 1 < pool_.size()) vertex_colors_->push({1, 1, 1});
  vertex_colors_->push({rest[0], rest[1], rest[2]});
  has_colors_ = true;
}

/// Reads a vector; missing numbers are 0.
void ObjSource::read_vector(TextScanner& text, std::size_t numbers, VertexPool& pool) {
  Vec3d v{};
  for (std::size_t i = 0; i < numbers; ++i) {
    if (!text.word_on_line() || !text.real(v[i])) break;
  }
  pool.push(v);
}

PackedNormal ObjSource::corner_normal(std::size_t k) {
  const std::uint64_t i = k < corner_normals_.size() ? corner_normals_[k] : kNoVertex;
  return normals_ && i < normals_->size() ? pack_normal((*normals_)[i]) : 0;
}

std::array<float, 2> ObjSource::corner_uv(std::size_t k) {
  const std::uint64_t i = k < corner_places_.size() ? corner_places_[k] : kNoVertex;
  if (i >= places_->size()) return {};
  const Vec3d place = (*places_)[i];
  return materials_.place(material_name_, place[0], place[1]);
}

LinearColor ObjSource::corner_color(std::uint64_t i) {
  if (vertex_colors_ && i < vertex_colors_->size()) return color_from_srgb((*vertex_colors_)[i]);
  return material_;
}

void ObjSource::use_material(char key, const std::string& name) {
  if (!vertex_colors_ && !walls_only_) return;
  if (key == 'm') return load_materials(name);
  material_name_ = name;
  if (textures_) texture_ = materials_.texture(name, *textures_, normals_.has_value(), details_);
  has_textures_ = has_textures_ || (textures_ && materials_.has_image(name));
  passed_over_ = walls_only_ && materials_.see_through(name);
  if (!vertex_colors_) return;
  material_ = materials_.color(name, normals_.has_value());
  has_colors_ = has_colors_ || material_ != kWhite;
}

/// Loads a file of materials. If the materials do not fit, those of files named later are counted, too, so that the
/// message has the right number.
void ObjSource::load_materials(const std::string& name) {
  materials_.load(file_->path(), name);
  if (materials_.fit()) return;
  TextScanner ahead(file_, text_.mark());
  for (ahead.next_line(); !ahead.at_end(); ahead.next_line()) {
    if (ahead.word_on_line() && keyword(ahead) == 'm') materials_.load(file_->path(), ahead.rest_of_line());
  }
  materials_.refuse();
}

// Takes a name. A line "g" may name several groups.
void ObjSource::use_name(char key, const std::string& name) {
  if (key == 'o') fits_.object = parts_.fits(name);
  if (key == 'u') fits_.material = parts_.fits(name);
  (key == 'u' ? names_.material : names_.part) = name;
  if (key != 'g') return;
  fits_.group = parts_.fits(name);
  std::istringstream words(name);
  for (std::string word; words >> word;) fits_.group = parts_.fits(word) || fits_.group;
}

/// Notes the part of a face: named by its group or object, else by its material.
void ObjSource::note_part(const std::vector<std::uint64_t>& corners) {
  for (const std::uint64_t corner : corners) {
    if (corner >= vertex_count()) return;
  }
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const TriangleD t{vertex(corners[0]), vertex(corners[k - 1]), vertex(corners[k])};
    if (parts_.note(names_.part.empty() ? names_.material : names_.part, t)) return;
  }
}

// Reads corners: "v", "v/vt", "v//vn" or "v/vt/vn". Only the vertex's number is required. Other forms are noted.
void ObjSource::read_corners(std::vector<std::uint64_t>& corners) {
  corners.clear();
  corner_places_.clear();
  corner_normals_.clear();
  while (text_.word_on_line() && text_.peek() != '#') {
    if (text_.peek() == '+') text_.doubt();
    std::int64_t index = 0;
    if (!text_.integer(index)) text_.fail_here("a face corner is not a number; is the file damaged?");
    read_corner_rest();
    if (!text_.at_word_end()) text_.fail_here("a face corner is not of the form v/vt/vn; is the file damaged?");
    if (corners.size() == kMaxCorners)
      text_.fail_here("a face of more than {} corners; is the file intact?", kMaxCorners);
    corners.push_back(resolve(index));
  }
  if (text_.peek() == '#') text_.doubt();  // some programs read the numbers of a comment
}

/// Checks a face on a last line without a line end. Many good files lack that end: only a face that cannot be whole
/// tells that the file was cut off.
void ObjSource::check_last_line(const std::vector<std::uint64_t>& corners) {
  if (!text_.at_end()) return;
  const bool whole = std::all_of(corners.begin(), corners.end(), [&](std::uint64_t i) { return i < pool_.size(); });
  if (corners.size() < 3 || !whole) text_.fail_here("the file ends in the middle of its data; it is truncated");
}

/// Reads the number of a line that a corner names: counted from 1, or backwards from `seen` lines. Returns kNoVertex if
/// there is none, or if the line does not stand further up, and notes that.
std::uint64_t ObjSource::read_number_before(std::uint64_t seen) {
  const bool has_sign = text_.peek() == '+';
  std::int64_t index = 0;
  const bool is_there =
      text_.integer(index) && index != 0 && index >= -std::int64_t(seen) && index <= std::int64_t(seen);
  if (has_sign || !is_there) text_.doubt();
  if (!is_there) return kNoVertex;
  return index > 0 ? std::uint64_t(index) - 1 : seen - std::uint64_t(-index);
}

/// Reads the numbers after a vertex: its place in the image and its normal.
void ObjSource::read_corner_rest() {
  std::uint64_t place = kNoVertex, normal = kNoVertex;
  if (text_.peek() == '/') {
    text_.step();
    if (text_.peek() != '/') place = read_number_before(seen_.places);
    if (text_.peek() == '/') {
      text_.step();
      normal = read_number_before(seen_.normals);
    }
    if (!text_.at_word_end()) {
      text_.doubt();
      text_.skip_word();
    }
  }
  if (texture_ != TriangleTexture::kNoMaterial || normals_) corner_places_.push_back(place);
  if (normals_) corner_normals_.push_back(normal);
}

std::uint64_t ObjSource::resolve(std::int64_t index) {
  const std::uint64_t seen = seen_.vertices;
  if (index == 0 || index < -std::int64_t(seen)) return kNoVertex;
  const std::uint64_t i = index > 0 ? std::uint64_t(index) - 1 : seen - std::uint64_t(-index);
  if (i >= pool_.size() && !all_loaded_) load_ahead();
  if (i >= seen && i < pool_.size()) text_.doubt();  // some programs read the file once
  return i;
}

// Loads all later vertices. An earlier pass that was cut short may have left the pool ahead of this one: those vertices
// are not read twice.
void ObjSource::load_ahead() {
  std::uint64_t known = pool_.size() - seen_.vertices;
  TextScanner ahead(file_, text_.mark());
  for (ahead.next_line(); !ahead.at_end(); ahead.next_line()) {
    if (!ahead.word_on_line() || keyword(ahead) != 'v') continue;
    if (known > 0) {
      --known;
    } else {
      read_vertex(ahead);
    }
  }
  all_loaded_ = true;
}

}  // namespace

RawSourcePtr open_obj(SceneFilePtr file, const SceneOptions& options) {
  return std::make_unique<ObjSource>(file, options);
}

}  // namespace bp
