#include "io/scene/detail/ahead/obj_blocks.h"

#include <algorithm>
#include <atomic>
#include <string_view>

#include "io/scene/detail/ahead/block_lines.h"
#include "io/scene/detail/ahead/face_maker.h"
#include "io/scene/detail/text/plain_integer.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

/// The kinds of lines. odd: the line may mean more than it seems to, and only ObjSource reads it.
enum class Line { other, vertex, place, normal, face, odd_face, odd };

/// Returns what a line is, and moves its begin to the first number. `line`: without its end.
Line begin_line(std::string_view& line) {
  if (!line.empty() && line.back() == '\\') return Line::odd;  // goes on with the next line
  drop_blanks(line);
  if (line.empty()) return Line::other;
  if (static_cast<unsigned char>(line.front()) < ' ') return Line::odd;  // some of these characters count as blanks
  std::string_view rest = line;
  const std::string_view word = take_word(rest);
  if (word == "vt") return Line::place;
  if (word == "vn") return Line::normal;
  if (word == "l" || word == "p" || word == "fo" || adds_unread_surface(word)) return Line::odd_face;
  if (word != "v" && word != "f") return is_glued(word) ? Line::odd_face : Line::other;
  const bool is_vertex = line.front() == 'v';
  line.remove_prefix(1);
  if (!line.empty() && !is_blank(line.front())) return Line::odd;
  return is_vertex ? line.empty() ? Line::odd : Line::vertex : Line::face;
}

/// Returns whether what follows a position means the same to all programs: the weight 1, or a colour of three or four
/// numbers.
bool has_plain_rest(std::string_view rest) {
  std::string_view first;
  std::size_t words = 0;
  for (drop_blanks(rest); !rest.empty(); drop_blanks(rest), ++words) {
    const std::string_view word = take_word(rest);
    if (word.empty() || word.find_first_not_of("0123456789.+-eE") != word.npos) return false;
    if (words == 0) first = word;
  }
  double weight = 0;
  return words == 0 || words == 3 || words == 4 || (words == 1 && take_number(first, weight) && weight == 1);
}

/// Reads the line behind "v". Returns false unless each of its numbers is plain.
bool read_numbers(std::string_view line, Vec3d& vertex) {
  return std::all_of(vertex.begin(), vertex.end(), [&](double& c) { return take_number(line, c); }) &&
         (line.empty() || has_plain_rest(line));
}

/// Calls f(number) for the number of each corner of a face, whose form is known: "v", "v/vt", "v//vn" or "v/vt/vn".
template <class F>
void for_each_corner(std::string_view line, const F& f) {
  const char *at = line.data(), *const end = at + line.size();
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return;
    std::int64_t number = 0;
    if (const char* const last = take_digits(at, end, number); last != nullptr) at = last;
    while (at != end && !is_blank(*at)) ++at;
    f(number);
  }
}

struct Block {
  std::uint64_t begin = 0;
  std::vector<Vec3d> vertices;
  ObjLines seen, needed;  // in the block; before the block, so that its faces name what stands before them
  bool plain = true, plain_faces = true;
};

/// Moves behind a number of a corner. Returns null if it is not plain. `seen`: lines in the block that it may name.
/// `needed`: lines before the block.
const char* take_part(const char* at, const char* end, std::uint64_t seen, std::uint64_t& needed) {
  std::int64_t number = 0;
  const char* const last = take_digits(at, end, number);
  if (last == nullptr || number == 0) return nullptr;
  const auto lines = std::uint64_t(number < 0 ? -number : number);
  if (lines > seen) needed = std::max(needed, lines - seen);
  return last;
}

/// Notes what the corners of a face need. Returns false if one is not plain.
bool look_at_corners(std::string_view line, Block& block) {
  const char *at = line.data(), *const end = at + line.size();
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return true;
    at = take_part(at, end, block.seen.vertices, block.needed.vertices);
    if (at != nullptr && at != end && *at == '/') {
      const bool has_place = ++at == end || *at != '/';
      if (has_place) at = take_part(at, end, block.seen.places, block.needed.places);
      if (at != nullptr && at != end && *at == '/')
        at = take_part(at + 1, end, block.seen.normals, block.needed.normals);
    }
    if (at == nullptr || (at != end && !is_blank(*at))) return false;
  }
}

/// Reads a line. Returns false if it is not plain.
bool read_line(std::string_view line, bool is_ended, Block& block) {
  const Line what = begin_line(line);
  block.seen.vertices += what == Line::vertex ? 1 : 0;
  block.seen.places += what == Line::place ? 1 : 0;
  block.seen.normals += what == Line::normal ? 1 : 0;
  if (what == Line::odd_face) block.plain_faces = false;
  if (what == Line::face) block.plain_faces = block.plain_faces && is_ended && look_at_corners(line, block);
  return what == Line::vertex ? read_numbers(line, block.vertices.emplace_back()) : what != Line::odd;
}

void read_block(const SceneFile& file, Block& block) {
  BlockLines lines(file, block.begin);
  block.plain = !lines.has_odd_characters();
  while (block.plain && lines.next_here()) block.plain = read_line(lines.line(), lines.is_ended(), block);
  block.plain &= lines.is_plain();
  block.plain_faces &= block.plain;
}

/// Replaces `corners` by those of a face. `seen`: vertices before the face, from which negative numbers count.
void read_face(std::string_view line, std::uint64_t seen, std::vector<std::uint64_t>& corners) {
  corners.clear();
  for_each_corner(line, [&](std::int64_t number) {
    corners.push_back(number > 0 ? std::uint64_t(number) - 1 : seen - std::uint64_t(-number));
  });
}

bool holds(const ObjLines& all, const ObjLines& some) {
  return all.vertices >= some.vertices && all.places >= some.places && all.normals >= some.normals;
}

}  // namespace

bool ObjBlocks::read_vertices(const std::function<void(const std::vector<Vec3d>&)>& take) {
  std::uint64_t begin = 0;
  ObjLines seen;
  std::atomic<bool> plain = true;
  bool all = true;
  plain_faces_ = true;
  pipeline<Block>(
      thread_count() + 1,
      [&](Block& block) {
        block.begin = begin;
        begin += BlockLines::kBlock;
        return block.begin < file_->size() && plain;
      },
      [&](Block& block) {
        read_block(*file_, block);
        if (!block.plain) plain = false;
      },
      [&](Block& block) {
        all &= block.plain;
        plain_faces_ &= block.plain_faces && holds(seen, block.needed);
        seen_before_.push_back(seen.vertices);
        seen.vertices += block.seen.vertices;
        seen.places += block.seen.places;
        seen.normals += block.seen.normals;
        if (all) take(block.vertices);
      });
  plain_faces_ &= all;
  return all;
}

void ObjBlocks::read_faces(std::size_t i, const VertexPool& pool, bool fans, RawBatch& batch) const {
  std::uint64_t seen = seen_before_[i];
  std::vector<std::uint64_t> corners;
  FaceMaker faces(pool, fans, batch);
  for (BlockLines lines(*file_, i * BlockLines::kBlock); lines.next_here();) {
    std::string_view line = lines.line();
    const Line what = begin_line(line);
    if (what == Line::vertex) ++seen;
    if (what != Line::face) continue;
    read_face(line, seen, corners);
    faces.add(corners);
  }
}

}  // namespace bp
