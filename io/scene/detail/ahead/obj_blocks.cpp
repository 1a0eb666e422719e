#include "io/scene/detail/ahead/obj_blocks.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstring>
#include <string_view>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::uint64_t kBlock = std::uint64_t(1) << 18;
constexpr std::uint64_t kLongest = 4096;  // characters of a line that a block may take from the next one

/// The kinds of lines. odd: the line may mean more than it seems to, and only ObjSource reads it.
enum class Line { other, vertex, face, odd_face, odd };

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view first_word(std::string_view line) {
  const auto is_end = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  return line.substr(0, std::size_t(std::find_if(line.begin(), line.end(), is_end) - line.begin()));
}

/// Returns what a line is, and moves its begin to the first number. `line`: without its end.
Line begin_line(std::string_view& line) {
  if (!line.empty() && line.back() == '\\') return Line::odd;  // goes on with the next line
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  if (line.empty()) return Line::other;
  if (static_cast<unsigned char>(line.front()) < ' ') return Line::odd;  // some of these characters count as blanks
  const std::string_view word = first_word(line);
  if (word == "l" || word == "fo" || adds_unread_surface(word)) return Line::odd_face;
  if (word != "v" && word != "f") return Line::other;
  const bool is_vertex = line.front() == 'v';
  line.remove_prefix(1);
  if (!line.empty() && !is_blank(line.front())) return Line::odd;
  return is_vertex ? line.empty() ? Line::odd : Line::vertex : Line::face;
}

/// Reads the three numbers behind "v". Returns false unless each is plain and ends at a blank or with the line.
bool read_numbers(std::string_view line, Vec3d& vertex) {
  const char *at = line.data(), *const end = at + line.size();
  for (double& c : vertex) {
    while (at != end && is_blank(*at)) ++at;
    const auto [last, error] = std::from_chars(at, end, c);
    if (error != std::errc() || (last != end && !is_blank(*last))) return false;
    at = last;
  }
  return true;
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

/// Calls f(line) for the lines that begin in the block, without their ends; it returns false to stop. Returns false if
/// it did, or a line is too long, or has a lone CR.
template <class F>
bool for_each_line(const SceneFile& file, std::uint64_t begin, const F& f) {
  const std::uint64_t before = begin > 0 ? 1 : 0;  // character
  std::vector<char> text(std::size_t(before + kBlock + kLongest));
  text.resize(file.read_at(begin - before, std::as_writable_bytes(std::span(text))));
  const char *at = text.data(), *const end = at + text.size();
  const char* const last = at + std::min<std::size_t>(std::size_t(before + kBlock), text.size());
  if (begin == 0 && std::string_view(at, text.size()).starts_with("\xEF\xBB\xBF")) at += 3;
  if (before > 0) {  // the line before ends here, or later
    at = std::find(at, end, '\n');
    at += at != end ? 1 : 0;
  }
  while (at < last) {
    const char* line_end = static_cast<const char*>(std::memchr(at, '\n', std::size_t(end - at)));
    const bool is_ended = line_end != nullptr;
    if (!is_ended && begin - before + text.size() != file.size()) return false;
    if (!is_ended) line_end = end;
    const char* const next = is_ended ? line_end + 1 : end;
    if (line_end != at && line_end[-1] == '\r') --line_end;
    const std::string_view line(at, std::size_t(line_end - at));
    if (line.find('\r') != std::string_view::npos || !f(line, is_ended)) return false;
    at = next;
  }
  return true;
}

struct Block {
  std::uint64_t begin = 0;
  std::vector<Vec3d> vertices;
  bool plain = true, plain_faces = true;
};

void read_block(const SceneFile& file, Block& block) {
  block.plain = for_each_line(file, block.begin, [&](std::string_view line, bool is_ended) {
    const Line what = begin_line(line);
    if (what == Line::odd_face) block.plain_faces = false;
    if (what == Line::face) block.plain_faces &= is_ended && for_each_corner(line, [](std::int64_t) {});
    if (what != Line::vertex) return what != Line::odd;
    return read_numbers(line, block.vertices.emplace_back());
  });
  if (!block.plain) block.plain_faces = false;
}

/// Makes triangles of faces.
class FaceMaker {
 public:
  FaceMaker(const VertexPool& pool, bool fans, RawBatch& batch) : pool_(pool), batch_(batch), cut_(fans) {}

  /// `seen`: vertices before the face, from which negative numbers count.
  void add(std::string_view line, std::uint64_t seen) {
    corners_.clear();
    bool is_good = true;
    (void)for_each_corner(line, [&](std::int64_t number) {
      const std::uint64_t back = number < 0 ? std::uint64_t(-number) : 0;
      is_good &= number != 0 && back <= seen;
      corners_.push_back(number > 0 ? std::uint64_t(number) - 1 : seen - std::min(back, seen));
      is_good &= corners_.back() < pool_.size();
    });
    if (!is_good || corners_.size() < 3) {
      ++batch_.bad_faces;
      return;
    }
    const auto place = [&](std::size_t k) { return pool_.in_memory(corners_[k]); };
    cut_.cut(corners_.size(), place);
    const bool is_cut = corners_.size() > 3;
    if (is_cut) batch_.inner_edges.resize(batch_.triangles.size());
    for (std::size_t i = 0; i < cut_.triangles(); ++i) {
      batch_.triangles.push_back(cut_.places(cut_[i], place));
      if (is_cut) batch_.inner_edges.push_back(cut_.inner_edges(i));
    }
  }

 private:
  const VertexPool& pool_;
  RawBatch& batch_;
  FaceTriangles cut_;
  std::vector<std::uint64_t> corners_;
};

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
        begin += kBlock;
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
  FaceMaker faces(pool, fans, batch);
  (void)for_each_line(*file_, i * kBlock, [&](std::string_view line, bool) {
    const Line what = begin_line(line);
    if (what == Line::vertex) ++seen;
    if (what == Line::face) faces.add(line, seen);
    return true;
  });
}

}  // namespace bp
