#include <limits>
#include <nlohmann/json.hpp>

#include "io/gltf/base64.h"
#include "io/gltf/glb_file.h"
#include "io/gltf/meshopt_codec.h"
#include "io/mesh/detail/glb_data.h"
#include "io/mesh/detail/gltf_place.h"
#include "io/mesh/detail/mesh_writers.h"
#include "lib/mesh/shaded_mesh.h"

// glTF 2.0 without loss: detail/gltf_place.h says which floats hold the vertices. Triangles and vertices are ordered
// for the caches of a GPU.

namespace bp {

namespace {

using Json = GltfOutJson;

struct Buffer {
  std::string bytes;  // positions, normals, indices
  std::array<float, 3> min, max;
  std::size_t vertices = 0, indices = 0;
  [[nodiscard]] std::size_t normal_offset() const { return 12 * vertices; }
  [[nodiscard]] std::size_t index_offset() const { return 24 * vertices; }
};

void append(std::string& bytes, const void* from, std::size_t n) {
  bytes.append(static_cast<const char*>(from), n);
}

Buffer buffer_of(const LatticeMesh& mesh, const GltfPlace& place) {
  ShadedMesh drawn = shaded(mesh);
  const std::vector<std::uint32_t> order = optimize_order(drawn.triangles, drawn.vertex.size());
  Buffer b;
  b.vertices = order.size();
  b.indices = 3 * drawn.triangles.size();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  b.min = {kInfinity, kInfinity, kInfinity};
  b.max = {-kInfinity, -kInfinity, -kInfinity};
  b.bytes.reserve(24 * b.vertices + 4 * b.indices);
  for (const std::uint32_t copy : order) {
    const std::array<float, 3> p = place(mesh.vertices[drawn.vertex[copy]]);
    for (std::size_t i = 0; i < 3; ++i) {
      b.min[i] = std::min(b.min[i], p[i]);
      b.max[i] = std::max(b.max[i], p[i]);
    }
    append(b.bytes, p.data(), sizeof p);
  }
  for (const std::uint32_t copy : order) {
    const std::array<float, 3> normal = to_y_up(mesh.frame.up)(drawn.normals[copy]);
    append(b.bytes, normal.data(), sizeof normal);
  }
  append(b.bytes, drawn.triangles.data(), drawn.triangles.size() * sizeof drawn.triangles[0]);
  return b;
}

Json accessors_of(const Buffer& buffer) {
  const Json positions{{"bufferView", 0}, {"componentType", kGltfFloat}, {"count", buffer.vertices},
                       {"type", "VEC3"},  {"min", buffer.min},           {"max", buffer.max}};
  const Json normals{{"bufferView", 1}, {"componentType", kGltfFloat}, {"count", buffer.vertices}, {"type", "VEC3"}};
  const Json indices{{"bufferView", 2}, {"componentType", kGltfUint32}, {"count", buffer.indices}, {"type", "SCALAR"}};
  return Json::array({positions, normals, indices});
}

Json views_of(const Buffer& buffer) {
  const std::size_t each = buffer.normal_offset();
  const Json positions{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", each}, {"target", kGltfArrayBuffer}};
  const Json normals{{"buffer", 0}, {"byteOffset", each}, {"byteLength", each}, {"target", kGltfArrayBuffer}};
  const Json indices{{"buffer", 0},
                     {"byteOffset", buffer.index_offset()},
                     {"byteLength", 4 * buffer.indices},
                     {"target", kGltfElementArrayBuffer}};
  return Json::array({positions, normals, indices});
}

Json document_of(const LatticeMesh& mesh, const Buffer& buffer, const GltfPlace& place,
                 const MeshWriteOptions& options) {
  const Json primitive{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}, {"material", 0}};
  Json doc, node{{"name", "proxy"}, {"mesh", 0}};
  place.place(node);
  doc["asset"] = gltf_asset("bpmesh", mesh.provenance, mesh.frame.up, options.origin, contract_name(options));
  doc["scene"] = 0;
  doc["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
  doc["nodes"] = Json::array({node});
  doc["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
  doc["materials"] = Json::array({gltf_material(false)});
  doc["accessors"] = accessors_of(buffer);
  doc["bufferViews"] = views_of(buffer);
  doc["buffers"] = Json::array({{{"byteLength", buffer.bytes.size()}}});
  return doc;
}

}  // namespace

void write_gltf(const LatticeMesh& mesh, OutputFile& out, bool binary, const MeshWriteOptions& options) {
  const LatticeMesh* const all[] = {&mesh};
  const GltfPlace place(mesh, options.origin, gltf_offset(all, options.origin), out.name());
  const Buffer buffer = buffer_of(mesh, place);
  Json doc = document_of(mesh, buffer, place, options);
  if (binary) return write_glb(doc.dump(), buffer.bytes, out);
  doc["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64_of(buffer.bytes);
  out.write(doc.dump(1) + "\n");
}

}  // namespace bp
