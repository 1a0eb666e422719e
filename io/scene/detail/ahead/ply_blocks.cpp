#include "io/scene/detail/ahead/ply_blocks.h"

#include <algorithm>
#include <atomic>

#include "io/scene/detail/ahead/block_lines.h"
#include "io/scene/detail/ahead/face_maker.h"
#include "io/scene/detail/text/plain_integer.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

struct RecordBlock {
  std::uint64_t begin = 0, records = 0;
  std::vector<Vec3d> vertices;
  bool plain = true;
};

/// Reads `count` records from `first` on, one a line, on all cores. read(line, block) returns false if a line is not
/// plain. take(block) gets the blocks in the order of the file; `records` of the last one are those up to the count.
/// Returns false if the file has fewer plain lines.
template <class Read, class Take>
bool read_records(const SceneFile& file, std::uint64_t first, std::uint64_t count, const Read& read, const Take& take) {
  std::uint64_t begin = first, left = count;
  std::atomic<bool> goes_on = count > 0;
  pipeline<RecordBlock>(
      thread_count() + 1,
      [&](RecordBlock& block) {
        block.begin = begin;
        begin += BlockLines::kBlock;
        return block.begin < file.size() && goes_on;
      },
      [&](RecordBlock& block) {
        BlockLines lines(file, block.begin, first);
        block.plain = !lines.has_odd_characters();
        while (block.plain && lines.next_here()) {
          block.plain = read(lines.line(), block);
          if (block.plain) ++block.records;
        }
        block.plain &= lines.is_plain();
      },
      [&](RecordBlock& block) {
        if (!goes_on) return;
        block.records = std::min(block.records, left);
        left -= block.records;
        take(block);
        goes_on = left > 0 && block.plain;
      });
  return left == 0;
}

/// Reads an integer. Returns false if it is not plain, or if the type does not hold it.
bool take_integer(std::string_view& line, const PlyRange& range, std::int64_t& number) {
  drop_blanks(line);
  const char* const end = line.data() + line.size();
  const char* const last = take_digits(line.data(), end, number);
  if (last == nullptr || (last != end && !is_blank(*last))) return false;
  line.remove_prefix(std::size_t(last - line.data()));
  return range.holds(number);
}

/// Skips the number of a property. Returns false if it is not plain.
bool skip_number(std::string_view& line, PlyType type) {
  std::int64_t number = 0;
  return is_integer(type) ? take_integer(line, range_of(type), number) : !take_word(line).empty();
}

bool take_coordinate(std::string_view& line, PlyType type, double& c) {
  if (!is_integer(type)) return take_number(line, c);
  std::int64_t number = 0;
  const bool is_plain = take_integer(line, range_of(type), number);
  c = double(number);
  return is_plain;
}

bool read_vertex(std::string_view line, const PlyElement& vertex, const PlyPosition& position, Vec3d& p) {
  for (std::size_t k = 0; k < vertex.properties.size(); ++k) {
    const std::size_t axis = position.axis_of(k);
    const PlyType type = vertex.properties[k].type;
    if (axis < 3 ? !take_coordinate(line, type, p[axis]) : !skip_number(line, type)) return false;
  }
  drop_blanks(line);
  return line.empty();
}

/// Calls f(number) for each corner of a face, and moves the line's begin behind them. Returns false if a number is not
/// plain. `counts`, `numbers`: those that the types of the list hold.
template <class F>
bool take_corners(std::string_view& line, const PlyRange& counts, const PlyRange& numbers, const F& f) {
  std::int64_t n = 0, number = 0;
  if (!take_integer(line, counts, n) || n < 0) return false;
  for (; n > 0; --n) {
    if (!take_integer(line, numbers, number)) return false;
    f(number);
  }
  return true;
}

bool is_face(std::string_view line, const std::vector<PlyProperty>& properties) {
  const PlyRange counts = range_of(properties[0].count_type), numbers = range_of(properties[0].type);
  if (!take_corners(line, counts, numbers, [](std::int64_t) {})) return false;
  for (std::size_t k = 1; k < properties.size(); ++k) {
    if (!skip_number(line, properties[k].type)) return false;
  }
  drop_blanks(line);
  return line.empty();
}

/// Returns the offset behind so many lines of a block. `first`: where all records begin.
std::uint64_t behind(const SceneFile& file, std::uint64_t first, std::uint64_t block, std::uint64_t lines_in) {
  BlockLines lines(file, block, first);
  while (lines_in > 0 && lines.next_here()) --lines_in;
  return lines.next_begin();
}

}  // namespace

bool PlyBlocks::read_vertices(const PlyElement& vertex, const PlyPosition& position,
                              const std::function<void(const std::vector<Vec3d>&)>& take) {
  const std::uint64_t first = faces_.offset;
  std::uint64_t last_begin = first, last_records = 0;
  const bool plain = read_records(
      *file_, first, vertex.count,
      [&](std::string_view line, RecordBlock& block) {
        return read_vertex(line, vertex, position, block.vertices.emplace_back());
      },
      [&](RecordBlock& block) {
        block.vertices.resize(std::size_t(block.records));
        last_begin = block.begin;
        last_records = block.records;
        take(block.vertices);
      });
  faces_ = {behind(*file_, first, last_begin, last_records), faces_.line + vertex.count};
  return plain;
}

bool PlyBlocks::has_plain_form(const PlyElement& face) {
  const auto is_list = [](const PlyProperty& p) { return p.is_list; };
  const std::vector<PlyProperty>& all = face.properties;
  return face.name == "face" && std::count_if(all.begin(), all.end(), is_list) == 1 && all[0].is_list &&
         (all[0].name == "vertex_indices" || all[0].name == "vertex_index");
}

std::optional<TextMark> PlyBlocks::find_faces(const PlyElement& face) {
  faces_in_.clear();
  const bool plain = read_records(
      *file_, faces_.offset, face.count,
      [&](std::string_view line, RecordBlock&) { return is_face(line, face.properties); },
      [&](const RecordBlock& block) { faces_in_.push_back(block.records); });
  if (!plain) return {};
  if (faces_in_.empty()) return faces_;
  const std::uint64_t last = faces_.offset + (faces_in_.size() - 1) * BlockLines::kBlock;
  return TextMark{behind(*file_, faces_.offset, last, faces_in_.back()), faces_.line + face.count};
}

void PlyBlocks::read_faces(std::size_t i, const VertexPool& pool, bool fans, RawBatch& batch) const {
  std::vector<std::uint64_t> corners;
  FaceMaker faces(pool, fans, batch);
  BlockLines lines(*file_, faces_.offset + i * BlockLines::kBlock, faces_.offset);
  for (std::uint64_t left = faces_in_[i]; left > 0 && lines.next_here(); --left) {
    std::string_view line = lines.line();
    corners.clear();
    (void)take_corners(line, {}, {}, [&](std::int64_t number) {
      corners.push_back(std::uint64_t(number));  // a negative number is beyond all vertices
    });
    faces.add(corners);
  }
}

}  // namespace bp
