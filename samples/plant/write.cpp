#include "samples/plant/write.h"

#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "lib/core/error.h"

namespace plant {

namespace {

static_assert(std::endian::native == std::endian::little, "the writers copy numbers as they lie in memory");

template <class... Numbers>
void put(bp::OutputFile& file, Numbers... numbers) {
  std::array<std::byte, (sizeof(Numbers) + ...)> bytes;
  std::size_t at = 0;
  ((std::memcpy(bytes.data() + at, &numbers, sizeof numbers), at += sizeof numbers), ...);
  file.write(bytes);
}

class PlyVertices : public Sink {
 public:
  /// Parts count from `number`; part `raised` stands higher.
  PlyVertices(bp::OutputFile& file, const Placement& at, std::uint64_t number = 0, std::uint64_t raised = kNone)
      : file_(file), at_(at), number_(number), raised_(raised) {}
  Wants part(std::uint32_t, std::uint32_t) override {
    rise_ = number_++ == raised_ ? kRise : 0;
    return vertices;
  }
  void vertex(Vec v) override {
    const Vec p = at_.apply(v);
    put(file_, float(p.x), float(p.y + rise_), float(p.z));
  }
  static constexpr std::uint64_t kNone = ~std::uint64_t(0);
  static constexpr double kRise = 2;

 private:
  bp::OutputFile& file_;
  const Placement& at_;
  std::uint64_t number_, raised_;
  double rise_ = 0;
};

/// Faces, numbered from `first`; with or without the count that PLY wants before each.
class Faces : public Sink {
 public:
  Faces(bp::OutputFile& file, std::uint64_t first, bool mirrored, bool counted)
      : file_(file), next_(first), mirrored_(mirrored), counted_(counted) {}
  Wants part(std::uint32_t vertex_count, std::uint32_t) override {
    base_ = std::uint32_t(next_);
    next_ += vertex_count;
    return faces;
  }
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c) override {
    if (mirrored_) std::swap(b, c);
    if (counted_) put(file_, std::uint8_t(3));
    put(file_, base_ + a, base_ + b, base_ + c);
  }

 private:
  bp::OutputFile& file_;
  std::uint64_t next_;
  std::uint32_t base_ = 0;
  bool mirrored_, counted_;
};

class Bounds : public Sink {
 public:
  Wants part(std::uint32_t, std::uint32_t) override { return vertices; }
  void vertex(Vec v) override {
    const std::array<float, 3> p{float(v.x), float(v.y), float(v.z)};
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  std::array<float, 3> lo{1e30f, 1e30f, 1e30f}, hi{-1e30f, -1e30f, -1e30f};
};

std::string matrix_text(const Placement& p) {
  return fmt::format("[{},0,{},0,0,1,0,0,{},0,{},0,{},0,{},1]", p.xx, p.zx, p.xz, p.zz, p.dx, p.dz);
}

/// The nodes of all placements, and their numbers.
std::array<std::string, 2> glb_nodes(const Site& site, const std::vector<int>& mesh_of) {
  std::string nodes, roots;
  std::uint64_t node = 0;
  site.for_each([&](const Placement& p) {
    const char* comma = node > 0 ? "," : "";
    const bool plain = p.xx == 1 && p.zz == 1;
    nodes += plain ? fmt::format("{}{{\"mesh\":{},\"translation\":[{},0,{}]}}", comma, mesh_of[p.shape], p.dx, p.dz)
                   : fmt::format("{}{{\"mesh\":{},\"matrix\":{}}}", comma, mesh_of[p.shape], matrix_text(p));
    roots += fmt::format("{}{}", comma, node++);
  });
  return {nodes, roots};
}

/// The JSON of the GLB; `mesh_of` maps a shape to its mesh, as some shapes may not be in use.
std::string glb_json(const Site& site, const std::vector<int>& mesh_of, std::uint64_t binary_bytes) {
  std::string accessors, views, meshes;
  std::uint64_t offset = 0;
  int mesh = 0;
  for (std::size_t s = 0; s < site.shapes().size(); ++s) {
    if (mesh_of[s] < 0) continue;
    const Counts& counts = site.shapes()[s].counts;
    Bounds bounds;
    site.build_shape(s, bounds);
    const char* comma = mesh > 0 ? "," : "";
    accessors += fmt::format(
        "{}{{\"bufferView\":{},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\",\"min\":[{},{},{}],\"max\":[{},{},"
        "{}]}},"
        "{{\"bufferView\":{},\"componentType\":5125,\"count\":{},\"type\":\"SCALAR\"}}",
        comma, 2 * mesh, counts.vertices, bounds.lo[0], bounds.lo[1], bounds.lo[2], bounds.hi[0], bounds.hi[1],
        bounds.hi[2], 2 * mesh + 1, 3 * counts.triangles);
    const std::uint64_t vertex_bytes = 12 * counts.vertices, index_bytes = 12 * counts.triangles;
    views += fmt::format(
        "{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":34962}},"
        "{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":34963}}",
        comma, offset, vertex_bytes, offset + vertex_bytes, index_bytes);
    meshes += fmt::format("{}{{\"primitives\":[{{\"attributes\":{{\"POSITION\":{}}},\"indices\":{}}}]}}", comma,
                          2 * mesh, 2 * mesh + 1);
    offset += vertex_bytes + index_bytes;
    ++mesh;
  }
  const auto [nodes, roots] = glb_nodes(site, mesh_of);
  std::string json = fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"bp-plant\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],"
      "\"nodes\":[{}],"
      "\"meshes\":[{}],\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]}}",
      roots, nodes, meshes, accessors, views, binary_bytes);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return json;
}

}  // namespace

namespace {

void write_ply(const Site& site, std::uint64_t raised, bp::OutputFile& file) {
  const Counts& counts = site.counts();
  if (counts.vertices > 0xffffffffu) {
    bp::fail(bp::ErrorCode::bad_argument,
             "{} vertices do not fit the 32-bit indices of PLY; write GLB, or several files", counts.vertices);
  }
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment bp-plant\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      counts.vertices, counts.triangles));
  std::uint64_t part = 0;
  site.for_each([&](const Placement& p) {
    PlyVertices sink(file, p, part, raised);
    site.build_shape(p.shape, sink);
    part += site.shapes()[p.shape].counts.parts;
  });
  std::uint64_t first = 0;
  site.for_each([&](const Placement& p) {
    Faces sink(file, first, p.mirrored(), true);
    site.build_shape(p.shape, sink);
    first += site.shapes()[p.shape].counts.vertices;
  });
}

}  // namespace

void write_ply(const Site& site, bp::OutputFile& file) {
  write_ply(site, PlyVertices::kNone, file);
}

void write_changed_ply(const Site& site, std::uint64_t changed, bp::OutputFile& file) {
  if (changed >= site.counts().parts)
    bp::fail(bp::ErrorCode::bad_argument, "there is no component {}; the site has {}", changed, site.counts().parts);
  write_ply(site, changed, file);
}

void write_glb(const Site& site, bp::OutputFile& file) {
  std::vector<int> mesh_of(site.shapes().size(), -1);
  site.for_each([&](const Placement& p) { mesh_of[p.shape] = 0; });
  std::uint64_t binary_bytes = 0;
  int mesh = 0;
  for (std::size_t s = 0; s < mesh_of.size(); ++s) {
    if (mesh_of[s] < 0) continue;
    mesh_of[s] = mesh++;
    binary_bytes += 12 * (site.shapes()[s].counts.vertices + site.shapes()[s].counts.triangles);
  }
  const std::string json = glb_json(site, mesh_of, binary_bytes);
  const std::uint64_t total = 12 + 8 + json.size() + 8 + binary_bytes;
  if (total > 0xffffffffu)
    bp::fail(bp::ErrorCode::bad_argument, "the site takes {} bytes, and a GLB holds 4 GiB; write PLY", total);
  put(file, std::uint32_t(0x46546c67), std::uint32_t(2), std::uint32_t(total));
  put(file, std::uint32_t(json.size()), std::uint32_t(0x4e4f534a));
  file.write(json);
  put(file, std::uint32_t(binary_bytes), std::uint32_t(0x004e4942));
  for (std::size_t s = 0; s < mesh_of.size(); ++s) {
    if (mesh_of[s] < 0) continue;
    const Placement here{s, 1, 0, 0, 1, 0, 0};
    PlyVertices vertices(file, here);
    site.build_shape(s, vertices);
    Faces faces(file, 0, false, false);
    site.build_shape(s, faces);
  }
}

}  // namespace plant
