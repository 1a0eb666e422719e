#include <random>

#include "io/mesh/detail/mesh_writers.h"
#include "io/mesh/mesh_writer.h"
#include "tests/catch.h"
#include "tests/unit/io/mesh/soup.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

LatticeMesh random_mesh(const GridFrame& frame, std::int64_t reach, unsigned seed) {
  LatticeMesh mesh;
  mesh.frame = frame;
  mesh.provenance = {{"bpvox", "0.1.0", "--voxel 1 --fill flood", "00ff"}, {"bpmesh", "0.1.0", "two\nlines", ""}};
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::int64_t> pick(-reach, reach);
  for (int i = 0; i < 200; ++i) mesh.vertices.push_back({pick(random), pick(random), pick(random)});
  for (std::uint32_t i = 0; i + 2 < 200; ++i) mesh.triangles.push_back({i, (7 * i + 1) % 200, i + 2});
  return mesh;
}

GridFrame frame_at(const Vec3d& place, double size, double voxel, UpAxis up) {
  Bounds3d bounds;
  bounds.add(place);
  bounds.add({place[0] + size, place[1] + size, place[2] + size});
  return make_frame(bounds, voxel, up);
}

std::string write(const TempDir& dir, const LatticeMesh& mesh, const std::string& name,
                  const MeshWriteOptions& options = {}) {
  OutputFile out(dir.path(name), true);
  write_mesh(mesh, out, mesh_format_of(name), options);
  out.commit();
  return dir.path(name);
}

std::string refusal(const LatticeMesh& mesh, const std::string& name, const MeshWriteOptions& options = {}) {
  const TempDir dir;
  try {
    write(dir, mesh, name, options);
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::bad_argument);
    CHECK(!std::filesystem::exists(dir.path(name)));
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a written mesh reads back to exactly the same coordinates", "[quick][io]") {
  const std::string name = GENERATE(as<std::string>(), "m.ply", "m.obj", "m.glb", "m.gltf");
  const UpAxis up = UpAxis(GENERATE(range(0, 6)));
  const GridFrame frame =
      GENERATE_COPY(frame_at({0, 0, 0}, 300, 0.1, up), frame_at({6801760.25, -455564.7, 31.3}, 8000, 0.37, up),
                    frame_at({-1e-3, 1e-3, 0}, 0.25, 0.001, up), frame_at({1e7, 1e7, -1e7}, 50, 0.01, up));
  const LatticeMesh mesh = random_mesh(frame, 64 * 3000, 5);
  const TempDir dir;
  CHECK(canonical(soup(read_mesh(write(dir, mesh, name)))) == canonical(soup(mesh)));
}

TEST_CASE("STL is written when each coordinate is a float, and refused otherwise", "[quick][io]") {
  const LatticeMesh near = random_mesh(frame_at({0, 0, 0}, 300, 0.125, UpAxis::y), 64 * 2000, 5);
  const TempDir dir;
  CHECK(soup(read_mesh(write(dir, near, "m.stl"))) == soup(near));
  CHECK(bytes_of_file(dir.path("m.stl")).compare(0, 6, "bpmesh") == 0);

  const LatticeMesh far = random_mesh(frame_at({6801760.25, -455564.7, 31.3}, 100, 0.125, UpAxis::y), 64 * 100, 5);
  CHECK_THAT(refusal(far, "m.stl"), Contains("to an origin of"));
  MeshWriteOptions moved;
  moved.origin = far.frame.world_origin();
  const auto back = soup(read_mesh(write(dir, far, "far.stl", moved)));
  const auto expected = soup(far);
  REQUIRE(back.size() == expected.size());
  for (std::size_t i = 0; i < back.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) REQUIRE(back[i][k][c] + moved.origin[c] == expected[i][k][c]);
}

TEST_CASE("an origin that would round is refused, with one that fits", "[quick][io]") {
  const LatticeMesh mesh = random_mesh(frame_at({6801760.25, -455564.7, 31.3}, 8000, 0.37, UpAxis::y), 6400, 5);
  MeshWriteOptions odd;
  odd.origin = {6801760.1, -455564.7, 1e-9};
  const std::string name = GENERATE(as<std::string>(), "m.ply", "m.obj", "m.stl", "m.glb", "m.gltf");
  CHECK_THAT(refusal(mesh, name, odd), Contains("without rounding"));
}

TEST_CASE("meshes that cannot be written are refused and leave no file", "[quick][io]") {
  const std::string name = GENERATE(as<std::string>(), "m.ply", "m.obj", "m.stl", "m.glb", "m.gltf");
  LatticeMesh mesh = random_mesh(frame_at({0, 0, 0}, 300, 0.125, UpAxis::y), 640, 5);
  LatticeMesh wild = mesh;
  wild.triangles.push_back({0, 1, 200});
  CHECK_THAT(refusal(wild, name), Contains("vertex 200 of 200"));
  mesh.triangles.clear();
  CHECK_THAT(refusal(mesh, name), Contains("no triangle"));
}

TEST_CASE("a mesh too wide for exact floats is refused as glTF", "[quick][io]") {
  LatticeMesh mesh = random_mesh(frame_at({0, 0, 0}, 1e6, 1, UpAxis::y), std::int64_t(1) << 24, 5);
  mesh.vertices[0].x = -(std::int64_t(1) << 24) - 1;
  mesh.vertices[1].x = (std::int64_t(1) << 24) - 1;
  const TempDir dir;
  CHECK(canonical(soup(read_mesh(write(dir, mesh, "m.glb")))) == canonical(soup(mesh)));
  mesh.vertices[1].x += 2;
  CHECK_THAT(refusal(mesh, "m.glb"), Contains("2^19"));
}

TEST_CASE("a mesh stands upright in glTF, and comes back in its own axes", "[quick][io]") {
  const UpAxis up = UpAxis(GENERATE(range(0, 6)));
  CAPTURE(name_of(up));
  LatticeMesh mesh = random_mesh(frame_at({10, 20, 30}, 300, 0.5, up), 640, 5);
  const TempDir dir;
  const std::string path = write(dir, mesh, "m.gltf");
  CHECK(canonical(soup(read_mesh(path))) == canonical(soup(mesh)));
  CHECK(canonical(read_all(path)) == canonical(soup(mesh)));
  // A reader that knows nothing of extras sees y up.
  std::string text = bytes_of_file(path);
  const std::string told = fmt::format("\"up\": \"{}\"", name_of(up));
  text.replace(text.find(told), told.size(), "\"up\": \"?\"");
  std::vector<TriangleD> expected = soup(mesh);
  for (TriangleD& t : expected) {
    for (Vec3d& p : t) {
      const Vec3d turned[] = {
          p, {p[0], p[2], -p[1]}, {-p[1], p[0], p[2]}, {p[1], -p[0], p[2]}, {p[0], -p[1], -p[2]}, {p[0], -p[2], p[1]}};
      p = Vec3d(turned[std::size_t(up)]);
    }
  }
  CHECK(canonical(soup(read_mesh(dir.file("other.gltf", text)))) == canonical(expected));
}

TEST_CASE("mesh formats are known by extension", "[quick][io]") {
  CHECK(mesh_format_of("a/b.GLB") == MeshFormat::glb);
  CHECK(mesh_format_of("x.gltf") == MeshFormat::gltf);
  CHECK(mesh_format_of("x.stl") == MeshFormat::stl);
  CHECK_THROWS_AS(mesh_format_of("x.fbx"), Error);
  CHECK_THROWS_AS(mesh_format_of("dir.glb/file"), Error);
}

TEST_CASE("the chain of tools is written into each mesh", "[quick][io]") {
  const LatticeMesh mesh = random_mesh(frame_at({0, 0, 0}, 300, 0.125, UpAxis::y), 640, 5);
  const TempDir dir;
  for (const char* name : {"m.ply", "m.obj"}) {
    const std::string bytes = bytes_of_file(write(dir, mesh, name));
    CHECK_THAT(bytes, Contains("provenance: bpvox 0.1.0 --voxel 1 --fill flood input 00ff\n"));
    CHECK_THAT(bytes, Contains("two lines\n"));
    CHECK(bytes_of_file(write(dir, mesh, name)) == bytes);
  }
  const std::string gltf = bytes_of_file(write(dir, mesh, "m.gltf"));
  CHECK_THAT(gltf, Contains("\"generator\": \"bpmesh " BP_VERSION "\""));
  CHECK_THAT(gltf, Contains("\"options\": \"two\\nlines\""));
  CHECK_THAT(gltf, Contains("\"input\": \"00ff\""));
}

TEST_CASE("a mesh with normals reads back to the same coordinates, and its normals point outwards", "[quick][io]") {
  const std::string name = GENERATE(as<std::string>(), "m.ply", "m.obj", "m.glb", "m.gltf");
  LatticeMesh mesh;
  mesh.frame = frame_at({0, 0, 0}, 300, 0.1, UpAxis::y);
  mesh.vertices = {{600, 0, 0}, {-600, 0, 0}, {0, 600, 0}, {0, -600, 0}, {0, 0, 600}, {0, 0, -600}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const std::vector<std::array<float, 3>> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < 6; ++i) {  // an octahedron: the normal is the direction of the vertex
    const LatticeCoord& p = mesh.vertices[i];
    for (int k = 0; k < 3; ++k) CHECK(std::abs(normals[i][std::size_t(k)] - float(p[k]) / 600) < 1e-6f);
  }
  const TempDir dir;
  MeshWriteOptions options;
  options.normals = true;
  CHECK(soup(read_mesh(write(dir, mesh, name, options))) == soup(mesh));
  const auto size = std::filesystem::file_size(dir.path(name));
  const auto plain = std::filesystem::file_size(write(dir, mesh, "plain-" + name));
  const bool gltf = name.find(".gl") != std::string::npos;  // has normals without being asked
  CHECK((gltf ? size == plain : size > plain));
}
