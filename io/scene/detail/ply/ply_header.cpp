#include "io/scene/detail/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <set>

namespace bp {

namespace {

constexpr std::uint64_t kMaxHeaderBytes = std::uint64_t(1) << 20;
constexpr std::size_t kMaxProperties = 1024;

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

/// Reads one line; returns true at "end_header".
bool header_line(TextScanner& text, PlyHeader& header, bool& has_format) {
  const std::string key = word_of(text);
  if (key == "format") {
    header.format = format_of(text);
    has_format = true;
  } else if (key == "element") {
    if (header.elements.size() == kMaxProperties) text.fail_here("more than {} elements", kMaxProperties);
    header.elements.push_back(element_of(text));
  } else if (key == "property") {
    if (header.elements.empty()) text.fail_here("a property before the first element");
    if (header.elements.back().properties.size() == kMaxProperties)
      text.fail_here("more than {} properties", kMaxProperties);
    header.elements.back().properties.push_back(property_of(text));
  } else if (key != "comment" && key != "obj_info" && key != "end_header") {
    text.fail_here("'{}' does not belong into a PLY header; is this a PLY file?", key);
  }
  return key == "end_header";
}

}  // namespace

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

PlyHeader read_ply_header(SceneFilePtr file) {
  PlyHeader header;
  TextScanner text(std::move(file));
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
  return header;
}

void check_ply_end(const SceneFile& file, std::uint64_t end) {
  constexpr std::uint64_t kMostBlanks = 16;
  constexpr std::string_view kBlanks{"\0 \t\r\n\x1A", 6};
  char left[kMostBlanks + 1];
  const std::string_view rest(left, file.read_at(end, std::as_writable_bytes(std::span(left))));
  if (rest.size() > kMostBlanks || rest.find_first_not_of(kBlanks) != rest.npos)
    fail(ErrorCode::bad_input, "{}: byte {}: data begin that the header does not promise; is the file damaged?",
         file.name(), end);
}

}  // namespace bp
