#include "io/scene/detail/ahead/obj_blocks.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <string_view>

#include "io/scene/detail/ahead/block_lines.h"
#include "io/scene/detail/ahead/face_maker.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

/// The kinds of lines. odd: the line may mean more than it seems to, and only ObjSource reads it.
enum class Line { other, vertex, face, odd_face, odd };

/// Returns what a line is, and moves its begin to the first number. `line`: without its end.
Line begin_line(std::string_view& line) {
  if (!line.empty() && line.back() == '\\') return Line::odd;  // goes on with the next line
  drop_blanks(line);
  if (line.empty()) return Line::other;
  if (static_cast<unsigned char>(line.front()) < ' ') return Line::odd;  // some of these characters count as blanks
  std::string_view rest = line;
  const std::string_view word = take_word(rest);
  if (word == "l" || word == "fo" || adds_unread_surface(word)) return Line::odd_face;
  if (word != "v" && word != "f") return is_glued(word) ? Line::odd_face : Line::other;
  const bool is_vertex = line.front() == 'v';
  line.remove_prefix(1);
  if (!line.empty() && !is_blank(line.front())) return Line::odd;
  return is_vertex ? line.empty() ? Line::odd : Line::vertex : Line::face;
}

/// Reads the three numbers behind "v". Returns false unless each is plain.
bool read_numbers(std::string_view line, Vec3d& vertex) {
  return std::all_of(vertex.begin(), vertex.end(), [&](double& c) { return take_number(line, c); });
}

/// Calls f(number) for the number of each corner of a face: "v", "v/vt", "v//vn" or "v/vt/vn". Returns false if one is
/// not plain.
template <class F>
bool for_each_corner(std::string_view line, const F& f) {
  constexpr std::ptrdiff_t kMostDigits = 18;
  const char *at = line.data(), *const end = at + line.size();
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return true;
    std::int64_t number = 0;
    const auto [last, error] = std::from_chars(at, end, number);
    if (error != std::errc() || last - at > kMostDigits) return false;
    at = last;
    if (at != end && *at == '/') {
      while (at != end && static_cast<unsigned char>(*at) > ' ') ++at;
    }
    if (at != end && !is_blank(*at)) return false;
    f(number);
  }
}

struct Block {
  std::uint64_t begin = 0;
  std::vector<Vec3d> vertices;
  bool plain = true, plain_faces = true;
};

/// Reads a line. Returns false if it is not plain.
bool read_line(std::string_view line, bool is_ended, Block& block) {
  const Line what = begin_line(line);
  if (what == Line::odd_face) block.plain_faces = false;
  if (what == Line::face) block.plain_faces &= is_ended && for_each_corner(line, [](std::int64_t) {});
  return what == Line::vertex ? read_numbers(line, block.vertices.emplace_back()) : what != Line::odd;
}

void read_block(const SceneFile& file, Block& block) {
  BlockLines lines(file, block.begin);
  while (block.plain && lines.next_here()) block.plain = read_line(lines.line(), lines.is_ended(), block);
  block.plain &= lines.is_plain();
  block.plain_faces &= block.plain;
}

/// Replaces `corners` by those of a face. `seen`: vertices before the face, from which negative numbers count.
void read_face(std::string_view line, std::uint64_t seen, std::vector<std::uint64_t>& corners) {
  constexpr std::uint64_t kNoVertex = ~std::uint64_t(0);
  corners.clear();
  (void)for_each_corner(line, [&](std::int64_t number) {
    const std::uint64_t back = number < 0 ? std::uint64_t(-number) : 0;
    const bool is_there = number != 0 && back <= seen;
    corners.push_back(!is_there ? kNoVertex : number > 0 ? std::uint64_t(number) - 1 : seen - back);
  });
}

}  // namespace

bool ObjBlocks::read_vertices(const std::function<void(const std::vector<Vec3d>&)>& take) {
  std::uint64_t begin = 0, seen = 0;
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
        plain_faces_ &= block.plain_faces;
        seen_before_.push_back(seen);
        seen += block.vertices.size();
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
