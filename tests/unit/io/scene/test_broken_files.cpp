#include <random>

#include "io/mesh/mesh_writer.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

// Small files of each format, damaged at random: the answer is triangles or an Error, never a crash, and never more
// triangles than the bytes can name.

using namespace bp;
using namespace bp::test;

namespace {

LatticeMesh small_mesh() {
  LatticeMesh mesh;
  for (std::int64_t i = 0; i < 12; ++i) mesh.vertices.push_back({64 * i, i * i * 64, 64 * (i % 3)});
  for (std::uint32_t i = 0; i < 10; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  mesh.frame.up = UpAxis::z;
  return mesh;
}

std::string written(const TempDir& dir, const std::string& name) {
  OutputFile out(dir.path(name), true);
  write_mesh(small_mesh(), out, mesh_format_of(name));
  out.commit();
  return bytes_of_file(dir.path(name));
}

std::string ascii_ply() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty int z\nproperty list "
         "uchar int l\n"
         "element face 2\nproperty uchar id\nproperty list uchar int vertex_indices\nelement tristrips 1\nproperty "
         "list int int vertex_indices\n"
         "end_header\n0 0 0 0\n1 0 0 1 5\n1 1 0 2 7 8\n0 1 0 0\n1 4 0 1 2 3\n2 3 0 1 2\n6 0 1 2 -1 1 2\n";
}

std::string ascii_stl() {
  std::string text = "solid x\n";
  for (int i = 0; i < 4; ++i)
    text += fmt::format(
        "facet normal 0 0 1\nouter loop\nvertex 0 0 {}\nvertex 1 0 0\nvertex 1.5e0 1 0\nendloop\nendfacet\n", i);
  return text + "endsolid x\n";
}

/// One to four small damages: a byte changed, a piece cut out, doubled or moved, the end lost.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto pick = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
  for (std::size_t times = 1 + pick(4); times > 0 && !bytes.empty(); --times) {
    const std::size_t at = pick(bytes.size()), length = 1 + pick(16);
    switch (random() % 6) {
      case 0:
        bytes[at] = char(random());
        break;
      case 1:
        bytes[at] = "0123456789-+.eE/ \n\"{}[]\\"[pick(24)];
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(pick(bytes.size()), length));
        break;
      case 4:
        bytes[at] = char(bytes[at] ^ (1 << pick(8)));
        break;
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("damaged files are read or refused, and nothing else", "[quick][io]") {
  const TempDir dir;
  const std::pair<std::string, std::string> samples[] = {
      {"a.obj", "o x\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1/1 2/2/2 3//3 \\\n4\nf -1 -2 -3\nf 5 1 2\nv 3 3 3\n"},
      {"a.off", "COFF\n# c\n4 2 0\n0 0 0 1 1 1\n1 0 0 1 1 1\n1 1 0 0 0 0\n0 1 0 1 1 1\n4 0 1 2 3 0.5\n3 0 1 2\n"},
      {"a.stl", ascii_stl()},
      {"a.ply", ascii_ply()},
      {"b.ply", written(dir, "b.ply")},
      {"b.stl", written(dir, "b.stl")},
      {"b.glb", written(dir, "b.glb")},
      {"b.gltf", written(dir, "b.gltf")},
  };
  const int sample = GENERATE(range(0, 8));
  const auto& [name, bytes] = samples[sample];
  REQUIRE(read_all(dir.file(name, bytes)).size() > 2);
  SceneOptions options;
  options.memory_bytes = 1 << 16;
  std::mt19937 random(unsigned(sample) + 1);
  int refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::string path = dir.file(name, damaged(bytes, random));
    CAPTURE(name, trial);
    try {
      const std::size_t triangles = read_all(path, options).size();  // REQUIRE would catch the Error
      REQUIRE(triangles <= bytes.size());
    } catch (const Error& e) {
      ++refused;
      REQUIRE(e.code() == ErrorCode::bad_input);
      REQUIRE(std::string(e.what()).find(name) != std::string::npos);
      REQUIRE(std::string(e.what()).find('\n') == std::string::npos);
    }
  }
  CHECK(refused > 20);
}
