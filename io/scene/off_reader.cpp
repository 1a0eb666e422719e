#include "io/scene/detail/text/text_scanner.h"
#include "io/scene/detail/vertex_pool.h"
#include "io/scene/raw_source.h"

// OFF (Geomview's object file format), ASCII: OFF and its variants with colours, normals and texture coordinates (COFF,
// NOFF, STOFF, CNOFF ...), whose extra numbers follow the three of the position on the same line. The header may be
// missing, or be glued to the first count. Comments start with '#'. A vertex or a face of two lines,
// and a comment on a line among them, is noted: some programs read lines, others words.

namespace bp {

namespace {

class OffSource final : public PolygonSource {
 public:
  OffSource(SceneFilePtr file, const SceneOptions& options)
      : PolygonSource(options), text_(std::move(file)), pool_(options.memory_bytes, temp_dir_of(options)) {
    read_header();
    read_vertices();
    start_ = text_.mark();
  }

 private:
  bool next_face(std::vector<std::uint64_t>& corners) override;
  [[nodiscard]] std::uint64_t vertex_count() const override { return pool_.size(); }
  [[nodiscard]] Vec3d vertex(std::uint64_t i) override { return pool_[i]; }
  [[nodiscard]] Unfollowed unfollowed() const override {
    Unfollowed u;
    u.lines = text_.odd_lines();
    return u;
  }
  void rewind_faces() override {
    text_.seek(start_);
    face_ = 0;
  }

  void read_header();
  void refuse_dimensions();  ///< 4OFF, nOFF
  void skip_keyword();
  void note_extras(const std::string& keyword);
  std::uint64_t end_line();
  void read_vertices();
  std::int64_t need_integer(const char* what);
  std::int64_t integer_here(const char* what);
  void need_word();
  void need_word_of_record();
  void check_room(std::uint64_t count, std::uint64_t bytes, const char* what);

  TextScanner text_;
  VertexPool pool_;
  TextScanner::Mark start_;  // start of the faces
  std::uint64_t vertices_ = 0, faces_ = 0, face_ = 0;
  std::uint64_t least_extras_ = 0, most_extras_ = 0;  // words of a vertex' line behind its position
  bool in_record_ = false;                            // behind the first word of a vertex or a face
};

void OffSource::need_word() {
  if (!text_.word_anywhere('#')) text_.fail_here("the file ends in the middle of its data; it is truncated");
}

std::int64_t OffSource::need_integer(const char* what) {
  need_word();
  return integer_here(what);
}

std::int64_t OffSource::integer_here(const char* what) {
  std::int64_t value = 0;
  if (!text_.count(value)) text_.fail_here("{} is not an integer; is this an OFF file?", what);
  return value;
}

/// Moves to the next word of a vertex or a face.
void OffSource::need_word_of_record() {
  const bool is_here = text_.has_more() && text_.peek() != '#';
  if (is_here && in_record_) return;
  if (in_record_ || (text_.word_anywhere() && text_.peek() == '#')) text_.doubt();
  in_record_ = true;
  need_word();
}

/// Moves to the next line. Returns how many words, but for a comment, stand before it.
std::uint64_t OffSource::end_line() {
  std::uint64_t words = 0;
  for (; text_.has_more() && text_.peek() != '#'; ++words) {
    text_.step();  // skip_word() stops at a control character
    text_.skip_word();
  }
  in_record_ = false;
  text_.next_line();
  return words;
}

/// Notes which words follow a position: three of a normal, two of a texture coordinate, and a colour with or without
/// its opacity.
void OffSource::note_extras(const std::string& keyword) {
  const std::string kinds = keyword.substr(0, keyword.size() - 3);
  const auto has = [&](char c) { return kinds.find(c) != std::string::npos; };
  least_extras_ = (has('N') ? 3 : 0) + (has('T') ? 2 : 0) + (has('C') ? 3 : 0);
  most_extras_ = least_extras_ + (has('C') ? 1 : 0);
}

void OffSource::skip_keyword() {
  std::string keyword;
  while (text_.peek() >= 'A' && text_.peek() <= 'Z' && keyword.size() < 8) {
    keyword += text_.peek();
    text_.step();
  }
  const bool known = keyword.size() >= 3 && keyword.compare(keyword.size() - 3, 3, "OFF") == 0 &&
                     keyword.find_first_not_of("STCNOF") == std::string::npos;
  if (!known)
    text_.fail_here("starts with '{}'; only OFF, COFF, NOFF and their like with three coordinates are read", keyword);
  note_extras(keyword);
  if (text_.word_on_line() && text_.peek() == 'B')
    text_.fail_here("binary OFF is not read; convert the file to PLY or to ASCII OFF");
}

void OffSource::refuse_dimensions() {
  const TextScanner::Mark start = text_.mark();
  text_.step();
  if (text_.peek() == 'O') text_.fail_here("4OFF and nOFF files do not have three dimensions; they are not read");
  text_.seek(start);
  need_word();
}

void OffSource::read_header() {
  need_word();
  if (text_.peek() == '4' || text_.peek() == 'n') refuse_dimensions();
  if (text_.peek() >= 'A' && text_.peek() <= 'Z') skip_keyword();
  const std::int64_t vertices = need_integer("the count of vertices"), faces = need_integer("the count of faces");
  if (vertices < 0 || faces < 0) text_.fail_here("a count is negative; is this an OFF file?");
  vertices_ = std::uint64_t(vertices);
  faces_ = std::uint64_t(faces);
  const std::uint64_t line = text_.line();
  if (end_line() != 1) text_.doubt(line);  // the count of edges may be missing
}

// Throws if the file is too short: each number takes at least two characters; the last one may lack its line end.
void OffSource::check_room(std::uint64_t count, std::uint64_t bytes, const char* what) {
  if (count > (text_.remaining() + 1) / bytes) {
    text_.fail_here("the header promises {} {}, but only {} bytes follow; the file is truncated", count, what,
                    text_.remaining());
  }
}

void OffSource::read_vertices() {
  check_room(vertices_, 6, "vertices");
  for (std::uint64_t i = 0; i < vertices_; ++i) {
    Vec3d p;
    for (double& c : p) {
      need_word_of_record();
      if (!text_.real(c)) text_.fail_here("a vertex needs three numbers; is the file damaged?");
    }
    pool_.push(p);
    const std::uint64_t line = text_.line(), extras = end_line();
    if (extras < least_extras_ || extras > most_extras_) text_.doubt(line);
  }
  check_room(faces_, 2, "faces");
}

bool OffSource::next_face(std::vector<std::uint64_t>& corners) {
  if (face_ == faces_) {
    if (text_.word_anywhere('#'))
      text_.fail_here("more follows than the {} faces that the header promises; is the file damaged?", faces_);
    return false;
  }
  ++face_;
  corners.clear();
  const auto need = [&](const char* what) {
    need_word_of_record();
    std::int64_t value = 0;
    if (text_.plain_integer(value)) return value;
    text_.doubt();
    return integer_here(what);
  };
  const std::int64_t size = need("the size of a face");
  if (size < 0 || std::uint64_t(size) > kMaxCorners)
    text_.fail_here("a face of {} corners; is the file damaged?", size);
  for (std::int64_t i = 0; i < size; ++i) {
    const std::int64_t corner = need("a corner of a face");
    corners.push_back(corner < 0 ? kNoVertex : std::uint64_t(corner));
  }
  end_line();
  return true;
}

}  // namespace

RawSourcePtr open_off(SceneFilePtr file, const SceneOptions& options) {
  return std::make_unique<OffSource>(std::move(file), options);
}

}  // namespace bp
