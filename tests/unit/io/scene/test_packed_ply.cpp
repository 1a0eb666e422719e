#include <limits>
#include <random>

#include "lib/core/parallel.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A file of random polygons, some of which name no vertex, as text and in both byte orders. Text is for the general
/// reader, the others are for the one under test.
struct Polygons {
  std::string text, little, big;

  Polygons(unsigned seed, int vertices, int faces, bool wide) {
    std::mt19937 random(seed);
    const std::string xyz = wide ? "double" : "float";
    const std::string body = "element camera 1\nproperty short focus\nelement vertex " + std::to_string(vertices) +
                             "\nproperty uchar red\nproperty " + xyz + " x\nproperty " + xyz + " y\nproperty " + xyz +
                             " z\nelement face " + std::to_string(faces) + "\nproperty short before\nproperty list " +
                             (wide ? "ushort uint" : "uchar int") + " vertex_index\nproperty double after\n" +
                             "element edge 1\nproperty list uchar int ends\n";
    text = "ply\nformat ascii 1.0\n" + body + "end_header\n7\n";
    little = "ply\nformat binary_little_endian 1.0\n" + body + "end_header\n" + raw(std::int16_t(7));
    big = "ply\nformat binary_big_endian 1.0\n" + body + "end_header\n" + raw(std::int16_t(7), true);
    for (int i = 0; i < vertices; ++i) {
      text += "3";
      both(std::uint8_t(3));
      for (int k = 0; k < 3; ++k) {
        const double c = double(int(random() % 17) - 8) / 4;
        text += " " + std::to_string(c);
        wide ? both(c) : both(float(c));
      }
      text += "\n";
    }
    for (int i = 0; i < faces; ++i) {
      const unsigned corners = random() % 50 == 0 ? random() % 250 : random() % 6;
      text += "-1 " + std::to_string(corners);
      both(std::int16_t(-1));
      wide ? both(std::uint16_t(corners)) : both(std::uint8_t(corners));
      for (unsigned k = 0; k < corners; ++k) {
        const auto corner = std::int32_t(random() % 100 == 0 ? vertices : int(random() % unsigned(vertices)));
        text += " " + std::to_string(corner);
        both(corner);
      }
      text += " 0.5\n";
      both(0.5);
    }
    text += "0\n";
    both(std::uint8_t(0));
  }

 private:
  template <class T>
  void both(T value) {
    little += raw(value);
    big += raw(value, true);
  }
};

Bounds3d bounds_of(const std::vector<TriangleD>& triangles) {
  Bounds3d bounds;
  for (const TriangleD& t : triangles)
    for (const Vec3d& p : t) bounds.add(p);
  return bounds;
}

}  // namespace

TEST_CASE("a packed PLY gives the triangles that the general reader gives", "[quick][io]") {
  const bool wide = GENERATE(false, true);
  const int faces = GENERATE(1, 700, 40000);  // one; one block; some blocks
  const ThreadLimit threads(GENERATE(1, 2));
  const std::uint64_t memory =
      GENERATE(std::uint64_t(1) << 12, std::uint64_t(1) << 26);  // caches; all vertices held if they are far apart
  const int vertices = faces == 700 ? 100000 : 1000;             // too far apart for one read; near each other
  CAPTURE(wide, faces, memory);
  const Polygons files(unsigned(faces), vertices, faces, wide);
  const TempDir dir;
  SceneOptions options;
  options.memory_bytes = memory;
  const auto expected = open_scene(dir.file("a.ply", files.text));
  const std::vector<TriangleD> triangles = read_all(*expected);
  expected->rewind();
  const std::vector<std::uint8_t> inner_edges = read_inner_edges(*expected);
  CHECK(inner_edges.size() == triangles.size());
  for (const std::string& bytes : {files.little, files.big}) {
    const auto source = open_scene(dir.file("b.ply", bytes), options);
    for (int pass = 0; pass < 2; ++pass) {
      CHECK((read_all(*source) == triangles));
      CHECK(source->counts().triangles == expected->counts().triangles);
      CHECK(source->counts().bad_faces == expected->counts().bad_faces);
      CHECK(source->counts().degenerate == expected->counts().degenerate);
      source->rewind();
    }
    CHECK((read_inner_edges(*source) == inner_edges));
    CHECK((read_mesh(dir.path("b.ply")).inner_edges == read_mesh(dir.path("a.ply")).inner_edges));
    CHECK(read_mesh(dir.path("b.ply")).triangles.size() == read_mesh(dir.path("a.ply")).triangles.size());
  }
}

TEST_CASE("files of vertices and of triangles tell their bounds before they are read", "[quick][io]") {
  const TempDir dir;
  const ThreadLimit threads(GENERATE(1, 2));
  for (const bool wide : {false, true}) {
    const Polygons files(7, 40000, 200000, wide);  // every vertex has a face
    for (const std::string& bytes : {files.little, files.big}) {
      const auto source = open_scene(dir.file("a.ply", bytes));
      CHECK(source->bounds() == bounds_of(read_all(*source)));
      CHECK_FALSE(source->bounds()->empty());
    }
  }
  std::mt19937 random(3);
  std::string stl(80, ' ');
  stl += raw(std::uint32_t(50000));
  for (int i = 0; i < 50000; ++i) {
    for (int k = 0; k < 12; ++k) stl += raw(float(int(random() % 2001) - 1000) / 7);
    stl += raw(std::uint16_t(0));
  }
  const auto source = open_scene(dir.file("a.stl", stl));
  const std::optional<Bounds3d> told = source->bounds();
  const std::vector<TriangleD> triangles = read_all(*source);
  CHECK(triangles.size() == 50000);
  CHECK(told == bounds_of(triangles));
  source->rewind();
  CHECK((read_all(*source) == triangles));
  CHECK_FALSE(open_scene(dir.file("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"))->bounds());
}

TEST_CASE("a packed PLY that is cut anywhere is refused", "[quick][io]") {
  const TempDir dir;
  const std::string whole = Polygons(3, 5, 4, false).little;
  CHECK(complaint_of(dir.file("cut.ply", whole)).empty());
  CHECK(complaint_of(dir.file("cut.ply", whole + std::string(3, '\0') + "\r\n")).empty());
  CHECK_THAT(complaint_of(dir.file("cut.ply", whole + "\x03")), Contains("does not promise"));
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    CAPTURE(cut);
    const std::string complaint = complaint_of(dir.file("cut.ply", whole.substr(0, cut)));
    CHECK_THAT(complaint, Contains("cut.ply"));
    if (cut > whole.find("end_header") + 11) CHECK_THAT(complaint, Contains("truncated"));
  }
}

TEST_CASE("the faces of a packed PLY may be of any size up to a limit", "[quick][io]") {
  const TempDir dir;
  const auto file = [&](std::int32_t promised, std::int32_t corners) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list int uchar vertex_indices\nend_header\n";
    for (const float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) bytes += raw(c);
    bytes += raw(promised);
    for (std::int32_t i = 0; i < corners; ++i) bytes += raw(std::uint8_t(i % 3));
    return dir.file("a.ply", bytes);
  };
  const SceneCounts counts = counts_of(file(900000, 900000));
  CHECK(counts.triangles + counts.degenerate == 900000 - 2);
  CHECK_THAT(complaint_of(file(900000, 899999)), Contains("truncated"));
  CHECK_THAT(complaint_of(file(2000000, 2000000)), Contains("2000000 corners"));
  CHECK_THAT(complaint_of(file(-1, 5)), Contains("not a count"));
}

TEST_CASE("coordinates of a packed PLY are brought into range", "[quick][io]") {
  const TempDir dir;
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
      "property double z\nelement face 3\nproperty list uchar uint vertex_indices\nend_header\n";
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : {Vec3d{1, 1e-95, 1}, Vec3d{2, 1, 1}, Vec3d{2, 2, 1}, Vec3d{1e95, 1, 1}, Vec3d{inf, 1, 1}})
    for (const double c : p) bytes += raw(c);
  for (const std::uint32_t last : {2u, 3u, 4u}) {
    bytes += raw(std::uint8_t(3));
    for (const std::uint32_t i : {0u, 1u, last}) bytes += raw(i);
  }
  const auto source = open_scene(dir.file("a.ply", bytes));
  const TriangleD expected{{{1, 0, 1}, {2, 1, 1}, {2, 2, 1}}};
  const TriangleD far{{{1, 0, 1}, {2, 1, 1}, {1e95, 1, 1}}};  // what is finite is not left out
  CHECK((read_all(*source) == std::vector<TriangleD>{expected, far}));
  CHECK(source->counts().non_finite == 1);
}
