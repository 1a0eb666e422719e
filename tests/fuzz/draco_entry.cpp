#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/fuzz/entries.h"
#include "tests/fuzz/hostile_scene.h"
#include "tests/fuzz/tool_runs.h"

namespace fuzz {

namespace {

using Json = nlohmann::ordered_json;

/// Finite: what the packer makes of other numbers is its own business.
std::array<float, 3> corner(const std::array<double, 3>& p) {
  std::array<float, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = std::abs(p[i]) < 1e30 ? float(p[i]) : 1.0f;
  return out;
}

/// Nothing where Draco packs nothing.
std::string packed(Choices& c, const Shape& shape) {
  if (shape.triangles.empty()) return "";
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(int(shape.triangles.size()));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const bool more = c.once_in(3);
  const int color = more ? builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8) : 0;
  const std::array<std::uint8_t, 4> red{200, 10, 10, 255};
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    const draco::FaceIndex face(static_cast<std::uint32_t>(i));
    std::array<std::array<float, 3>, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = corner(shape.points[shape.triangles[i][k]]);
    builder.SetAttributeValuesForFace(position, face, p[0].data(), p[1].data(), p[2].data());
    if (more) builder.SetAttributeValuesForFace(color, face, red.data(), red.data(), red.data());
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  if (mesh == nullptr || mesh->num_faces() == 0) return "";
  draco::Encoder encoder;
  encoder.SetEncodingMethod(c.once_in(2) ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
  const int speed = int(c.below(11));
  encoder.SetSpeedOptions(speed, speed);
  if (c.once_in(2)) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 1 + int(c.below(20)));
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) return "";
  return {buffer.data(), buffer.size()};
}

void damage(Choices& c, std::string& bytes) {
  if (bytes.empty() || c.once_in(4)) return;
  const auto size = [&] { return std::uint32_t(std::min<std::size_t>(bytes.size(), 60000)); };
  for (std::uint32_t n = 1 + c.below(4); n > 0; --n) {
    const std::uint32_t at = c.once_in(2) ? c.below(std::min(size(), 40u)) : c.below(size());
    bytes[at] = c.once_in(3) ? c.of<char>({char(0xff), 0, 0x7f, char(0x80), 1}) : char(c.byte());
  }
  if (c.once_in(12)) bytes.resize(c.below(size()) + 1);
  if (c.once_in(12)) bytes.insert(c.below(size()), std::string(1 + c.below(9), char(c.byte())));
}

std::uint64_t whole_number(Choices& c, std::uint64_t sound) {
  return c.once_in(24) ? std::uint64_t(extreme_integer(c)) : sound;
}

/// One mesh in one node.
std::string document(Choices& c, const std::string& bytes, std::size_t triangles) {
  Json json;
  json["asset"]["version"] = "2.0";
  json["extensionsUsed"] = json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  json["scene"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  json["nodes"] = {{{"mesh", 0}}};
  const std::uint64_t count = whole_number(c, 3 * triangles);
  json["accessors"] = {
      {{"componentType", c.once_in(12) ? 5120 + c.below(8) : 5126u}, {"count", count}, {"type", "VEC3"}},
      {{"componentType", c.of({5125, 5123, 5121})}, {"count", whole_number(c, count)}, {"type", "SCALAR"}},
      {{"componentType", 5121}, {"normalized", true}, {"count", count}, {"type", c.once_in(2) ? "VEC4" : "VEC3"}}};
  Json primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}};
  Json extension = {{"bufferView", 0}, {"attributes", {{"POSITION", whole_number(c, 0)}}}};
  if (c.once_in(3)) {
    primitive["attributes"]["COLOR_0"] = 2;
    extension["attributes"]["COLOR_0"] = whole_number(c, 1);
  }
  primitive["extensions"]["KHR_draco_mesh_compression"] = extension;
  json["meshes"] = {{{"primitives", {primitive}}}};
  if (c.once_in(12)) json["meshes"][0]["primitives"].push_back(primitive);
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", bytes.size()}}};
  json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "b.bin"}}};
  return json.dump();
}

}  // namespace

void draco(const std::uint8_t* data, std::size_t size) {
  Choices c(data, size);
  const std::uint32_t way = roll(data, size, 16);
  Shape shape = hostile_shape(c);
  std::string bytes;
  if (c.once_in(12)) {
    bytes = "DRACO\2\2\1" + std::string(1, char(c.below(2))) + c.rest();
  } else {
    bytes = packed(c, shape);
    damage(c, bytes);
  }
  Workplace place;
  place.write("b.bin", bytes);
  place.write("s.gltf", document(c, bytes, shape.triangles.size()));
  const std::string scene = place.path("s.gltf");
  if (way == 0) {
    (void)place.run("bpinfo", {scene, "--image", place.path("x.png"), "--image-size", "48"}, {"x.png"});
  } else if (way == 1) {
    (void)place.run("bpcheck", {scene});
  } else if (way == 2) {
    (void)place.run("bpvox", {scene, "--resolution", "8", "-o", place.path("v.bpv")}, {"v.bpv"});
  } else {
    (void)place.run("bpinfo", {scene});
  }
}

}  // namespace fuzz
