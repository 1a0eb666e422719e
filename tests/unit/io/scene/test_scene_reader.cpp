#include <fcntl.h>

#include <cmath>
#include <random>

#include "io/scene/detail/degenerate.h"
#include "io/scene/detail/vertex_pool.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

/// The definition: products of 128-bit integers.
bool collinear(const std::array<std::array<std::int64_t, 3>, 3>& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    __extension__ using Wide = __int128;
    const Wide n = Wide(t[1][j] - t[0][j]) * (t[2][k] - t[0][k]) - Wide(t[1][k] - t[0][k]) * (t[2][j] - t[0][j]);
    if (n != 0) return false;
  }
  return true;
}

class StdinFrom {
 public:
  explicit StdinFrom(const std::string& path) : saved_(::dup(0)) {
    const int fd = ::open(path.c_str(), O_RDONLY);
    ::dup2(fd, 0);
    ::close(fd);
  }
  ~StdinFrom() {
    ::dup2(saved_, 0);
    ::close(saved_);
  }

 private:
  int saved_;
};

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

}  // namespace

TEST_CASE("area is decided exactly, however near to zero", "[quick][io]") {
  std::mt19937_64 random(7);
  int lines = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    // Points on a long line through a far place, pushed off it by a unit or not at all: doubles alone cannot tell.
    const int bits = 10 + trial % 40;
    std::uniform_int_distribution<std::int64_t> pick(-(std::int64_t(1) << bits), std::int64_t(1) << bits);
    std::array<std::array<std::int64_t, 3>, 3> t{};
    const std::int64_t steps = trial % 5 + 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t at = pick(random), by = pick(random) / 8;
      t[0][i] = at;
      t[1][i] = at + by;
      t[2][i] = at + steps * by;
    }
    if (trial % 2 != 0) t[2][std::size_t(trial / 2 % 3)] += trial % 7 - 3;
    const double unit = std::ldexp(1.0, trial % 500 - 250);
    TriangleD d;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) d[i][k] = double(t[i][k]) * unit;
    lines += collinear(t) ? 1 : 0;
    REQUIRE(is_degenerate(d) == collinear(t));
  }
  CHECK(lines > 5000);
  CHECK(lines < 15000);
}

TEST_CASE("area is decided exactly where an edge itself rounds", "[quick][io]") {
  // b - a = 2^60 - 2^-60 is no double; taken as 2^60 the corners would be collinear.
  const double big = 0x1p60, small = 0x1p-60;
  CHECK_FALSE(is_degenerate({{{small, small, 0}, {big, big, 0}, {2 * big, 2 * big + 0x1p20, 0}}}));
  CHECK_FALSE(is_degenerate({{{small, 0, 0}, {big, big, 0}, {2 * big, 2 * big, 0}}}));
  CHECK(is_degenerate({{{small, small, 0}, {big, big, 0}, {2 * big, 2 * big, 0}}}));
  CHECK_FALSE(is_degenerate({{{0, 0, 0}, {1e-90, 0, 0}, {0, 1e-90, 0}}}));
  CHECK_FALSE(is_degenerate({{{-1e90, -1e90, 1e90}, {1e90, 1e90, 1e90}, {1e90, std::nextafter(1e90, 0), 1e90}}}));
  CHECK(is_degenerate({{{-1e90, -1e90, 1e90}, {1e90, 1e90, 1e90}, {1e-90, 1e-90, 1e90}}}));
}

TEST_CASE("a vertex pool gives back what it took, however small its memory", "[quick][io]") {
  const std::uint64_t budget = GENERATE(as<std::uint64_t>(), 0, 200000, 1 << 24);
  VertexPool pool(budget, "/tmp");
  const auto value = [](std::uint64_t i) { return Vec3d{double(i), 1.0 / double(i + 1), -double(i * i)}; };
  for (std::uint64_t i = 0; i < 50000; ++i) {
    pool.push(value(i));
    if (i % 97 == 0) REQUIRE(pool[i * 31 % (i + 1)] == value(i * 31 % (i + 1)));
  }
  CHECK(pool.spilled() == (budget < 50000 * 24));
  for (std::uint64_t i = 0; i < 50000; ++i) REQUIRE(pool[i * 7919 % 50000] == value(i * 7919 % 50000));
}

TEST_CASE("a block cache reads each block once while it fits", "[quick][io]") {
  const TempDir dir;
  std::string bytes;
  for (std::uint32_t i = 0; i < 300000; ++i) bytes += raw(i);
  BlockCache cache(open_scene_file(dir.file("a", bytes), "/tmp"), 8 << 20);
  const auto word = [&](std::uint64_t i) {
    std::uint32_t w = 0;
    cache.read(4 * i + 2, &w, 4);  // across words, and so across blocks
    return w;
  };
  for (std::uint32_t i = 0; i + 1 < 300000; ++i) REQUIRE(word(i) == (i >> 16 | (i + 1) << 16));
  CHECK(cache.misses() == (bytes.size() + BlockCache::kBlockBytes - 1) / BlockCache::kBlockBytes);
  CHECK_THROWS_AS(word(300000 - 1), Error);
  CHECK_THROWS_AS(word(std::uint64_t(1) << 40), Error);
}

TEST_CASE("memory for vertices changes no triangle", "[quick][io]") {
  const TempDir dir;
  std::string text, faces;
  std::mt19937 random(3);
  for (int i = 0; i < 30000; ++i) text += fmt::format("v {} {} {}\n", i % 173, i % 71, i / 7);
  for (int i = 0; i < 20000; ++i)
    faces += fmt::format("f {} {} {}\n", random() % 30000 + 1, random() % 30000 + 1, random() % 30000 + 1);
  const std::string path = dir.file("a.obj", text + faces);
  SceneOptions tiny;
  tiny.memory_bytes = 1;
  const auto expected = read_all(path);
  CHECK(expected.size() > 19000);
  CHECK(read_all(path, tiny) == expected);
}

TEST_CASE("the first bytes of a file tell its format, and its name where they do not", "[quick][io]") {
  const TempDir dir;
  CHECK(read_all(dir.file("A.OBJ", kTetrahedron)).size() == 4);
  CHECK(read_all(dir.file("noname", "# something\n" + kTetrahedron)).size() == 4);
  CHECK(read_all(dir.file("off.txt", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).size() == 1);
  CHECK(read_all(dir.file("stl.dat",
                          "solid x\nfacet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
                          "endfacet endsolid x\n"))
            .size() == 1);
  CHECK(read_all(dir.file("off.ply", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).size() == 1);
  CHECK(read_all(dir.file("obj.stl", kTetrahedron)).size() == 4);
  CHECK_THAT(complaint_of(dir.file("las.ply", "LASF")), Contains("point cloud"));
  CHECK_THAT(complaint_of(dir.file("zip.obj", "PK\x03\x04")), Contains("unpack"));
  CHECK_THAT(complaint_of(dir.file("what", "hello")), Contains("tell its format"));
  SceneOptions options;
  options.format = "OBJ";
  CHECK(read_all(dir.file("bare", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"), options).size() == 1);
  CHECK_THAT(complaint_of(dir.path("missing.ply")), Contains("missing.ply"));
  CHECK_THAT(complaint_of(dir.path(".")), Contains("directory"));
}

TEST_CASE("stdin is spooled and read again after rewind", "[quick][io]") {
  const TempDir dir;
  const StdinFrom redirected(dir.file("a.obj", kTetrahedron));
  SceneOptions options;
  options.format = "obj";
  const auto source = open_scene("-", options);
  CHECK(source->name() == "stdin");
  const auto first = read_all(*source);
  CHECK(first.size() == 4);
  source->rewind();
  CHECK(read_all(*source) == first);
}

TEST_CASE("several scenes come one after the other", "[quick][io]") {
  const TempDir dir;
  const std::string a = dir.file("a.obj", kTetrahedron),
                    b = dir.file("b.obj", "v 0 0 9\nv 1 0 9\nv 0 1 9\nf 1 2 3\nf 1 2 2\nf 1 2 7\n");
  const StdinFrom redirected(a);
  const auto source = open_scenes({a, "-", b});
  for (int pass = 0; pass < 2; ++pass) {
    const auto all = read_all(*source);
    REQUIRE(all.size() == 9);
    CHECK(all[8][0] == Vec3d{0, 0, 9});
    CHECK(source->counts().triangles == 9);
    CHECK(source->counts().degenerate == 1);
    CHECK(source->counts().bad_faces == 1);
    CHECK(source->counts().instances == 3);
    source->rewind();
    CHECK(source->counts().triangles == 0);
  }
  CHECK_THROWS_AS(open_scenes({a, dir.path("missing.obj")}), Error);
  CHECK_THROWS_AS(open_scenes({}), Error);
}

TEST_CASE("a file of several without a triangle is refused by its name", "[quick][io]") {
  const TempDir dir;
  const std::string a = dir.file("a.obj", std::string("o a\n") + kTetrahedron);
  CHECK_THROWS_WITH(read_all(*open_scenes({a, dir.file("none.obj", "")}, SceneOptions())),
                    ContainsSubstring("none.obj: is empty"));
  for (const char* text : {"# no faces\n", "v 0 0 0\nv 1 0 0\nf 1 2 2\n", "v 0 0 0\nf 1 2 3\n"}) {
    const std::string empty = dir.file("empty.obj", text);
    SceneOptions options;
    for (const bool keep : {false, true}) {
      options.keep_degenerate = keep;
      for (const auto& paths : {std::vector{empty, a}, {a, empty}}) {
        const auto source = open_scenes(paths, options);
        CHECK_THROWS_WITH(read_all(*source), ContainsSubstring("empty.obj: no triangles"));
      }
    }
    options.parts = "*";  // a filter may leave nothing of a file
    CHECK(read_all(*open_scenes({a, empty}, options)).size() == 4);
  }
}

TEST_CASE("edges within a polygon are told from its own, whatever is skipped", "[quick][io]") {
  const TempDir dir;  // a triangle, a quad, a pentagon whose second triangle has no area, a triangle
  const std::string obj = dir.file("a.obj",
                                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 0\nf 1 2 3\nf 1 2 3 4\nf 1 2 3 5 4\n"
                                   "f 2 3 4\n");
  const std::vector<std::uint8_t> kept{0, 4 + 16, 1 + 8, 4 + 16, 1 + 8, 0};
  CHECK(read_inner_edges(*open_scene(obj)) == kept);
  std::vector<std::uint8_t> both = kept;
  both.insert(both.end(), kept.begin(), kept.end());
  CHECK(read_inner_edges(*open_scenes({obj, obj})) == both);
  CHECK(read_mesh(obj).inner_edges ==
        std::vector<std::uint8_t>{0, 20, 9, 20, 29, 9});  // all triangles; the last has none
  CHECK(read_mesh(dir.file("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")).inner_edges.empty());
}

TEST_CASE("read_mesh welds equal positions only", "[quick][io]") {
  const TempDir dir;
  const double next = std::nextafter(1.0, 2.0);
  const std::string text = fmt::format("v 0 0 0\nv -0 0 0\nv 1 0 0\nv {} 0 0\nv 0 1 0\nf 1 3 5\nf 2 4 5\n", next);
  const IndexedMesh mesh = read_mesh(dir.file("a.obj", text));
  CHECK(mesh.vertices == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {next, 0, 0}});
  REQUIRE(mesh.triangles.size() == 2);
  CHECK(mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 3, 2});
}
