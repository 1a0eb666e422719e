#include <algorithm>

#include "tests/fuzz/hostile_scene.h"

namespace fuzz {

namespace {

enum class Form { ascii, little, big };

struct Type {
  const char* name;
  int bytes;
  bool real;
};
constexpr Type kTypes[] = {{"float", 4, true},   {"double", 8, true}, {"int", 4, false},   {"uint", 4, false},
                           {"uchar", 1, false},  {"char", 1, false},  {"short", 2, false}, {"ushort", 2, false},
                           {"float64", 8, true}, {"int64", 8, false}};

/// Values one after the other, in the form of the file.
class Values {
 public:
  explicit Values(Form form) : form_(form) {}
  void put(Choices& c, const Type& type, double value) {
    if (form_ == Form::ascii) {
      text_ += (c.once_in(64) ? extreme_text(c) : text_of(value)) + " ";
    } else if (type.real && type.bytes == 8) {
      raw(value);
    } else if (type.real) {
      raw(float(value));
    } else {
      const bool fits = value > -9e18 && value < 9e18;
      const std::int64_t whole = fits ? std::int64_t(value) : -1;
      std::string bytes(reinterpret_cast<const char*>(&whole), std::size_t(type.bytes));
      append(bytes);
    }
  }
  void end_line() {
    if (form_ == Form::ascii) text_ += "\n";
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <class T>
  void raw(T value) {
    append({reinterpret_cast<const char*>(&value), sizeof(T)});
  }
  void append(std::string bytes) {
    if (form_ == Form::big) std::reverse(bytes.begin(), bytes.end());
    text_ += bytes;
  }
  Form form_;
  std::string text_;
};

std::string count(Choices& c, std::size_t n) {
  return c.once_in(16) ? std::to_string(std::uint64_t(extreme_integer(c))) : std::to_string(n);
}

}  // namespace

std::string hostile_ply(Choices& c) {
  const Shape s = hostile_shape(c);
  const Form form = c.of({Form::ascii, Form::little, Form::big});
  const char* const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  const Type xyz = kTypes[c.once_in(8) ? c.below(10) : 1 - c.below(2)];
  const Type lists = kTypes[c.once_in(8) ? c.below(10) : 4], index = kTypes[c.once_in(8) ? c.below(10) : 2];
  const bool more = c.once_in(8), list_of_vertex = c.once_in(24), strips = c.once_in(24);
  std::string out = std::string("ply\nformat ") + forms[int(form)] + " 1.0\n";
  if (c.once_in(24)) out += "element nothing " + count(c, 0) + "\n" + (more ? "property list uchar int x\n" : "");
  out += "element vertex " + count(c, s.points.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) out += std::string("property ") + xyz.name + " " + axis + "\n";
  if (more) out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (list_of_vertex) out += "property list uchar float w\n";
  out +=
      std::string("element ") + (strips ? "tristrips " : "face ") + count(c, s.triangles.size()) + "\nproperty list ";
  out += std::string(lists.name) + " " + index.name + (c.once_in(16) ? " vertex_index\n" : " vertex_indices\n");
  if (c.once_in(48)) out += extreme_text(c) + "\n";
  out += "end_header\n";
  Values values(form);
  for (const auto& p : s.points) {
    for (const double x : p) values.put(c, xyz, x);
    for (int i = 0; i < 3 && more; ++i) values.put(c, kTypes[4], i * 100);
    if (list_of_vertex) values.put(c, kTypes[4], 0);
    values.end_line();
  }
  for (const auto& t : s.triangles) {
    values.put(c, lists, c.once_in(32) ? extreme_number(c) : 3);
    for (const std::uint32_t v : t) values.put(c, index, c.once_in(48) ? extreme_number(c) : v);
    values.end_line();
  }
  return out + values.text();
}

}  // namespace fuzz
