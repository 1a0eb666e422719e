#include <cmath>

#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("an OBJ face may name its corners in every form", "[quick][io]") {
  const std::string face = GENERATE(as<std::string>(), "f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1//1 2//1 3//1 4//1",
                                    "f 1/1/1 2/2/1 3/3/1 4/4/1", "f -4 -3 -2 -1", "f 1// 2/ 3 4//1", "f 1 2 3 4 # quad",
                                    "f 1 2 \\\n 3 \\\n4", "  f\t1  2\t3 4  ", "f 1 2 \\\r\n3 4");
  const std::string end = GENERATE(as<std::string>(), "\n", "\r\n", "\r", "", "\n\x1A");
  const TempDir dir;
  const std::string path = dir.file("a.obj",
                                    "# comment\nmtllib C:\\x\\\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1.0 1e0 -0\nvt 0 0\n"
                                    "vn 0 0 1\nv +0 10e-1 0\ng x\n" +
                                        face + end);
  CAPTURE(face);
  CHECK(read_all(path) == kQuadFan);
}

TEST_CASE("an OBJ face may name vertices further down, on every pass", "[quick][io]") {
  const TempDir dir;
  const std::string path = dir.file("a.obj", "v 0 0 0\nf 1 2 3 4\nv 1 0 0\nv 1 1 0\nf 1 -2 -1 4\nv 0 1 0\n");
  const auto source = open_scene(path);
  std::vector<TriangleD> twice = kQuadFan;
  twice.insert(twice.end(), kQuadFan.begin(), kQuadFan.end());
  for (int pass = 0; pass < 3; ++pass) {
    CHECK(read_all(*source) == twice);
    source->rewind();
  }
}

TEST_CASE("an OBJ pass that was cut short leaves the next one whole", "[quick][io]") {
  const TempDir dir;
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (int i = 0; i < 20000; ++i) text += "f 1 2 3\n";  // more than one batch
  const std::string path = dir.file("a.obj", text + "f 3 2 4\nv 2 2 7\n");
  const auto source = open_scene(path);
  std::vector<TriangleD> batch;
  REQUIRE(source->read(batch));
  source->rewind();
  const auto all = read_all(*source);
  REQUIRE(all.size() == 20001);
  CHECK(all.back() == TriangleD{{{1, 1, 0}, {1, 0, 0}, {2, 2, 7}}});
  CHECK(source->counts().triangles == 20001);
}

TEST_CASE("OBJ faces without three existing corners are counted, not read", "[quick][io]") {
  const TempDir dir;
  const std::string path = dir.file(
      "a.obj",
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2\nf 1\nf\nf 1 2 4\nf 0 1 2\nf -4 1 2\nf 1 2 99999999999999999999\nf 1 2 3\n");
  const SceneCounts counts = counts_of(path);
  CHECK(counts.bad_faces == 7);
  CHECK(counts.triangles == 1);
  CHECK(counts.instances == 1);
}

TEST_CASE("OBJ faces by their old name are read, and surfaces of other lines are counted", "[quick][io]") {
  const TempDir dir;
  const SceneCounts counts =
      counts_of(dir.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 0\nf 1 2 3\nfo 1 2 4\ncall b.obj\nbsp 1 2 3 4\n"));
  CHECK(counts.triangles == 2);
  CHECK(counts.bad_faces == 2);
}

TEST_CASE("a broken OBJ line is named", "[quick][io]") {
  const TempDir dir;
  CHECK_THAT(complaint_of(dir.file("a.obj", "v 0 0 0\nv 1 0\n")), Contains("a.obj: line 2: a vertex needs three"));
  CHECK_THAT(complaint_of(dir.file("b.obj", "v 0 0 0\r\nf 1 x 1\r\n")), Contains("line 2"));
  CHECK_THAT(complaint_of(dir.file("c.obj", "\nv 0 0 0\nf 1a 1 1\n")), Contains("line 3"));
  CHECK_THAT(complaint_of(dir.file("d.obj", std::string("v 0 0 0\n\0\0\0", 11))), Contains("control character"));
  CHECK_THAT(complaint_of(dir.file("e.obj", "v 0 0 " + std::string(100000, '7') + "x\n")), Contains("line 1"));
}

TEST_CASE("numbers too long, too large and too small are read for what they are", "[quick][io]") {
  const TempDir dir;
  const std::string digits(9000, '3');
  const auto read = read_all(dir.file("a.obj", "v 0." + digits + " 1e-400 1e-91\nv 1e5 0 0\nv 0 -1e5 0\nf 1 2 3\n"));
  REQUIRE(read.size() == 1);
  CHECK(read[0][0] == Vec3d{1.0 / 3, 0, 0});
  CHECK(!std::signbit(read[0][0][1]));
  const std::string tail = "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const char* bad :
       {"1e400 0 0", "nan 0 0", "0 -NaN 0", "0 0 +inf", "1.#INF 0 0", "-1.#IND 0 0", "1.#QNAN 0 0", "0 Infinity 0"}) {
    CAPTURE(bad);
    const SceneCounts counts = counts_of(dir.file("b.obj", "v " + std::string(bad) + tail));
    CHECK(counts.non_finite == 1);
    CHECK(counts.triangles == 0);
  }
}

TEST_CASE("text keeps every digit of a georeferenced coordinate", "[quick][io]") {
  const TempDir dir;
  const Vec3d far{6801760.1234567891, -455564.98765432101, 0.1 + 0.2};
  const auto read =
      read_all(dir.file("a.obj", fmt::format("v {} {} {}\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", far[0], far[1], far[2])));
  REQUIRE(read.size() == 1);
  CHECK(read[0][0] == far);
}

TEST_CASE("an OBJ that breaks off within a face is truncated, and one without a last line end is not", "[quick][io]") {
  const TempDir dir;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n";
  for (const char* const end : {"f", "f ", "f 1 2", "f 1/", "f 1 2 5", "f 1 2 -9", "f 1 2 0"}) {
    CAPTURE(end);
    CHECK_THAT(complaint_of(dir.file("cut.obj", vertices + end)),
               Contains("line 6: the file ends") && Contains("truncated"));
  }
  for (const char* const end : {"f 1 2 4", "f 1 2 4 ", "f 1/ 2/ 4/", "f -1 -2 -3", "f 1 2 4 # f 1", "g", "# f 1"}) {
    CAPTURE(end);
    CHECK(counts_of(dir.file("whole.obj", vertices + end)).bad_faces == 0);
  }
  for (const char* const end : {"f 1 2\n", "f 1 2 5\n", "f 1 2\n# end", "f 1 2\r\n"}) {
    CAPTURE(end);
    CHECK(counts_of(dir.file("bad.obj", vertices + end)).bad_faces == 1);
  }
}

TEST_CASE("OFF headers come in many shapes", "[quick][io]") {
  const std::string header =
      GENERATE(as<std::string>(), "OFF\n4 1 0\n", "OFF 4 1 0\n", "  OFF4 1 0 # glued\n", "4 1 0\n",
               "# first\n\nCOFF\n# counts\n4 1\n", "NOFF\r\n4 1 6\r\n", "STOFF\n4 1 0\n", "\xEF\xBB\xBFOFF\n4 1 0\n");
  const TempDir dir;
  const std::string path = dir.file(
      "a.off",
      header + "0 0 0 255 0 0\n# between\n\n1 0 0 # x\n  1 1\n 0\n0 1 0 0.5 0.5\n\n4 0 1 2 3 0.1 0.2 0.3 # end");
  CAPTURE(header);
  CHECK(read_all(path) == kQuadFan);
}

TEST_CASE("OFF files that promise more than they hold are refused before memory is taken", "[quick][io]") {
  const TempDir dir;
  CHECK_THAT(complaint_of(dir.file("a.off", "OFF\n353535235358 6 0\n0 0 0\n")), Contains("truncated"));
  CHECK_THAT(complaint_of(dir.file("b.off", "OFF\n1 353535235358 0\n0 0 0\n3 0 0 0\n")), Contains("truncated"));
  CHECK_THAT(complaint_of(dir.file("c.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0")), Contains("truncated"));
  CHECK_THAT(complaint_of(dir.file("d.off", "OFF\n-3 2 0\n")), Contains("negative"));
  CHECK_THAT(complaint_of(dir.file("e.off", "OFF BINARY\n")), Contains("binary OFF"));
  CHECK_THAT(complaint_of(dir.file("f.off", "4OFF\n1 0 0\n0 0 0 1\n")), Contains("4OFF"));
  CHECK_THAT(complaint_of(dir.file("g.off", "HELLO\n")), Contains("starts with 'HELLO'"));
  CHECK_THAT(complaint_of(dir.file("h.off", "")), Contains("is empty"));
  CHECK_THAT(complaint_of(dir.file("i.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n")), Contains("line 6"));
  CHECK(counts_of(dir.file("j.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n2 0 1\n3 0 1 2\n")).bad_faces == 2);
}

TEST_CASE("ASCII STL is read with several solids, capitals and odd spacing", "[quick][io]") {
  const TempDir dir;
  const std::string facet =
      "facet normal 0 0 1\n outer loop\n vertex 0 0 0\nvertex 1 0 0\n\tvertex 1 1 0\nendloop endfacet\n";
  const std::string other =
      "FACET NORMAL nan nan nan\r\nOUTER LOOP\r\nVERTEX 0 0 0 VERTEX 1 1 0 VERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\n";
  CHECK(read_all(dir.file("a.stl", "solid a vertex 1 2 3\n" + facet + "endsolid a\nsolid\n" + other + "endsolid\n")) ==
        kQuadFan);
  const std::string quad =
      "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid";
  CHECK(read_all(dir.file("b.stl", quad)) == kQuadFan);
  CHECK(read_all(dir.file("c.stl", "solid Empty\nendsolid Empty")).empty());
  CHECK(counts_of(dir.file("d.stl",
                           "solid\nfacet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 endloop endfacet\nendsolid"))
            .bad_faces == 1);
}

TEST_CASE("broken ASCII STL is refused with its line", "[quick][io]") {
  const TempDir dir;
  const std::string start = "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  CHECK_THAT(complaint_of(dir.file("a.stl", start)), Contains("endsolid"));
  CHECK_THAT(complaint_of(dir.file("b.stl", start + "vertex 1 one 0\n")), Contains("line 6"));
  CHECK_THAT(complaint_of(dir.file("c.stl", start + "vortex 1 1 0\n")), Contains("'vortex'"));
  CHECK_THAT(complaint_of(dir.file("d.stl", "solid")), Contains("neither"));
}
