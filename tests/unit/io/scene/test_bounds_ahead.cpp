// Bounds that OBJ, ASCII PLY and glTF tell before their triangles are read.
#include <random>

#include "lib/core/box.h"
#include "lib/core/parallel.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/gltf_document.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

Bounds3d box_of(const std::vector<TriangleD>& triangles) {
  Bounds3d box;
  for (const TriangleD& t : triangles) {
    for (const Vec3d& p : t) box.add(p);
  }
  return box;
}

struct Outcome {
  std::vector<TriangleD> triangles;
  std::string complaint;
  std::uint64_t bad_faces = 0, odd_lines = 0;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

/// Reads to the end, twice; with `ahead`, the bounds first.
Outcome outcome_of(const std::string& path, bool ahead, std::optional<Bounds3d>& told) {
  Outcome outcome;
  try {
    const auto source = open_scene(path);
    if (ahead) told = source->bounds();
    outcome.triangles = read_all(*source);
    outcome.bad_faces = source->counts().bad_faces;
    outcome.odd_lines = source->counts().unfollowed.lines;
    source->rewind();
    CHECK((read_all(*source) == outcome.triangles));
    CHECK(source->counts().unfollowed.lines == outcome.odd_lines);
  } catch (const Error& e) {
    outcome.complaint = e.what();
  }
  return outcome;
}

/// Compares a file with and without a question about its bounds before. Returns the bounds that were told.
std::optional<Bounds3d> bounds_ahead(const std::string& path) {
  std::optional<Bounds3d> told;
  const Outcome plain = outcome_of(path, false, told), after = outcome_of(path, true, told);
  CHECK((plain == after));
  return told;
}

/// Checks the same for a file whose vertices are all used. Returns whether bounds were told.
bool check_ahead(const std::string& path) {
  const std::optional<Bounds3d> told = bounds_ahead(path);
  if (told) CHECK(*told == box_of(read_all(path)));
  return told.has_value();
}

/// Some hundred kilobytes in several blocks, with all kinds of lines that programs write.
std::string long_obj(unsigned seed, const std::string& line_end) {
  std::mt19937 random(seed);
  const auto number = [&] { return std::to_string(double(int(random() % 2000001) - 1000000) / 997); };
  const char* const blanks[] = {" ", "  ", "\t"};
  std::string text = "# a comment of \xC3\xA9" + line_end;
  for (int i = 0; i < 7; ++i) text += "vt 0 0" + line_end + "vn 0 0 1" + line_end;
  int vertices = 0;
  while (text.size() < 1200000) {
    for (int k = 0; k < 3; ++k, ++vertices) {
      const std::string blank = blanks[random() % 3];
      text += (random() % 9 == 0 ? " v" : "v") + blank + number() + blank + number() + " " + number();
      if (random() % 5 == 0) text += blank + "0.5 0.5 0.5";
      if (random() % 7 == 0) text += blank;
      text += line_end;
      if (random() % 4 == 0) text += "vn 0 0 1" + line_end + "vt 0.5 v 1 2 3" + line_end + line_end;
      if (random() % 50 == 0) text += "# v 9 9 9 " + std::string(random() % 3000, 'x') + line_end;
    }
    text += "f -1 -2 -3" + line_end;
    if (vertices > 9) text += "f 1/2/3 5//7 " + std::to_string(vertices) + line_end;
    if (random() % 3 == 0) text += " f\t-1 -2/1\t-3 -" + std::to_string(1 + random() % 9) + " " + line_end;
    if (random() % 9 == 0) text += "f 1 2 " + std::to_string(1 + random() % unsigned(vertices)) + line_end;
  }
  return text;
}

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}  // namespace

TEST_CASE("an OBJ tells its bounds, and is read as if it had not", "[quick][io][bounds]") {
  const TempDir dir;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    for (const char* const line_end : {"\n", "\r\n"}) {
      const std::string text = long_obj(unsigned(threads), line_end);
      CHECK(check_ahead(dir.file("a.obj", text)));
      CHECK(check_ahead(dir.file("b.obj", "\xEF\xBB\xBF" + text)));
      CHECK(check_ahead(dir.file("c.obj", text.substr(0, text.size() - 1))));  // no end of the last line
      SceneOptions little;
      little.memory_bytes = 100000;  // vertices go to a scratch file
      const auto source = open_scene(dir.path("a.obj"), little);
      CHECK(source->bounds() == box_of(read_all(dir.path("a.obj"))));
      CHECK((read_all(*source) == read_all(dir.path("a.obj"))));
    }
  }
}

TEST_CASE("an OBJ with odd lines is read, or refused, as if nobody had asked for its bounds", "[quick][io][bounds]") {
  const TempDir dir;
  const std::vector<std::string> odd{"v 5 \\\n6 7\n",
                                     "v 5 6 7\rv 8 9 9\r",
                                     "v +5 6 7\n",
                                     "v 5 6 7#c\n",
                                     "\fv 5 6 7\n",
                                     "\vv 5 6 7\n",
                                     "v\v5 6 7\n",
                                     "v 5 6\n",
                                     "v\n",
                                     "v 1e999 0 0\n",
                                     "v nan inf 0\n",
                                     "v 1.#INF 0 0\n",
                                     "# c \\\nv 5 6 7\n",
                                     "v 5 6 x\n",
                                     "v 5,6,7\n",
                                     "v 0x10 0 0\n",
                                     "\x01v 5 6 7\n",
                                     "v 1e-320 0 0\n",
                                     "v 5 6 7\x1A\n",
                                     "v 5\f6 7\n",
                                     "v 5 6 7 \\\n8\n",
                                     "v 5 6 7 0.5\n",
                                     "v 5 6 7 8 9\n",
                                     "v 5 6 7 # 8\n",
                                     "# a\fv 5 6 7\n",
                                     "# \xC2\xA0\n",
                                     "\xE9v 5 6 7\n",
                                     "v\xC2\xA0 5 6 7\n",
                                     std::string("# a\0v\n", 6)};
  for (const std::string& line : odd) {
    CAPTURE(line);
    for (const std::string& text : {line + kTriangle, kTriangle + line + "f 1 2 4\n", kTriangle + line}) {
      (void)bounds_ahead(dir.file("a.obj", text));
      (void)bounds_ahead(dir.file("b.obj", long_obj(1, "\n") + text));  // in the last block
    }
  }
  for (const char* const line : {"vx 5 6 7\n", "v 0 0 0 1\n", "v 0 0 0 1 0 0\n", "v 0 0 0 1 0 0 1\n", "vertex\n",
                                 " \t\n", "l 1 2\n", "o \\a\\b\n", "g v 5 6 7\n"}) {
    CAPTURE(line);
    CHECK(bounds_ahead(dir.file("c.obj", line + std::string(kTriangle))));
  }
  // A line that is longer than what a block takes from the next one.
  const std::string text = long_obj(2, "\n");
  (void)check_ahead(dir.file("d.obj", "#" + std::string(600000, 'v') + "\n" + text));
  CHECK(check_ahead(dir.file("e.obj", "#" + std::string(261000, ' ') + "v 9 9 9\n" + text)));
}

TEST_CASE("odd faces of an OBJ are read, or refused, as if nobody had asked for its bounds", "[quick][io][bounds]") {
  const TempDir dir;
  const std::vector<std::string> odd{"f 1 2 3#c\n",
                                     "f 1 2 # 3\n",
                                     "f 1 2 x\n",
                                     "f +1 2 3\n",
                                     "f 1/\\\n 2 3\n",
                                     "f 1 2 \\\n3\n",
                                     "f 1 2\n",
                                     "f\n",
                                     "f 1 2 3 1 2\n",
                                     "surf 0 1\n",
                                     "surface\n",
                                     "call other.obj\n",
                                     "bzp 1 2 3 1\n",
                                     "l 1 2\n",
                                     "f 0 1 2\n",
                                     "f -99999999 1 2\n",
                                     "f 1/a 2/b 3/\n",
                                     "f 99999999999999999999 1 2\n",
                                     "f 9223372036854775808 1 2\n",
                                     "f 1 2 3\v1\n",
                                     "f\v1 2 3\n",
                                     "f 1\\ 2 3\n",
                                     "f 1.5 2 3\n",
                                     "f 1 2 3",
                                     "f 1 2",
                                     "f 1 2 99999999",
                                     "f 1 2 3\r",
                                     "usemtl f\n",
                                     "fo 1 2 3\n",
                                     "f -0 1 2\n",
                                     "f 1 2 - 3\n",
                                     "f 1,2,3\n",
                                     "f 1/1 2/1 3/1\n",
                                     "f 1//1 2//1 3//1\n",
                                     "vt 0 0\nf 1/1 2/1 3/2\n",
                                     "vn 0 0 1\nf 1//-1 2//-2 3//-1\n",
                                     "f 1/ 2/ 3/\n",
                                     "f 4 1 2\nv 5 6 7\n",
                                     "p 1\n"};
  for (const std::string& line : odd) {
    CAPTURE(line);
    (void)bounds_ahead(dir.file("a.obj", kTriangle + line));
    (void)bounds_ahead(dir.file("b.obj", kTriangle + line + kTriangle));
    (void)bounds_ahead(dir.file("c.obj", long_obj(3, "\n") + line));
  }
}

TEST_CASE("an OBJ tells no bounds if colours or some of its parts are asked for", "[quick][io][bounds]") {
  const TempDir dir;
  const std::string path = dir.file("a.obj", kTriangle);
  SceneOptions colors, parts;
  colors.colors = true;
  parts.parts = "x";
  CHECK(open_scene(path)->bounds());
  CHECK_FALSE(open_scene(path, colors)->bounds());
  CHECK_FALSE(open_scene(path, parts)->bounds());
}

TEST_CASE("an ASCII PLY tells the bounds of its vertices", "[quick][io][bounds]") {
  const TempDir dir;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float z\nproperty float y\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(check_ahead(dir.file("a.ply", header + "0 1 2\n-3 4 5\n6 -7 8\n3 0 1 2\n")));
}

TEST_CASE("a glTF tells the bounds of its vertices as they are placed", "[quick][io][bounds]") {
  const TempDir dir;
  std::mt19937 random(5);
  for (int turn = 0; turn < 20; ++turn) {
    Document d;
    d.json["scenes"][0]["nodes"] = Json::array();
    const ThreadLimit threads(1 + turn % 3);
    for (int n = 0; n < 3; ++n) {
      const auto some = [&] { return double(int(random() % 2001) - 1000) / 7; };
      std::vector<Vec3d> points;
      for (int i = 0; i < 30; ++i) points.push_back({some(), some(), some()});
      Json node{{"mesh", d.mesh(d.floats(points))}};
      if (n == 1) node["translation"] = {some(), some(), some()}, node["scale"] = {some(), some(), some()};
      if (n == 2) node["rotation"] = {0.5, 0.5, -0.5, 0.5}, node["translation"] = {6e6, some(), some()};
      d.json["scenes"][0]["nodes"].push_back(d.node(node));
    }
    d.json["accessors"][0]["min"] = {0, 0, 0}, d.json["accessors"][0]["max"] = {0, 0, 0};  // a lie
    CHECK(check_ahead(dir.file("a.glb", d.glb())));
  }
}

TEST_CASE("a glTF tells no bounds if they would take more than its triangles", "[quick][io][bounds]") {
  const TempDir dir;
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  CHECK(check_ahead(dir.file("a.glb", d.glb())));
  Document shared;  // ten triangles of many vertices each
  const int positions = shared.floats(std::vector<Vec3d>(100, Vec3d{1, 2, 3}));
  Json primitives = Json::array();
  const int indices = shared.array<std::uint8_t>({0, 1, 2}, kU8, "SCALAR", 3);
  for (int i = 0; i < 10; ++i) primitives.push_back({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  shared.json["meshes"].push_back({{"primitives", primitives}});
  shared.node({{"mesh", 0}});
  CHECK_FALSE(check_ahead(dir.file("b.glb", shared.glb())));
}

TEST_CASE("an odd line of an OBJ is counted once, wherever it stands", "[quick][io][bounds]") {
  const TempDir dir;
  const std::string text = long_obj(4, "\n");
  const auto odd_lines = [&](const std::string& all) {
    std::optional<Bounds3d> told;
    return outcome_of(dir.file("a.obj", all), true, told).odd_lines;
  };
  CHECK(odd_lines(text) == 0);
  for (const char* const line :
       {"f 1 2 3 # 4\n", "v 5 6 7 0.5\n", "# \xE2\x80\xA8\n", "f +1 2 3\n", "f 1/99999 2/1 3/1\n"}) {
    CAPTURE(line);
    CHECK(odd_lines(text + line + text) == 1);
    CHECK(odd_lines(text + line) == 1);
  }
}
