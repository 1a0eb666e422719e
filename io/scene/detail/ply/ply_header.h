#pragma once
#include <limits>

#include "io/scene/detail/text/text_scanner.h"

namespace bp {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
[[nodiscard]] std::size_t bytes_of(PlyType type);
[[nodiscard]] inline bool is_integer(PlyType type) {
  return type < PlyType::f32;
}

struct PlyRange {
  std::int64_t least = std::numeric_limits<std::int64_t>::min(), most = std::numeric_limits<std::int64_t>::max();

  template <class Number>
  [[nodiscard]] bool holds(Number n) const {
    return n >= Number(least) && n <= Number(most);
  }
};
/// Returns which integers a type holds, as far as 64 bits with a sign do. All, if it is a type of floats.
[[nodiscard]] PlyRange range_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  bool is_list = false;
  PlyType count_type = PlyType::u8;  ///< type of a list's count
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has_lists() const;
  [[nodiscard]] std::uint64_t fixed_bytes() const;  ///< bytes of a binary record without its lists
  [[nodiscard]] std::size_t index_of(const std::string& property) const;  ///< properties.size() if there is none
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  TextScanner::Mark data;       ///< first byte behind the header
  LineEnds ends;                ///< of the header
  std::uint64_t odd_lines = 0;  ///< of the header, which other programs read in another way, but for their ends
};

/// Reads a header. Throws bad_input with the line of the header that is wrong, or where it says something twice.
[[nodiscard]] PlyHeader read_ply_header(const SceneFilePtr& file);

}  // namespace bp
