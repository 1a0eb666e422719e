#include "io/scene/detail/obj/obj_vectors.h"

#include "io/scene/raw_source.h"

namespace bp {

namespace {

/// Reads a vector; missing numbers are 0.
void read_vector(TextScanner& text, std::size_t numbers, VertexPool& pool) {
  Vec3d v{};
  for (std::size_t i = 0; i < numbers; ++i) {
    if (!text.word_on_line() || !text.real(v[i])) break;
  }
  pool.push(v);
}

/// Returns the line with a number, counted from 1, or backwards from `seen` lines, which the number must not exceed.
std::uint64_t line_of(std::int64_t number, std::uint64_t seen) {
  return number > 0 ? std::uint64_t(number) - 1 : seen - std::uint64_t(-number);
}

/// Reads the number of a line that a corner names. Returns kNone if there is none, or if the line does not stand
/// further up, and notes that.
std::uint64_t read_number_before(TextScanner& text, std::uint64_t seen) {
  const bool has_sign = text.peek() == '+';
  std::int64_t number = 0;
  const bool is_there =
      text.integer(number) && number != 0 && number >= -std::int64_t(seen) && number <= std::int64_t(seen);
  if (has_sign || !is_there) text.doubt();
  return is_there ? line_of(number, seen) : ObjCorner::kNone;
}

}  // namespace

char obj_keyword(TextScanner& text) {
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

ObjCorner read_obj_corner(TextScanner& text, const ObjLines& seen) {
  ObjCorner corner;
  if (text.peek() == '+') text.doubt();
  if (!text.integer(corner.vertex)) text.fail_here("a face corner is not a number; is the file damaged?");
  if (text.peek() == '/') {
    text.step();
    if (text.peek() != '/') corner.place = read_number_before(text, seen.places);
    if (text.peek() == '/') {
      text.step();
      corner.normal = read_number_before(text, seen.normals);
    }
    if (!text.at_word_end()) {
      text.doubt();
      text.skip_word();
    }
  }
  if (!text.at_word_end()) text.fail_here("a face corner is not of the form v/vt/vn; is the file damaged?");
  return corner;
}

ObjVectors::ObjVectors(const SceneFilePtr& file, const SceneOptions& options)
    : vertices(options.memory_bytes, temp_dir_of(options)), file_(file) {
  if (options.colors) colors.emplace(options.memory_bytes / 2, temp_dir_of(options));
  if (options.textures) places.emplace(options.memory_bytes / 2, temp_dir_of(options));
  if (options.textures && options.surface) normals.emplace(options.memory_bytes / 2, temp_dir_of(options));
}

void ObjVectors::read(char key, TextScanner& text) {
  if (key == 'v') {
    if (seen_.vertices == vertices.size()) read_vertex(text);
    ++seen_.vertices;
  } else if (key == 't') {
    if (places && seen_.places == places->size()) read_vector(text, 2, *places);
    ++seen_.places;
  } else {
    if (normals && seen_.normals == normals->size()) read_vector(text, 3, *normals);
    ++seen_.normals;
  }
}

void ObjVectors::read_vertex(TextScanner& text) {
  Vec3d p;
  for (double& c : p) {
    if (!text.word_on_line() || !text.real(c)) text.fail_here("a vertex needs three numbers; is the file damaged?");
  }
  vertices.push(p);
  if (text.has_more()) read_vertex_rest(text);
}

// Reads what follows a position: a colour, or the weight of a rational curve's point. Some programs divide by a weight,
// and drop a vertex with other words behind it.
void ObjVectors::read_vertex_rest(TextScanner& text) {
  double rest[4];
  std::size_t n = 0;
  while (n < std::size(rest) && text.has_more() && text.real(rest[n])) ++n;
  const bool is_known = n >= 3 || (n == 1 && rest[0] == 1);
  if (!is_known || text.has_more()) text.doubt();
  if (n < 3 || !colors) return;
  while (colors->size() + 1 < vertices.size()) colors->push({1, 1, 1});
  colors->push({rest[0], rest[1], rest[2]});
  has_colors = true;
}

std::uint64_t ObjVectors::vertex_of(std::int64_t number, TextScanner& text) {
  const std::uint64_t seen = seen_.vertices;
  if (number == 0 || number < -std::int64_t(seen)) return ObjCorner::kNone;
  const std::uint64_t i = line_of(number, seen);
  if (i >= vertices.size() && !all_loaded) load_ahead(text);
  if (i >= seen && i < vertices.size()) text.doubt();  // some programs read the file once
  return i;
}

// Loads all later vertices. An earlier pass that was cut short may have left the pool ahead of this one: those vertices
// are not read twice.
void ObjVectors::load_ahead(const TextScanner& text) {
  std::uint64_t known = vertices.size() - seen_.vertices;
  TextScanner ahead(file_, text.mark());
  for (ahead.next_line(); !ahead.at_end(); ahead.next_line()) {
    if (!ahead.word_on_line() || obj_keyword(ahead) != 'v') continue;
    if (known > 0) {
      --known;
    } else {
      read_vertex(ahead);
    }
  }
  all_loaded = true;
}

}  // namespace bp
