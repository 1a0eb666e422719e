#include "io/scene/detail/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <set>

namespace bp {

namespace {

constexpr std::uint64_t kMaxHeaderBytes = std::uint64_t(1) << 20;
constexpr std::size_t kMaxProperties = 1024;
constexpr std::string_view kEnd = "end_header";

struct TypeName {
  std::string_view old_name, new_name;
  PlyType type;
};
constexpr std::array<TypeName, 10> kTypes{{{"char", "int8", PlyType::i8},
                                           {"uchar", "uint8", PlyType::u8},
                                           {"short", "int16", PlyType::i16},
                                           {"ushort", "uint16", PlyType::u16},
                                           {"int", "int32", PlyType::i32},
                                           {"uint", "uint32", PlyType::u32},
                                           {"long", "int64", PlyType::i64},
                                           {"ulong", "uint64", PlyType::u64},
                                           {"float", "float32", PlyType::f32},
                                           {"double", "float64", PlyType::f64}}};

std::string word_of(TextScanner& text) {
  if (!text.word_on_line()) text.fail_here("the line of the PLY header ends too early");
  return std::string(text.word());
}

PlyType type_of(TextScanner& text) {
  const std::string word = word_of(text);
  for (const TypeName& t : kTypes) {
    if (word == t.old_name || word == t.new_name) return t.type;
  }
  text.fail_here("'{}' is not a PLY type", word);
}

PlyHeader::Format format_of(TextScanner& text) {
  const std::string word = word_of(text);
  if (word == "ascii") return PlyHeader::Format::ascii;
  if (word == "binary_little_endian") return PlyHeader::Format::little_endian;
  if (word == "binary_big_endian") return PlyHeader::Format::big_endian;
  text.fail_here("'{}' is not a PLY format", word);
}

PlyElement element_of(TextScanner& text) {
  PlyElement element;
  element.name = word_of(text);
  std::int64_t count = 0;
  if (!text.word_on_line() || !text.count(count) || count < 0)
    text.fail_here("element '{}' has no valid count", element.name);
  element.count = std::uint64_t(count);
  return element;
}

PlyProperty property_of(TextScanner& text) {
  PlyProperty p;
  if (text.word_on_line() && text.peek() == 'l') {  // "list", or the type "long"
    TextScanner::Mark start = text.mark();
    p.is_list = word_of(text) == "list";
    if (p.is_list) {
      p.count_type = type_of(text);
    } else {
      text.seek(start);
      if (!text.word_on_line()) text.fail_here("the line of the PLY header ends too early");
    }
  }
  p.type = type_of(text);
  p.name = word_of(text);
  return p;
}

/// Two lists of corners have one meaning.
std::string_view meaning_of(std::string_view property) {
  return property == "vertex_index" ? "vertex_indices" : property;
}

/// Refuses elements and coordinates that are there twice: programs take the first or the last one, or read both.
void check_names(const TextScanner& text, const PlyHeader& header) {
  std::set<std::string_view> elements;
  for (const PlyElement& element : header.elements) {
    if (!elements.insert(element.name).second)
      text.fail_here("the header has two elements '{}'; programs disagree on what that means", element.name);
    std::set<std::string_view> properties;
    for (const PlyProperty& p : element.properties) {
      const std::string_view name = meaning_of(p.name);
      const bool is_place = name == "x" || name == "y" || name == "z" || name == "vertex_indices";
      if (is_place && !properties.insert(name).second)
        text.fail_here("element '{}' has '{}' twice; programs disagree on what that means", element.name, p.name);
    }
  }
}

/// Reads one line; returns true at "end_header". Words behind those that a line must have are noted.
bool header_line(TextScanner& text, PlyHeader& header, bool& has_format) {
  const std::string key = word_of(text);
  if (key == "comment" || key == "obj_info") return false;
  if (key == "format") {
    if (has_format) text.fail_here("the header has two lines 'format'; programs disagree on what that means");
    header.format = format_of(text);
    has_format = true;
    if (text.has_more()) (void)text.word();  // the version
  } else if (key == "element") {
    if (header.elements.size() == kMaxProperties) text.fail_here("more than {} elements", kMaxProperties);
    header.elements.push_back(element_of(text));
  } else if (key == "property") {
    if (header.elements.empty()) text.fail_here("a property before the first element");
    if (header.elements.back().properties.size() == kMaxProperties)
      text.fail_here("more than {} properties", kMaxProperties);
    header.elements.back().properties.push_back(property_of(text));
  } else if (key != kEnd) {
    text.fail_here("'{}' does not belong into a PLY header; is this a PLY file?", key);
  }
  if (text.has_more()) text.doubt();
  return key == kEnd;
}

/// Returns how many lines of a header have odd characters, or name its end, in which case some programs end it there.
std::uint64_t odd_lines_of(const SceneFile& file, std::uint64_t end) {
  std::string all(std::size_t(end), '\0');
  all.resize(file.read_at(0, std::as_writable_bytes(std::span(all))));
  const std::string_view text = std::string_view(all).substr(starts_with_mark(all) ? 3 : 0);
  OddCharacters odd;
  odd.add(text);
  std::uint64_t lines = odd.lines();
  for (std::size_t at = text.find(kEnd), last = text.rfind(kEnd); at < last; at = text.find(kEnd, at + 1)) ++lines;
  return lines;
}

}  // namespace

PlyRange range_of(PlyType type) {
  const int bits = 8 * int(bytes_of(type));
  const bool is_signed = type == PlyType::i8 || type == PlyType::i16 || type == PlyType::i32;
  if (!is_integer(type) || type == PlyType::i64) return {};
  const PlyRange all{is_signed ? std::numeric_limits<std::int64_t>::min() : 0};
  const int lost = 64 - bits - (is_signed || bits == 64 ? 0 : 1);
  return {all.least >> (64 - bits), all.most >> lost};
}

std::size_t bytes_of(PlyType type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kBytes[std::size_t(type)];
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::uint64_t PlyElement::fixed_bytes() const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += p.is_list ? 0 : bytes_of(p.type);
  return bytes;
}

std::size_t PlyElement::index_of(const std::string& property) const {
  std::size_t i = 0;
  while (i < properties.size() && properties[i].name != property) ++i;
  return i;
}

PlyHeader read_ply_header(const SceneFilePtr& file) {
  PlyHeader header;
  TextScanner text(file);
  if (!text.word_anywhere() || text.word() != "ply")
    text.fail_here("does not start with 'ply'; this is not a PLY file");
  bool has_format = false;
  for (bool more = true; more;) {
    text.next_line();
    if (text.at_end() || text.offset() > kMaxHeaderBytes)
      text.fail_here("the PLY header has no 'end_header'; the file is truncated or not PLY");
    more = !text.word_on_line() || !header_line(text, header, has_format);
  }
  if (!has_format) text.fail_here("the PLY header has no 'format' line");
  check_names(text, header);
  text.next_line();
  header.data = text.mark();
  header.ends = text.ends();
  header.odd_lines = text.doubted() + odd_lines_of(*file, header.data.offset);
  return header;
}

}  // namespace bp
