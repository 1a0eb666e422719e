// ASCII PLY and STL are read in blocks on all cores, as one thread reads them from the first line to the last.
#include <random>

#include "lib/core/box.h"
#include "lib/core/parallel.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

struct Reading {
  std::vector<TriangleD> triangles;
  std::vector<std::uint8_t> inner_edges;
  std::string complaint;
  std::uint64_t bad_faces = 0, odd_lines = 0;
  friend bool operator==(const Reading&, const Reading&) = default;
};

/// Reads to the end, twice; with `ahead`, the bounds first.
Reading reading_of(const std::string& path, bool ahead = false) {
  Reading outcome;
  try {
    const auto source = open_scene(path);
    if (ahead) (void)source->bounds();
    outcome.triangles = read_all(*source);
    outcome.bad_faces = source->counts().bad_faces;
    outcome.odd_lines = source->counts().unfollowed.lines;
    source->rewind();
    outcome.inner_edges = read_inner_edges(*source);
  } catch (const Error& e) {
    outcome.complaint = e.what();
  }
  return outcome;
}

std::string number(std::mt19937& random) {
  const int n = int(random() % 2000001) - 1000000;
  switch (random() % 4) {
    case 0:
      return std::to_string(n);
    case 1:
      return std::to_string(n) + "e-3";
    default:
      return std::to_string(double(n) / 997);
  }
}

/// A PLY in two ways: as blocks can read it, and with an element that makes one thread read it. Their lines have the
/// same numbers.
struct TwoPly {
  std::string plain, slow;
};

TwoPly ply_of(int vertices, int faces, const std::string& lines) {
  const std::string begin = "ply\nformat ascii 1.0\n", end = "end_header\n";
  const std::string elements = "element vertex " + std::to_string(vertices) +
                               "\nproperty float x\nproperty uchar red\nproperty float z\nproperty float y\n"
                               "element face " +
                               std::to_string(faces) + "\nproperty list uchar int vertex_indices\nproperty int flags\n";
  return {begin + "comment a\ncomment b\n" + elements + end + lines,
          begin + "element nothing 0\nproperty int a\n" + elements + end + lines};
}

/// Some hundred kilobytes of vertices, and as many of faces: polygons, and some that name no vertex.
struct LongPly {
  int vertices = 20000, faces = 30000;
  std::string lines;
  LongPly(unsigned seed, const std::string& line_end) {
    std::mt19937 random(seed);
    const char* const blanks[] = {" ", "  ", "\t"};
    for (int i = 0; i < vertices; ++i) {
      const std::string blank = blanks[random() % 3];
      lines += (random() % 9 == 0 ? blank : "") + number(random) + blank + "255 " + number(random) + blank;
      lines += number(random) + (random() % 9 == 0 ? " more words" : "") + line_end;
    }
    for (int i = 0; i < faces; ++i) {
      const unsigned corners = random() % 9 == 0 ? random() % 9 : 3;
      lines += std::to_string(corners);
      for (unsigned k = 0; k < corners; ++k)
        lines += " " + std::to_string(random() % 5000 == 0 ? -1 : int(random() % unsigned(vertices + 1)));
      lines += "\t1 " + line_end;
    }
  }
};

std::string long_stl(unsigned seed, const std::string& line_end, int facets) {
  std::mt19937 random(seed);
  std::string text = "solid a b c" + line_end;
  for (int i = 0; i < facets; ++i) {
    text += (random() % 5 == 0 ? "\t" : "  ") + std::string("facet normal 0 nan 1e0") + line_end;
    text += "    outer loop" + line_end;
    for (int k = 0; k < 3; ++k)
      text += "vertex " + number(random) + "\t" + number(random) + " " + number(random) + line_end;
    text += "endloop " + line_end + "  endfacet" + line_end;
    if (random() % 999 == 0) text += "endsolid" + line_end + "solid facets" + line_end;
  }
  return text + "endsolid a b c" + line_end;
}

Reading on_one_thread(const std::string& path) {
  const ThreadLimit one(1);
  return reading_of(path);
}

/// Checks that a file is read on four threads as on one, whether its bounds are asked for or not.
Reading check_blocks(const std::string& path, const std::string& slow) {
  const Reading expected = on_one_thread(slow);
  const ThreadLimit four(4);
  Reading outcome = reading_of(path), ahead = reading_of(path, true);
  for (Reading* o : {&outcome, &ahead}) {
    if (path != slow && o->complaint.starts_with(path)) o->complaint.replace(0, path.size(), slow);
    CHECK((*o == expected));
    CHECK(o->complaint == expected.complaint);
  }
  return outcome;
}

}  // namespace

TEST_CASE("an ASCII PLY is read in blocks as by one thread", "[quick][io][blocks]") {
  const TempDir dir;
  for (const char* const line_end : {"\n", "\r\n"}) {
    const LongPly ply(line_end[0], line_end);
    const auto [plain, slow] = ply_of(ply.vertices, ply.faces, ply.lines);
    const Reading outcome = check_blocks(dir.file("a.ply", plain), dir.file("b.ply", slow));
    CHECK(outcome.triangles.size() > 20000);
    CHECK(outcome.bad_faces > 100);
    const ThreadLimit four(4);
    SceneOptions little;
    little.memory_bytes = 100000;  // vertices go to a scratch file
    CHECK((read_all(dir.path("a.ply"), little) == outcome.triangles));
    CHECK(open_scene(dir.path("a.ply"))->bounds() == open_scene(dir.path("b.ply"))->bounds());
  }
}

TEST_CASE("an ASCII PLY with odd lines is read, or refused, as by one thread", "[quick][io][blocks]") {
  const TempDir dir;
  const std::vector<std::string> vertices{
      "+1 2 3 4\n",    "1 2 3\n4\n",   "\n1 2 3 4\n",  "1 2 3 4\r",        "1 2 3\r4\n",    "1 2 3 x\n",
      "1 2 1e999 4\n", "1 2 3 4#c\n",  "1 2 3 4 \\\n", "1 2 3 4\v\n",      "\f1 2 3 4\n",   "1 2 nan 4\n",
      "1 2 0x1 4\n",   "1 2 3 \x01\n", "1 2 3",        "1 2 1.#INF 4\n",   "1\x01 2 3 4\n", "1 256 3 4\n",
      "1 2.5 3 4\n",   "1 +2 3 4\n",   "1 -2 3 4\n",   "1 2 3\xC2\xA0 4\n"};
  const std::vector<std::string> faces{"3 0 1 2 0",
                                       "3 0 1 2\n0\n",
                                       "\n3 0 1 2 0\n",
                                       "3 0 1 2.0 0\n",
                                       "3 0 1 +2 0\n",
                                       "-3 0 1 2 0\n",
                                       "3 0 1\n",
                                       "3 0 1 2 0\r",
                                       "3 0 1 2#\n",
                                       "2 0 1 0\n",
                                       "0 0\n",
                                       "3 0 1 -2 0\n",
                                       "3.0 0 1 2 0\n",
                                       "3 0 1 x 0\n",
                                       "9999999 0 1\n",
                                       "3 0 1 99999999999999999999 0\n",
                                       "3 0 1 2 0 9 9\n",
                                       "3 0 1 2\t\x01\n",
                                       "3 0 1 2 1.5\n",
                                       "3 0 1 2 9999999999\n",
                                       "3 0 1 9999999999 0\n",
                                       "3 0 1\n2 0\n",
                                       ""};
  const LongPly ply(3, "\n");
  const std::string good = "0 0 0 0\n1 0 0 0\n0 0 1 1\n", face = "3 0 1 2 0\n";
  const std::size_t behind_vertices = [&] {
    std::size_t at = 0;
    for (int i = 0; i < ply.vertices; ++i) at = ply.lines.find('\n', at) + 1;
    return at;
  }();
  const auto check = [&](int n, int m, const std::string& lines) {
    const auto [plain, slow] = ply_of(n, m, lines);
    (void)check_blocks(dir.file("a.ply", plain), dir.file("b.ply", slow));
  };
  for (const std::string& line : vertices) {
    CAPTURE(line);
    check(4, 1, line + good + face);
    check(4, 1, good + line + face);
    std::string lines = ply.lines;
    check(ply.vertices + 1, ply.faces, lines.insert(behind_vertices, line));
  }
  for (const std::string& line : faces) {
    CAPTURE(line);
    check(3, 2, good + line + face);
    check(3, 2, good + face + line);
    check(ply.vertices, ply.faces + 1, ply.lines + line);
  }
  check(3, 0, good);
  check(0, 1, face);
  check(3, 1, good + face + "words behind\n");
}

TEST_CASE("an ASCII STL is read in blocks as by one thread", "[quick][io][blocks]") {
  const TempDir dir;
  for (const char* const line_end : {"\n", "\r\n"}) {
    for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
      const std::string path = dir.file("a.stl", mark + long_stl(line_end[0], line_end, 6000));
      const Reading outcome = check_blocks(path, path);
      CHECK(outcome.triangles.size() > 5900);
      const auto source = open_scene(path);
      Bounds3d box;
      for (const TriangleD& t : outcome.triangles) {
        for (const Vec3d& p : t) box.add(p);
      }
      CHECK(source->bounds() == box);
    }
  }
}

TEST_CASE("lines of an ASCII STL that programs read in different ways are counted", "[quick][io][blocks]") {
  const TempDir dir;
  const std::string stl = long_stl(9, "\n", 6000);
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  const auto odd_lines = [&](const std::string& text) {
    const std::string path = dir.file("a.stl", text);
    const Reading outcome = check_blocks(path, path);
    CHECK(outcome.complaint.empty());
    return outcome.odd_lines;
  };
  CHECK(odd_lines(stl) == 0);
  CHECK(odd_lines(stl + facet + "endloop\nendfacet\n") == 1);  // outside of a solid
  CHECK(odd_lines(stl + "solid\n" + facet + "vertex 0 0 1\nendloop\nendfacet\nendsolid\n") == 1);
  CHECK(odd_lines(stl + "solid\n" + facet + "endloop\nendsolid\n") == 1);
  CHECK(odd_lines(stl + "solid vertex\n" + facet + "endfacet\nendsolid\n") == 1);
  CHECK(odd_lines(stl + "solid\n" + facet + "endfacet\nendsolid\n") == 0);
  // The CR is the last byte of a block and of the scanner's buffer, or stands beside it.
  constexpr std::size_t kBlock = std::size_t(1) << 18;
  for (std::size_t before = kBlock - 3; before <= kBlock + 1; ++before) {
    std::string begin = "solid\n" + facet + "endloop\nendfacet\nendsolid\n";
    begin.resize(before, ' ');
    for (std::size_t i = 199; i < begin.size(); i += 100) begin[i] = '\n';
    CHECK(odd_lines(begin + "\r\n" + stl) == 0);
    CHECK(odd_lines(begin + "\r" + stl) == 1);
  }
}

TEST_CASE("an ASCII STL with odd lines is read, or refused, as by one thread", "[quick][io][blocks]") {
  const TempDir dir;
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const std::vector<std::string> odd{
      "facet normal 0 0 1 outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
      "facet normal 0 0\n1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 1 1\nendloop\nendfacet\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 +0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e999 0\nendloop\nendfacet\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\n\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
      "FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0 7\nvertex 0 1 0\nendloop\nendfacet\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1\nendloop\nendfacet\n",
      "endloop\n",
      "color 1 2 3\n",
      "solid b\n",
      "solid outer\n",
      "endsolid\nsolid x vertex 1 2 3\n",
      "facet vertex 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
      "facet normal 0 0 1\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n",
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\rvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
      "endsolid\n",
      "word\n",
      "\n",
      "  \n",
      "\r",
      "vertex 1 2 3\n",
      "outer loop\n",
      "\x01\n",
      "facet\n"};
  for (const std::string& lines : odd) {
    CAPTURE(lines);
    for (const std::string& text :
         {"solid\n" + lines + facet + "endsolid\n", "solid\n" + facet + lines, long_stl(4, "\n", 3000) + lines + facet,
          lines + long_stl(5, "\n", 3000), long_stl(6, "\n", 2000) + lines + long_stl(7, "\n", 2000)}) {
      const std::string path = dir.file("a.stl", text);
      (void)check_blocks(path, path);
    }
  }
  // Ends of the file around the end of a block.
  const std::string whole = long_stl(8, "\n", 2600);
  for (std::size_t size = (std::size_t(1) << 18) - 40; size < (std::size_t(1) << 18) + 200; size += 7) {
    const std::string path = dir.file("a.stl", whole.substr(0, size));
    (void)check_blocks(path, path);
    std::string shifted = "solid " + std::string(size % 300, 'x') + "\n" + whole;
    const std::string other = dir.file("b.stl", shifted);
    (void)check_blocks(other, other);
  }
}
