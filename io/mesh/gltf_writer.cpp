#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/gltf/base64.h"
#include "io/gltf/glb_file.h"
#include "io/mesh/detail/glb_data.h"
#include "io/mesh/detail/mesh_writers.h"
#include "lib/core/box.h"
#include "lib/core/error.h"
#include "lib/mesh/shaded_mesh.h"

// glTF 2.0 without loss. Vertices are written as lattice integers relative to a whole-number centre, which float32
// holds up to 2^24 exactly. The node's scale is the lattice unit (a double of few bits) and its translation the centre
// in scene units (a whole multiple of the unit). A reader that works in double finds frame.world(v): the product of
// integer and unit is exact (24 + 24 bits), and the sum is a lattice point, which the frame makes a double, so it is
// not rounded.

namespace bp {

namespace {

using Json = GltfOutJson;

LatticeCoord centre_of(const LatticeMesh& mesh, const std::string& name) {
  LatticeCoord lo = mesh.vertices.front(), hi = lo, centre;
  for (const LatticeCoord v : mesh.vertices) {
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], v[i]);
      hi[i] = std::max(hi[i], v[i]);
    }
  }
  for (int i = 0; i < 3; ++i) {
    centre[i] = lo[i] + (hi[i] - lo[i]) / 2;
    if (hi[i] - centre[i] <= kFloatInteger && centre[i] - lo[i] <= kFloatInteger) continue;
    fail(ErrorCode::bad_argument, {Remedy::ply_format, Remedy::larger_voxels},
         "{}: the mesh spans {} voxels, and glTF's 32-bit floats hold 2^19 of them exactly", name,
         (hi[i] - lo[i]) / kLatticePerVoxel);
  }
  return centre;
}

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

Buffer buffer_of(const LatticeMesh& mesh, LatticeCoord centre) {
  const ShadedMesh drawn = shaded(mesh);
  Buffer b;
  b.vertices = drawn.vertex.size();
  b.indices = 3 * drawn.triangles.size();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  b.min = {kInfinity, kInfinity, kInfinity};
  b.max = {-kInfinity, -kInfinity, -kInfinity};
  b.bytes.reserve(24 * b.vertices + 4 * b.indices);
  for (const std::uint32_t v : drawn.vertex) {
    const LatticeCoord d = mesh.vertices[v] - centre;
    const std::array<float, 3> p{float(d.x), float(d.y), float(d.z)};
    for (std::size_t i = 0; i < 3; ++i) {
      b.min[i] = std::min(b.min[i], p[i]);
      b.max[i] = std::max(b.max[i], p[i]);
    }
    append(b.bytes, p.data(), sizeof p);
  }
  append(b.bytes, drawn.normals.data(), drawn.normals.size() * sizeof drawn.normals[0]);
  append(b.bytes, drawn.triangles.data(), drawn.triangles.size() * sizeof drawn.triangles[0]);
  return b;
}

/// Column by column; a quaternion would round.
Json matrix_of(const AxisTurn& turn) {
  std::array<int, 16> m{};
  for (std::size_t i = 0; i < 3; ++i) m[4 * turn.axis[i] + i] = turn.negative[i] ? -1 : 1;
  m[15] = 1;
  return m;
}

Json nodes_of(const LatticeMesh& mesh, LatticeCoord centre, const MeshWriteOptions& options) {
  const double unit = mesh.frame.voxel / kLatticePerVoxel;
  const Vec3d translation = moved_exactly(mesh.frame, mesh.frame.world(centre), options.origin);
  Json nodes = Json::array();
  nodes.push_back(
      {{"name", "proxy"}, {"mesh", 0}, {"translation", translation}, {"scale", Json::array({unit, unit, unit})}});
  if (mesh.frame.up != UpAxis::y) {
    nodes.push_back({{"name", fmt::format("{} up to y up", name_of(mesh.frame.up))},
                     {"matrix", matrix_of(to_y_up(mesh.frame.up))},
                     {"children", Json::array({0})}});
  }
  return nodes;
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

Json document_of(const LatticeMesh& mesh, const Buffer& buffer, LatticeCoord centre, const MeshWriteOptions& options) {
  const Json primitive{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}, {"material", 0}};
  Json doc;
  doc["asset"] = gltf_asset("bpmesh", mesh.provenance, mesh.frame.up, options.origin, contract_name(options));
  doc["scene"] = 0;
  doc["scenes"] = Json::array({{{"nodes", Json::array({mesh.frame.up == UpAxis::y ? 0 : 1})}}});
  doc["nodes"] = nodes_of(mesh, centre, options);
  doc["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
  doc["materials"] = Json::array({gltf_material(false)});
  doc["accessors"] = accessors_of(buffer);
  doc["bufferViews"] = views_of(buffer);
  doc["buffers"] = Json::array({{{"byteLength", buffer.bytes.size()}}});
  return doc;
}

}  // namespace

void write_gltf(const LatticeMesh& mesh, OutputFile& out, bool binary, const MeshWriteOptions& options) {
  const LatticeCoord centre = centre_of(mesh, out.name());
  const Buffer buffer = buffer_of(mesh, centre);
  Json doc = document_of(mesh, buffer, centre, options);
  if (binary) return write_glb(doc.dump(), buffer.bytes, out);
  doc["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64_of(buffer.bytes);
  out.write(doc.dump(1) + "\n");
}

}  // namespace bp
