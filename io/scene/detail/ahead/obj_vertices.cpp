#include "io/scene/detail/ahead/obj_vertices.h"

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

struct Block {
  std::uint64_t begin = 0;
  std::vector<Vec3d> vertices;
  bool plain = true;
};

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// Reads the three numbers behind "v". Returns false unless each is plain and ends at a blank or with the line.
bool read_numbers(const char* at, const char* end, Vec3d& vertex) {
  for (double& c : vertex) {
    while (at != end && is_blank(*at)) ++at;
    const auto [last, error] = std::from_chars(at, end, c);
    if (error != std::errc() || (last != end && !is_blank(*last))) return false;
    at = last;
  }
  return true;
}

/// Reads a line, without its end. Returns false if it may mean more than it seems to.
bool read_line(const char* at, const char* end, std::vector<Vec3d>& vertices) {
  if (at != end && end[-1] == '\\') return false;  // goes on with the next line
  while (at != end && is_blank(*at)) ++at;
  if (at == end) return true;
  if (static_cast<unsigned char>(*at) < ' ') return false;  // some of these characters count as blanks
  if (*at != 'v') return true;
  if (++at == end) return false;
  if (!is_blank(*at)) return static_cast<unsigned char>(*at) > ' ';  // another keyword, such as "vn"
  Vec3d vertex;
  if (!read_numbers(at, end, vertex)) return false;
  vertices.push_back(vertex);
  return true;
}

/// Reads the lines that begin in the block.
bool read_block(const SceneFile& file, std::uint64_t begin, std::vector<Vec3d>& vertices) {
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
    const bool whole = line_end != nullptr || begin - before + text.size() == file.size();
    if (line_end == nullptr) line_end = end;
    const char* const next = line_end != end ? line_end + 1 : end;
    if (line_end != at && line_end[-1] == '\r') --line_end;
    if (!whole || std::memchr(at, '\r', std::size_t(line_end - at)) != nullptr || !read_line(at, line_end, vertices))
      return false;
    at = next;
  }
  return true;
}

}  // namespace

bool read_plain_vertices(const SceneFile& file, const std::function<void(const std::vector<Vec3d>&)>& take) {
  std::uint64_t begin = 0;
  std::atomic<bool> plain = true;
  bool all = true;
  pipeline<Block>(
      thread_count() + 1,
      [&](Block& block) {
        block.begin = begin;
        begin += kBlock;
        return block.begin < file.size() && plain;
      },
      [&](Block& block) {
        block.plain = read_block(file, block.begin, block.vertices);
        if (!block.plain) plain = false;
      },
      [&](Block& block) {
        all &= block.plain;
        if (all) take(block.vertices);
      });
  return all;
}

}  // namespace bp
