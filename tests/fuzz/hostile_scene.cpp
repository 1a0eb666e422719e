#include "tests/fuzz/hostile_scene.h"

#include <algorithm>
#include <string>

namespace fuzz {

namespace {

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

Shape cube() {
  Shape s;
  for (int i = 0; i < 8; ++i) s.points.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  s.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return s;
}

Shape some_triangles(Choices& c) {
  Shape s;
  const std::uint32_t n = 3 + c.below(8);
  for (std::uint32_t i = 0; i < n; ++i)
    s.points.push_back({double(c.below(9)) - 4, double(c.below(9)) - 4, double(c.below(9)) - 4});
  for (std::uint32_t i = 0; i < n; ++i) s.triangles.push_back({c.below(n), c.below(n), c.below(n)});
  return s;
}

/// Any number as text, or one that is none.
std::string number_text(Choices& c, double value) {
  return c.once_in(64) ? extreme_text(c) : text_of(value);
}

std::string index_text(Choices& c, std::int64_t value) {
  return c.once_in(48) ? std::to_string(extreme_integer(c)) : std::to_string(value);
}

/// A number of things, as promised by a header.
std::string count_text(Choices& c, std::size_t count) {
  return c.once_in(16) ? extreme_text(c) : std::to_string(count + (c.once_in(16) ? c.below(3) : 0));
}

void cut_or_flip(Choices& c, std::string& bytes) {
  if (bytes.empty() || !c.once_in(6)) return;
  if (c.once_in(3)) bytes.resize(c.below(std::uint32_t(std::min<std::size_t>(bytes.size(), 60000)) + 1));
  for (std::uint32_t n = c.below(4); n > 0 && !bytes.empty(); --n)
    bytes[c.below(std::uint32_t(std::min<std::size_t>(bytes.size(), 60000)))] = char(c.byte());
}

}  // namespace

Shape hostile_shape(Choices& c) {
  Shape s = c.once_in(3) ? some_triangles(c) : cube();
  const double scale = c.once_in(6) ? extreme_number(c) : c.of({1.0, 0.25, 3.0, 100.0, 0.001});
  std::array<double, 3> offset{};
  if (c.once_in(4)) offset[c.below(3)] = c.once_in(2) ? extreme_number(c) : c.of({1e6, -1842009.9, 0.1, 1e12});
  for (auto& p : s.points) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = p[i] * scale + offset[i];
  }
  if (c.once_in(3)) {
    for (std::uint32_t n = 1 + c.below(3); n > 0; --n)
      s.points[c.below(std::uint32_t(s.points.size()))][c.below(3)] = extreme_number(c);
  }
  if (c.once_in(8)) s.triangles.resize(c.below(std::uint32_t(s.triangles.size()) + 1));
  return s;
}

std::string hostile_stl(Choices& c) {
  const Shape s = hostile_shape(c);
  if (c.once_in(2)) {
    std::string out = "solid s\n";
    for (const auto& t : s.triangles) {
      out += "facet normal 0 0 1\n outer loop\n";
      for (const std::uint32_t v : t) {
        out += "  vertex";
        for (const double x : s.points[v]) out += " " + number_text(c, x);
        out += "\n";
      }
      out += c.once_in(32) ? "endloop endloop\n" : " endloop\nendfacet\n";
    }
    return out + "endsolid s\n";
  }
  std::string out(80, c.once_in(8) ? 's' : '\0');
  put(out, c.once_in(8) ? std::uint32_t(extreme_integer(c)) : std::uint32_t(s.triangles.size()));
  for (const auto& t : s.triangles) {
    for (int i = 0; i < 3; ++i) put(out, 0.0f);
    for (const std::uint32_t v : t) {
      for (const double x : s.points[v]) put(out, float(x));
    }
    put(out, std::uint16_t(0));
  }
  return out;
}

std::string hostile_obj(Choices& c) {
  const Shape s = hostile_shape(c);
  std::string out = c.once_in(8) ? "mtllib no.mtl\nusemtl a\n" : "";
  for (const auto& p : s.points) {
    out += "v";
    for (const double x : p) out += " " + number_text(c, x);
    out += c.once_in(16) ? " " + extreme_text(c) + " 0 1\n" : c.once_in(32) ? " \\\n\n" : "\n";
  }
  for (const auto& t : s.triangles) {
    out += "f";
    const bool back = c.once_in(6);
    for (const std::uint32_t v : t) {
      out += " " + index_text(c, back ? std::int64_t(v) - std::int64_t(s.points.size()) : std::int64_t(v) + 1);
      if (c.once_in(24)) out += c.of<std::string>({"/1", "//1", "/1/1", "/", "//", "/-1", "/x"});
    }
    for (std::uint32_t n = c.once_in(8) ? c.below(8) : 0; n > 0; --n) out += " " + index_text(c, 1 + c.below(9));
    out += "\n";
  }
  return out;
}

std::string hostile_off(Choices& c) {
  const Shape s = hostile_shape(c);
  std::string out = c.of<std::string>({"OFF", "COFF", "NOFF", "STOFF", "4OFF", "OFF BINARY", "nOFF"}) + "\n";
  out += count_text(c, s.points.size()) + " " + count_text(c, s.triangles.size()) + " 0\n";
  for (const auto& p : s.points) {
    for (const double x : p) out += number_text(c, x) + " ";
    out += c.once_in(16) ? extreme_text(c) + "\n" : "\n";
  }
  for (const auto& t : s.triangles) {
    out += index_text(c, 3);
    for (const std::uint32_t v : t) out += " " + index_text(c, v);
    out += "\n";
  }
  return out;
}

SceneFile hostile_scene(Choices& c) {
  SceneFile file;
  switch (c.below(8)) {
    case 0:
      file = {"ply", hostile_ply(c)};
      break;
    case 1:
      file = {"stl", hostile_stl(c)};
      break;
    case 2:
      file = {"obj", hostile_obj(c)};
      break;
    case 3:
      file = {"off", hostile_off(c)};
      break;
    case 4:
    case 5:
      file = {"gltf", hostile_gltf(c)};
      break;
    case 6:
      file = {"glb", hostile_glb(c)};
      break;
    default:  // whatever the fuzzer makes
      file.extension = c.of<std::string>({"ply", "stl", "obj", "off", "gltf", "glb"});
      file.bytes = c.rest();
      return file;
  }
  cut_or_flip(c, file.bytes);
  return file;
}

}  // namespace fuzz
