#include "io/scene/detail/ahead/stl_blocks.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "io/files/lower.h"
#include "io/scene/detail/ahead/block_lines.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

struct FacetBlock {
  std::uint64_t begin = 0;
  std::uint64_t first = 0, behind = 0;  // its statements, in the file; behind is 0 if it has none
  std::optional<bool> in_solid;         // at its end; nothing: as at its begin
  bool begins_inside = false;           // a facet stands before its first "solid" and "endsolid"
  std::vector<TriangleD> triangles;
  bool plain = true;
};

/// Returns whether a line has these words and no more.
bool is_line(std::string_view line, std::string_view first, std::string_view second = {}) {
  const bool same = take_word(line) == first && (second.empty() || take_word(line) == second);
  drop_blanks(line);
  return same && line.empty();
}

bool read_corner(std::string_view line, Vec3d& corner) {
  if (take_word(line) != "vertex") return false;
  for (double& c : corner) {
    if (!take_number(line, c)) return false;
  }
  drop_blanks(line);
  return line.empty();
}

/// Reads the lines behind "facet". Returns false if one is not plain.
bool read_facet(BlockLines& lines, TriangleD& t) {
  if (!lines.next() || !is_line(lines.line(), "outer", "loop")) return false;
  for (Vec3d& corner : t) {
    if (!lines.next() || !read_corner(lines.line(), corner)) return false;
  }
  return lines.next() && is_line(lines.line(), "endloop") && lines.next() && is_line(lines.line(), "endfacet");
}

/// Returns whether the normal, which is not read, has the words that it must have.
bool is_normal(std::string_view line) {
  constexpr int kNumbers = 3;
  if (take_word(line) != "normal") return false;
  for (int i = 0; i < kNumbers; ++i) {
    const std::string_view word = take_word(line);
    if (word.empty() || !begins_number(word.front())) return false;
  }
  drop_blanks(line);
  return line.empty();
}

/// Notes a facet. Returns false if it stands outside of a solid.
bool note_facet(FacetBlock& block) {
  block.begins_inside |= !block.in_solid;
  return block.in_solid.value_or(true);
}

/// Reads what begins with the line. Returns false if a line is not plain.
bool read_statement(BlockLines& lines, FacetBlock& block) {
  std::string_view line = lines.line();
  const std::string_view word = take_word(line);
  if (word == "facet") return note_facet(block) && is_normal(line) && read_facet(lines, block.triangles.emplace_back());
  if (word != "solid" && word != "endsolid") return word.empty() && line.empty();
  block.in_solid = word == "solid";
  return !names_facets(line);
}

bool begins_statement(std::string_view line) {
  const std::string_view word = take_word(line);
  return word == "facet" || word == "solid" || word == "endsolid";
}

/// Reads the statements that begin in the block. The lines before the first one belong to the block before.
void read_facets(const SceneFile& file, FacetBlock& block) {
  BlockLines lines(file, block.begin);
  block.plain = !lines.has_odd_characters();
  bool more = lines.next_here();
  while (more && block.begin > 0 && !begins_statement(lines.line())) more = lines.next_here();
  if (more) block.first = lines.line_begin();
  for (; more && block.plain; more = lines.next_here()) {
    block.plain = read_statement(lines, block);
    block.behind = lines.next_begin();
  }
  block.plain &= lines.is_plain();
}

}  // namespace

bool names_facets(std::string_view name) {
  constexpr std::array<std::string_view, 5> kWords{"facet", "outer", "loop", "endloop", "endfacet"};
  constexpr std::array<std::string_view, 2> kParts{"vertex", "endsolid"};  // some programs find these within words
  if (name.size() > kLongestName) return true;
  const std::string low = lower(name);
  for (const std::string_view part : kParts) {
    if (low.find(part) != std::string::npos) return true;
  }
  for (std::string_view rest = low; !rest.empty(); rest.remove_prefix(rest.empty() ? 0 : 1)) {
    if (std::find(kWords.begin(), kWords.end(), take_word(rest)) != kWords.end()) return true;
  }
  return false;
}

std::optional<Bounds3d> StlBlocks::find() {
  std::uint64_t begin = 0, behind = 0;
  std::atomic<bool> plain = true;
  bool in_solid = false;
  Bounds3d all;
  blocks_ = 0;
  pipeline<FacetBlock>(
      thread_count() + 1,
      [&](FacetBlock& block) {
        block.begin = begin;
        begin += BlockLines::kBlock;
        return block.begin < file_->size() && plain;
      },
      [&](FacetBlock& block) {
        read_facets(*file_, block);
        if (!block.plain) plain = false;
      },
      [&](FacetBlock& block) {
        if (block.begin > 0 && behind != (block.behind > 0 ? block.first : file_->size())) plain = false;
        if (block.behind > 0) behind = block.behind;
        if (block.begins_inside && !in_solid) plain = false;
        in_solid = block.in_solid.value_or(in_solid);
        for (const TriangleD& t : block.triangles) {
          for (const Vec3d& p : t) all.add(p);
        }
        ++blocks_;
      });
  return plain && !in_solid ? std::optional(all) : std::nullopt;
}

void StlBlocks::read(std::size_t i, std::vector<TriangleD>& out) const {
  FacetBlock block;
  block.begin = i * BlockLines::kBlock;
  block.triangles.swap(out);
  block.triangles.clear();
  read_facets(*file_, block);
  out.swap(block.triangles);
}

}  // namespace bp
