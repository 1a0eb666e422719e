#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "io/mesh/lod_writer.h"
#include "io/mesh/mesh_writer.h"
#include "tests/catch.h"
#include "tests/unit/io/mesh/soup.h"
#include "tests/unit/io/scene/scene_files.h"

// Tests the floats in a GLB by its bytes, without the suite's readers.

using namespace bp;
using namespace bp::test;

namespace {

using Json = nlohmann::json;

/// A scene of `size` voxels a side, and a mesh that reaches as far as a proxy of it.
LatticeMesh random_mesh(const Vec3d& place, double voxel, int size, UpAxis up, unsigned seed) {
  Bounds3d bounds;
  bounds.add(place);
  bounds.add({place[0] + size * voxel, place[1] + size * voxel, place[2] + size * voxel});
  LatticeMesh mesh;
  mesh.frame = make_frame(bounds, voxel, up);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::int64_t> pick(-128, 64 * size);
  for (int i = 0; i < 60; ++i) mesh.vertices.push_back({pick(random), pick(random), pick(random)});
  for (std::uint32_t i = 0; i + 2 < 60; ++i) mesh.triangles.push_back({i, (7 * i + 1) % 60, i + 2});
  return mesh;
}

struct Glb {
  Json json;
  std::string data;
};

Glb glb(const std::string& path) {
  const std::string bytes = bytes_of_file(path);
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  return {Json::parse(bytes.substr(20, size)), bytes.substr(28 + size)};
}

/// The corners of all triangles of mesh `i`, as the file holds them.
std::vector<std::array<float, 3>> corners(const Glb& file, std::size_t i = 0) {
  const Json& primitive = file.json["meshes"][i]["primitives"][0];
  const auto numbers = [&](const Json& accessor, auto* out, std::size_t bytes) {
    const Json& view = file.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::memcpy(out, file.data.data() + view.value("byteOffset", 0), bytes);
  };
  const Json& accessors = file.json["accessors"];
  const Json &p = accessors[primitive["attributes"]["POSITION"].get<std::size_t>()],
             &t = accessors[primitive["indices"].get<std::size_t>()];
  std::vector<std::array<float, 3>> positions(p["count"].get<std::size_t>()), all;
  numbers(p, positions.data(), 12 * positions.size());
  const auto n = t["count"].get<std::size_t>();
  std::vector<std::uint16_t> narrow(n);
  std::vector<std::uint32_t> wide(n);
  const bool is_narrow = t["componentType"] == 5123;
  is_narrow ? numbers(t, narrow.data(), 2 * n) : numbers(t, wide.data(), 4 * n);
  for (std::size_t k = 0; k < n; ++k) all.push_back(positions[is_narrow ? narrow[k] : wide[k]]);
  std::sort(all.begin(), all.end());
  return all;
}

/// The corners of a mesh, less `offset`, in the axes of glTF; all are floats.
std::vector<std::array<float, 3>> expected(const LatticeMesh& mesh, const Vec3d& offset = {}) {
  std::vector<std::array<float, 3>> all;
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      Vec3d p = mesh.frame.world(mesh.vertices[v]);
      for (std::size_t i = 0; i < 3; ++i) p[i] -= offset[i];
      const Vec3d q = to_y_up(mesh.frame.up)(p);
      all.push_back({float(q[0]), float(q[1]), float(q[2])});
      for (std::size_t i = 0; i < 3; ++i) REQUIRE(double(all.back()[i]) == q[i]);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

enum class Writer { mesh, levels, parts };

Glb written(const LatticeMesh& mesh, Writer writer, const Vec3d& origin = {}) {
  const TempDir dir;
  OutputFile out(dir.path("m.glb"), true);
  const NamedMesh named{"m", &mesh};
  if (writer == Writer::mesh) write_mesh(mesh, out, MeshFormat::glb, {origin});
  if (writer == Writer::levels) write_lod_glb({&named, 1}, {}, out, {origin});
  if (writer == Writer::parts) write_parts_glb({&named, 1}, out, {origin});
  out.commit();
  CHECK(soup(read_mesh(dir.path("m.glb"))).size() == mesh.triangles.size());
  return glb(dir.path("m.glb"));
}

bool has_transform(const Json& node) {
  return node.contains("translation") || node.contains("scale") || node.contains("rotation") || node.contains("matrix");
}

Vec3d translation(const Json& node) {
  return node.contains("translation") ? node["translation"].get<Vec3d>() : Vec3d{};
}

}  // namespace

TEST_CASE("near its origin a scene's proxy has scene units in the file, and nodes without a transform", "[quick][io]") {
  const Writer writer = GENERATE(Writer::mesh, Writer::levels, Writer::parts);
  const UpAxis up = UpAxis(GENERATE(range(0, 6)));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (unsigned seed = 0; seed < 40; ++seed) {
    const double voxel = std::exp(20 * unit(random) - 10);
    const int size = 8 + int(600 * unit(random));
    const auto place = [&] { return -voxel * size * unit(random); };
    const LatticeMesh mesh = random_mesh({place(), place(), place()}, voxel, size, up, seed);
    const Glb file = written(mesh, writer);
    REQUIRE(corners(file) == expected(mesh));
    for (const Json& node : file.json["nodes"]) REQUIRE(!has_transform(node));
    REQUIRE(file.json["nodes"].size() == 1);
    REQUIRE(file.json["asset"]["extras"]["up"] == name_of(up));
  }
}

TEST_CASE("far from its origin a scene's proxy has scene units, and nodes with a translation of few bits",
          "[quick][io]") {
  const Writer writer = GENERATE(Writer::mesh, Writer::levels, Writer::parts);
  const UpAxis up = GENERATE(UpAxis::y, UpAxis::z, UpAxis::minus_x);
  const Vec3d place = GENERATE(Vec3d{6801760.25, -455564.7, 31.3}, Vec3d{-3e4, 2e5, 4.4e6}, Vec3d{1e6, 0, 0});
  const LatticeMesh mesh = random_mesh(place, GENERATE(0.01, 0.37, 1.7), 500, up, 5);
  const Glb file = written(mesh, writer);
  REQUIRE(file.json["nodes"].size() == 1);
  const Json& node = file.json["nodes"][0];
  CHECK(!node.contains("scale"));
  CHECK(!node.contains("matrix"));
  const Vec3d at = translation(node);
  CHECK(at != Vec3d{});
  for (const double x : at) CHECK(double(float(x)) == x);  // a program that rounds it changes nothing
  CHECK(corners(file) == expected(mesh, to_y_up(up).inverse()(at)));
  // With an origin that is subtracted nothing is left for the node.
  const Vec3d origin = mesh.frame.world({64 * 250, 64 * 250, 64 * 250});
  const Glb moved = written(mesh, writer, origin);
  CHECK(corners(moved) == expected(mesh, origin));
  CHECK(!has_transform(moved.json["nodes"][0]));
}

TEST_CASE("all meshes of a file stand together: one translation", "[quick][io]") {
  const Vec3d place{5e5, 5.4e6, 100};
  LatticeMesh first = random_mesh(place, 0.1, 300, UpAxis::z, 1), second = first;
  second.vertices.resize(30);
  second.triangles.assign({{0, 1, 2}, {3, 4, 5}});
  const NamedMesh both[] = {{"a", &first}, {"b", &second}};
  const TempDir dir;
  OutputFile out(dir.path("m.glb"), true);
  GENERATE(false, true) ? write_parts_glb(both, out) : write_lod_glb(both, std::vector<double>{0.5, 0}, out);
  out.commit();
  const Glb file = glb(dir.path("m.glb"));
  const Vec3d at = translation(file.json["nodes"][0]), offset = to_y_up(UpAxis::z).inverse()(at);
  CHECK(translation(file.json["nodes"][1]) == at);
  CHECK(corners(file) == expected(first, offset));
  CHECK(corners(file, 1) == expected(second, offset));
}

TEST_CASE("a mesh of very many voxels has whole numbers in the file, and a node with a scale", "[quick][io]") {
  const LatticeMesh mesh = random_mesh({0, 0, 0}, 0.1, 200000, UpAxis::y, 1);
  const Glb file = written(mesh, GENERATE(Writer::mesh, Writer::levels, Writer::parts));
  const Json& node = file.json["nodes"][0];
  CHECK(node["scale"][0] == mesh.frame.voxel / 64);
  for (const auto& p : corners(file))
    for (const float c : p) REQUIRE(c == std::nearbyint(c));
}
