#include <limits>

#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

template <class T>
std::string vec(const Vec3d& p, bool big = false) {
  return raw(T(p[0]), big) + raw(T(p[1]), big) + raw(T(p[2]), big);
}

std::string ply_header(const std::string& format, const std::string& body) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nobj_info nothing\n" + body + "end_header\n";
}

template <class Coord, class Index>
std::string binary_quad(bool big, const std::string& coord_type, const std::string& index_type) {
  std::string bytes = ply_header(big ? "binary_big_endian" : "binary_little_endian",
                                 "element vertex 4\nproperty uchar red\nproperty " + coord_type + " x\nproperty " +
                                     coord_type + " y\nproperty " + coord_type +
                                     " z\nproperty short quality\nelement face 1\nproperty int id\n"
                                     "property list uchar " +
                                     index_type +
                                     " vertex_indices\nproperty list uint16 double texcoord\n"
                                     "element edge 1\nproperty int vertex1\n");
  for (const Vec3d& p : kQuad) bytes += raw(std::uint8_t(7)) + vec<Coord>(p, big) + raw(std::int16_t(-3), big);
  bytes += raw(std::int32_t(5), big) + raw(std::uint8_t(4), big);
  for (int i = 0; i < 4; ++i) bytes += raw(Index(i), big);
  return bytes + raw(std::uint16_t(2), big) + raw(0.5, big) + raw(0.25, big) + raw(std::int32_t(0), big);
}

std::string stl_of(const std::string& header, std::uint32_t promised, const std::vector<TriangleD>& triangles) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  bytes += raw(promised);
  for (const TriangleD& t : triangles) {
    bytes += vec<float>({0, 0, 1});
    for (const Vec3d& p : t) bytes += vec<float>(p);
    bytes += raw(std::uint16_t(0));
  }
  return bytes;
}

}  // namespace

TEST_CASE("binary PLY is read in both byte orders and every type", "[quick][io]") {
  const bool big = GENERATE(false, true);
  const TempDir dir;
  CHECK(read_all(dir.file("1.ply", binary_quad<float, std::int32_t>(big, "float", "int"))) == kQuadFan);
  CHECK(read_all(dir.file("2.ply", binary_quad<double, std::uint32_t>(big, "float64", "uint32"))) == kQuadFan);
  CHECK(read_all(dir.file("3.ply", binary_quad<std::int16_t, std::uint16_t>(big, "short", "ushort"))) == kQuadFan);
  CHECK(read_all(dir.file("4.ply", binary_quad<std::uint8_t, std::uint8_t>(big, "uchar", "uint8"))) == kQuadFan);
  CHECK(read_all(dir.file("5.ply", binary_quad<std::int32_t, float>(big, "int32", "float32"))) == kQuadFan);
  CHECK(read_all(dir.file("6.ply", binary_quad<std::int8_t, std::int16_t>(big, "int8", "int16"))) == kQuadFan);
  CHECK(read_all(dir.file("7.ply", binary_quad<std::uint32_t, std::int8_t>(big, "uint", "char"))) == kQuadFan);
  CHECK(read_all(dir.file("8.ply", binary_quad<std::int64_t, std::uint64_t>(big, "int64", "ulong"))) == kQuadFan);
}

TEST_CASE("PLY elements may come in any order, and vertices may hold lists", "[quick][io]") {
  const TempDir dir;
  std::string bytes = ply_header(
      "binary_little_endian",
      "element material 2\nproperty float shine\nelement face 1\nproperty list int short vertex_index\n"
      "element vertex 4\nproperty double z\nproperty list uchar char tags\nproperty float y\nproperty int x\n");
  bytes += raw(0.5f) + raw(0.5f) + raw(std::int32_t(4));
  for (int i = 0; i < 4; ++i) bytes += raw(std::int16_t(i));
  for (const Vec3d& p : kQuad)
    bytes += raw(p[2]) + raw(std::uint8_t(2)) + "ab" + raw(float(p[1])) + raw(std::int32_t(p[0]));
  const auto source = open_scene(dir.file("a.ply", bytes));
  CHECK(read_all(*source) == kQuadFan);
  source->rewind();
  CHECK(read_all(*source) == kQuadFan);
  const std::string text = ply_header("ascii",
                                      "element face 1\nproperty list int short vertex_index\nelement vertex 4\n"
                                      "property float z\nproperty float x\nproperty float y\n");
  CHECK(read_all(dir.file("b.ply", text + "4 0 1 2 3.0\n0 0 0\n0 1 0\n0 1 1\n0\n0 1")) == kQuadFan);
}

TEST_CASE("an ASCII PLY record ends with its line, whatever the header forgot", "[quick][io]") {
  const TempDir dir;
  const std::string header =
      ply_header("ascii",
                 "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                 "element face 1\nproperty list uchar int vertex_indices\nproperty uchar red\n");
  const auto scene =
      open_scene(dir.file("a.ply", header + "0 0 0 9 9 9\n\n1 0 0 9\n1 1 0 9 9\n0 1 0\n9\n4 0 1 2 3 9 1 1 1\n"));
  CHECK(read_all(*scene) == kQuadFan);
  CHECK(scene->counts().unfollowed.lines == 4);  // all but one vertex have other words than the header promises
}

TEST_CASE("PLY triangle strips turn every other triangle, and restart at a negative index", "[quick][io]") {
  const TempDir dir;
  const std::string header =
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 2\nproperty list int int vertex_indices\n";
  std::string bytes = ply_header("binary_little_endian", header);
  for (const int v : {0, 1, 3, 2}) bytes += vec<float>(kQuad[v]);
  bytes += raw(9);
  for (const int i : {0, 1, 2, 3, -1, 0, 1, 2, -1}) bytes += raw(i);
  bytes += raw(0);
  const TriangleD a{kQuad[0], kQuad[1], kQuad[3]}, b{kQuad[3], kQuad[1], kQuad[2]};
  CHECK(read_all(dir.file("a.ply", bytes)) == std::vector<TriangleD>{a, b, a});
}

TEST_CASE("a PLY without faces is an empty mesh, and as a scene a point cloud", "[quick][io]") {
  const TempDir dir;
  const std::string points = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 0\nproperty list uchar int vertex_indices\n";
  const std::string bytes =
      GENERATE_COPY(ply_header("ascii", points) + "1 2 3\n", ply_header("ascii", points + faces) + "1 2 3",
                    ply_header("binary_little_endian", points + faces) + raw(1.f) + raw(2.f) + raw(3.f));
  const std::string path = dir.file("a.ply", bytes);
  CHECK(read_mesh(path).triangles.empty());
  CHECK_THAT(complaint_of(path), Contains("no triangles: 1 point; a point cloud needs a surface first"));
}

TEST_CASE("a PLY that is cut anywhere is refused, and never read beyond", "[quick][io]") {
  const TempDir dir;
  const std::string whole = binary_quad<float, std::int32_t>(false, "float", "int");
  for (std::size_t cut = 0; cut + 5 < whole.size(); ++cut) {  // the last element is not needed
    const std::string path = dir.file("cut.ply", whole.substr(0, cut));
    CAPTURE(cut);
    const std::string complaint = complaint_of(path);
    CHECK_THAT(complaint, Contains("cut.ply"));
    if (cut > whole.find("end_header") + 11) CHECK_THAT(complaint, Contains("truncated"));
  }
}

TEST_CASE("PLY headers that lie are refused without taking memory", "[quick][io]") {
  const TempDir dir;
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  for (const char* format : {"ascii", "binary_little_endian"}) {
    CAPTURE(format);
    CHECK_THAT(
        complaint_of(dir.file("a.ply", ply_header(format, "element vertex 999999999999\n" + xyz + faces) + "0 0 0\n")),
        Contains("truncated"));
    CHECK_THAT(complaint_of(dir.file("b.ply", ply_header(format, "element vertex -1\n" + xyz + faces))),
               Contains("count"));
    CHECK_THAT(complaint_of(dir.file("c.ply", ply_header(format, "element vertex 0\nproperty float x\n" + faces))),
               Contains("'y'"));
    CHECK_THAT(complaint_of(dir.file("d.ply", ply_header(format, "element vertex 0\nproperty quad x\n"))),
               Contains("line 6: 'quad'"));
  }
  CHECK_THAT(complaint_of(dir.file("e.ply", "ply\nelement vertex 1\n")), Contains("end_header"));
  CHECK_THAT(complaint_of(dir.file("f.ply", "plywood\n")), Contains("not a PLY"));
  const std::string huge_list = ply_header(
      "binary_little_endian", "element vertex 0\n" + xyz + "element face 1\nproperty list uint int vertex_indices\n");
  CHECK_THAT(complaint_of(dir.file("g.ply", huge_list + raw(~std::uint32_t(0)))), Contains("4294967295"));
  const std::string negative = ply_header(
      "binary_little_endian", "element vertex 0\n" + xyz + "element face 1\nproperty list char int vertex_indices\n");
  CHECK_THAT(complaint_of(dir.file("h.ply", negative + raw(std::int8_t(-1)))), Contains("not a count"));
}

TEST_CASE("PLY faces that name no vertex are counted", "[quick][io]") {
  const TempDir dir;
  const std::string header = ply_header("ascii",
                                        "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                                        "element face 5\nproperty list uchar int vertex_indices\n");
  const SceneCounts counts =
      counts_of(dir.file("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n3 0 -1 2\n2 0 1\n0\n"));
  CHECK(counts.triangles == 1);
  CHECK(counts.bad_faces == 4);
}

TEST_CASE("binary STL is known by its size, also when it starts with the word solid", "[quick][io]") {
  const TempDir dir;
  CHECK(read_all(dir.file("a.stl", stl_of("solid exported by a CAD", 2, kQuadFan))) == kQuadFan);
  CHECK(read_all(dir.file("b.stl", stl_of("COLOR=", 2, kQuadFan))) == kQuadFan);
  CHECK(read_all(dir.file("c.stl", stl_of("solid with blanks behind", 2, kQuadFan) + "\r\n")) == kQuadFan);
  CHECK_THAT(complaint_of(dir.file("f.stl", stl_of("solid with more behind", 2, kQuadFan) + "extra bytes")),
             Contains("data begin that the header does not promise"));
  CHECK(read_all(dir.file("d.stl", stl_of("", 0, {}))).empty());
  CHECK_THAT(complaint_of(dir.file("g.stl", stl_of("", 1, kQuadFan))),
             Contains("triangles in its header is 1, and it holds 2"));
  CHECK_THAT(complaint_of(dir.file("h.stl", stl_of("", 0, kQuadFan))),
             Contains("triangles in its header is 0, and it holds 2"));
  const std::string whole = stl_of("solid", 2, kQuadFan);
  for (std::size_t cut = 0; cut < whole.size(); ++cut)
    CHECK(!complaint_of(dir.file("e.stl", whole.substr(0, cut))).empty());
  CHECK_THAT(complaint_of(dir.file("f.stl", stl_of("", 4000000000u, kQuadFan))), Contains("truncated"));
}

TEST_CASE("triangles without area are delivered to those who ask for them", "[quick][io]") {
  const TempDir dir;
  const Vec3d a{0, 0, 0}, b{1, 2, 3}, c{2, 4, 6}, d{1, 0, 0};
  SceneOptions options;
  options.keep_degenerate = true;
  const auto source = open_scene(dir.file("a.stl", stl_of("", 3, {{a, b, c}, {a, b, d}, {a, a, a}})), options);
  CHECK(read_all(*source).size() == 3);
  CHECK(source->counts().kept_degenerate == 2);
  CHECK(source->counts().has_area());
  const auto flat = open_scene(dir.file("b.stl", stl_of("", 1, {{a, b, c}})), options);
  CHECK(read_all(*flat).size() == 1);
  CHECK_FALSE(flat->counts().has_area());
}

TEST_CASE("triangles without area or place are counted and left out", "[quick][io]") {
  const TempDir dir;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Vec3d a{0, 0, 0}, b{1, 2, 3}, c{2, 4, 6}, d{1, 0, 0};
  const std::string path =
      dir.file("a.stl", stl_of("", 5, {{a, b, c}, {a, b, a}, {a, b, {kNan, 0, 0}}, {a, b, d}, {a, a, a}}));
  const SceneCounts counts = counts_of(path);
  CHECK(counts.triangles == 1);
  CHECK(counts.degenerate == 3);
  CHECK(counts.non_finite == 1);
  SceneCounts kept;
  const IndexedMesh mesh = read_mesh(path, {}, &kept);
  CHECK(mesh.triangles.size() == 5);
  CHECK(mesh.vertices.size() == 5);
  CHECK(kept.degenerate == 3);
  CHECK(kept.non_finite == 1);
  CHECK(kept.triangles == 5);
}
