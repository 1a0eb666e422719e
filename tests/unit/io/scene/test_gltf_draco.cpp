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

/// `more`: components of an attribute of the exporter's own, all zero; 0: there is none.
std::string packed(const std::vector<TriangleD>& triangles, int method, std::size_t more = 0) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(int(triangles.size()));
  const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const std::vector<double> zeros(more);
  const int own =
      more > 0 ? builder.AddAttribute(draco::GeometryAttribute::GENERIC, std::int8_t(more), draco::DT_FLOAT64) : 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<std::array<float, 3>, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) corners[k][axis] = float(triangles[i][k][axis]);
    builder.SetAttributeValuesForFace(id, draco::FaceIndex(std::uint32_t(i)), corners[0].data(), corners[1].data(),
                                      corners[2].data());
    if (more > 0)
      builder.SetAttributeValuesForFace(own, draco::FaceIndex(std::uint32_t(i)), zeros.data(), zeros.data(),
                                        zeros.data());
  }
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

TEST_CASE("attributes of Draco that take memory without end are refused before there is room", "[quick][io]") {
  const std::size_t components = GENERATE(4, 127);
  const std::vector<TriangleD> triangles = sheet();
  const std::string bytes = packed(triangles, draco::MESH_EDGEBREAKER_ENCODING, components);
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
