#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <random>

#include "io/gltf/draco_codec.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/gltf_document.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr int kSide = 8;  // quads along a side of the sheet

/// A bent sheet. Corners lie at quarters: exact in floats, and in Draco without quantization.
std::vector<TriangleD> sheet() {
  std::vector<TriangleD> triangles;
  const auto at = [](int x, int y) { return Vec3d{x / 4.0, y / 4.0, x * y / 4.0}; };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return triangles;
}

/// An attribute that is the same at all vertices. T has the type of `type`.
template <class T>
struct Same {
  std::vector<T> value;
  draco::DataType type;

  void add_to(draco::TriangleSoupMeshBuilder& builder, std::size_t triangles) const {
    const int id = builder.AddAttribute(draco::GeometryAttribute::GENERIC, std::int8_t(value.size()), type);
    for (std::size_t i = 0; i < triangles; ++i)
      builder.SetAttributeValuesForFace(id, draco::FaceIndex(std::uint32_t(i)), value.data(), value.data(),
                                        value.data());
  }
};

/// `more`: attributes of the exporter's own.
template <class... T>
std::string packed(const std::vector<TriangleD>& triangles, int method, const Same<T>&... more) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(int(triangles.size()));
  const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<std::array<float, 3>, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) corners[k][axis] = float(triangles[i][k][axis]);
    builder.SetAttributeValuesForFace(id, draco::FaceIndex(std::uint32_t(i)), corners[0].data(), corners[1].data(),
                                      corners[2].data());
  }
  (more.add_to(builder, triangles.size()), ...);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer buffer;
  REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

Document document_of(const std::string& bytes, std::size_t triangles, int index_type = kU16) {
  Document d;
  const int view = d.view(bytes);
  const int positions = d.accessor({{"componentType", kF32}, {"count", 3 * triangles}, {"type", "VEC3"}});
  const int indices = d.accessor({{"componentType", index_type}, {"count", 3 * triangles}, {"type", "SCALAR"}});
  const int mesh = d.mesh(positions, indices);
  d.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  d.node({{"mesh", mesh}});
  return d;
}

std::vector<TriangleD> sorted(std::vector<TriangleD> triangles) {
  for (TriangleD& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace

TEST_CASE("glTF that Draco packed has the triangles that were packed", "[quick][io]") {
  const int method = GENERATE(draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING);
  const std::vector<TriangleD> triangles = sheet();
  const TempDir dir;
  const Document d = document_of(packed(triangles, method), triangles.size());
  CHECK(sorted(read_all(dir.file("a.glb", d.glb()))) == sorted(triangles));
}

TEST_CASE("Draco's bytes are held against what the file says of them", "[quick][io]") {
  const std::vector<TriangleD> triangles = sheet();
  const std::string bytes = packed(triangles, draco::MESH_EDGEBREAKER_ENCODING);
  const TempDir dir;
  const auto complaint = [&](const Document& d) { return complaint_of(dir.file("a.glb", d.glb())); };
  CHECK_THAT(complaint(document_of(bytes, triangles.size() - 1)), Contains("128 triangles, and 381 indices"));
  CHECK_THAT(complaint(document_of(bytes.substr(0, bytes.size() / 2), triangles.size())), Contains("damaged"));
  CHECK_THAT(complaint(document_of("DRACO", triangles.size())), Contains("damaged"));
  Document d = document_of(bytes, triangles.size());
  d.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 7;
  CHECK_THAT(complaint(d), Contains("no attribute 7"));
  d = document_of(bytes, triangles.size());
  Json other = d.json["meshes"][0]["primitives"][0];
  other["attributes"]["POSITION"] = d.accessor({{"componentType", kF32}, {"count", 384}, {"type", "VEC3"}});
  d.json["meshes"][0]["primitives"].push_back(other);
  CHECK_THAT(complaint(d), Contains("shares some of its accessors"));
}

TEST_CASE("joints and weights that Draco packed move the vertices of their skin", "[quick][io]") {
  std::vector<TriangleD> triangles = sheet();
  Document d =
      document_of(packed(triangles, draco::MESH_EDGEBREAKER_ENCODING, Same<std::uint8_t>{{1, 0, 0, 0}, draco::DT_UINT8},
                         Same<float>{{0.75, 0.25, 0, 0}, draco::DT_FLOAT32}),
                  triangles.size());
  Json& primitive = d.json["meshes"][0]["primitives"][0];
  const auto unpacked = [&](int type) {
    return d.accessor({{"componentType", type}, {"count", 3 * triangles.size()}, {"type", "VEC4"}});
  };
  primitive["attributes"]["JOINTS_0"] = unpacked(kU8);
  primitive["attributes"]["WEIGHTS_0"] = unpacked(kF32);
  Json& ids = primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"];
  ids["JOINTS_0"] = 1;
  ids["WEIGHTS_0"] = 2;
  d.json["nodes"][0]["skin"] = 0;
  d.json["skins"] = Json::array({{{"joints", {1, 2}}}});
  d.node({{"translation", {4, 0, 0}}});
  d.node({{"translation", {0, 8, 0}}});
  d.json["scenes"][0]["nodes"] = {0, 1, 2};
  const TempDir dir;
  for (TriangleD& t : triangles)
    for (Vec3d& p : t) p = {p[0] + 1, p[1] + 6, p[2]};
  CHECK(sorted(read_all(dir.file("a.glb", d.glb()))) == sorted(triangles));
}

TEST_CASE("attributes of Draco that take memory without end are refused before there is room", "[quick][io]") {
  const std::size_t components = GENERATE(4, 127);
  const std::vector<TriangleD> triangles = sheet();
  const Same<double> more{std::vector<double>(components), draco::DT_FLOAT64};
  const std::string bytes = packed(triangles, draco::MESH_EDGEBREAKER_ENCODING, more);
  const TempDir dir;
  const std::string file = dir.file("a.glb", document_of(bytes, triangles.size()).glb());
  if (components == 4) {
    CHECK(sorted(read_all(file)) == sorted(triangles));
  } else {
    CHECK_THAT(complaint_of(file), Contains("more than glTF has"));
  }
}

TEST_CASE("damaged Draco bytes are refused, or give triangles of vertices that are there", "[quick][io]") {
  const int method = GENERATE(draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING);
  const std::vector<TriangleD> triangles = sheet();
  const std::string bytes = packed(triangles, method);
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = bytes;
    for (unsigned k = 0; k <= random() % 4; ++k) damaged[random() % damaged.size()] = char(random());
    DracoMesh mesh;
    std::vector<DracoAttribute> attributes(1);
    attributes[0].components = 3;
    const std::string wrong = decode_draco(std::as_bytes(std::span(damaged)), triangles.size(), mesh, attributes);
    if (!wrong.empty()) continue;
    CHECK(mesh.indices.size() <= 3 * triangles.size());
    CHECK(attributes[0].values.size() == 3 * sizeof(float) * mesh.vertices);
    for (const std::uint32_t v : mesh.indices) CHECK(v < mesh.vertices);
  }
}
