#include "io/mesh/mesh_writer.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/files/lower.h"
#include "io/mesh/detail/mesh_writers.h"
#include "lib/core/error.h"
#include "lib/quads/quads.h"

namespace bp {

namespace {

static_assert(std::endian::native == std::endian::little, "binary formats are written in place");

/// A difference a - b, and whether it is exact.
struct Difference {
  double value;
  bool exact;
  Difference(double a, double b) : value(a - b) {
    const double of_b = a - value;
    exact = (a - (value + of_b)) + (of_b - b) == 0 && std::isfinite(value);
  }
};

std::string text_of(double x) {
  char digits[32];
  return std::string(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
}

std::string text_of(const Vec3d& p, const char* between = " ") {
  return text_of(p[0]) + between + text_of(p[1]) + between + text_of(p[2]);
}

/// Returns the multiple of a voxel nearest to `p`; subtracting it from a lattice point is exact.
Vec3d rounded_to_voxels(const GridFrame& frame, const Vec3d& p) {
  Vec3d rounded;
  for (std::size_t i = 0; i < 3; ++i) rounded[i] = std::nearbyint(p[i] / frame.voxel) * frame.voxel + 0.0;
  return rounded;
}

WorldVertices world_vertices(const LatticeMesh& mesh, const Vec3d& origin) {
  WorldVertices vertices;
  vertices.reserve(mesh.vertices.size());
  for (const LatticeCoord v : mesh.vertices) vertices.push_back(moved_exactly(mesh.frame, mesh.frame.world(v), origin));
  return vertices;
}

void check_mesh(const LatticeMesh& mesh) {
  if (mesh.triangles.empty()) fail(ErrorCode::bad_argument, "the mesh has no triangle; nothing is written");
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      if (v >= mesh.vertices.size())
        fail(ErrorCode::bad_argument, "a triangle names vertex {} of {}", v, mesh.vertices.size());
    }
  }
}

void check_floats(const LatticeMesh& mesh, const WorldVertices& vertices, const std::string& name) {
  for (const Vec3d& p : vertices) {
    for (const double c : p) {
      if (double(float(c)) == c) continue;
      fail(ErrorCode::bad_argument, {Remedy::set_origin, Remedy::double_format},
           "{}: STL holds 32-bit floats, and the coordinate {} is not one (relative to an origin of {} it may be)",
           name, text_of(c), text_of(rounded_to_voxels(mesh.frame, vertices.front()), ","));
    }
  }
}

/// Gathers the bytes of plain values before they are written.
class Bytes {
 public:
  explicit Bytes(OutputFile& out) : out_(out) {}
  template <class T>
  void put(const T& value) {
    out_.write(std::as_bytes(std::span(&value, 1)));
  }

 private:
  OutputFile& out_;
};

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

std::array<float, 3> normal_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  Vec3d e, f;
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = b[i] - a[i];
    f[i] = c[i] - a[i];
  }
  const Vec3d n{e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return {0, 0, 0};
  return {float(n[0] / length), float(n[1] / length), float(n[2] / length)};
}

}  // namespace

Vec3d moved_exactly(const GridFrame& frame, const Vec3d& p, const Vec3d& origin) {
  Vec3d moved;
  for (std::size_t i = 0; i < 3; ++i) {
    const Difference d(p[i], origin[i]);
    if (!d.exact) {
      const Vec3d near_origin = rounded_to_voxels(frame, origin);
      const bool will_do = Difference(p[i], near_origin[i]).exact;
      fail(ErrorCode::bad_argument, {Remedy::set_origin},
           "vertices cannot be moved by the origin {} without rounding, but by {}{}", text_of(origin),
           will_do ? "" : "one near the mesh, as ", text_of(will_do ? near_origin : rounded_to_voxels(frame, p), ","));
    }
    moved[i] = d.value + 0.0;  // -0 becomes 0
  }
  return moved;
}

void check_origin(const GridFrame& frame, const VoxelBox& box, const Vec3d& origin) {
  for (const VoxelCoord corner : {box.min, box.max}) {
    LatticeCoord p;
    for (int i = 0; i < 3; ++i) p[i] = std::int64_t(corner[i]) * kLatticePerVoxel;
    (void)moved_exactly(frame, frame.world(p), origin);
    (void)moved_exactly(frame, frame.world(p + LatticeCoord{1, 1, 1}), origin);  // the last bit of the frame
  }
}

std::optional<MeshFormat> mesh_format_named(const std::string& extension) {
  const std::string name = lower(extension);
  if (name == "glb") return MeshFormat::glb;
  if (name == "gltf") return MeshFormat::gltf;
  if (name == "ply") return MeshFormat::ply;
  if (name == "obj") return MeshFormat::obj;
  if (name == "stl") return MeshFormat::stl;
  return {};
}

MeshFormat mesh_format_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  const bool has_extension = dot != std::string::npos && path[dot] == '.';
  if (const auto format = mesh_format_named(has_extension ? path.substr(dot + 1) : std::string())) return *format;
  fail(ErrorCode::bad_argument, "{}: no mesh format; end the name with .glb .gltf .ply .obj or .stl", path);
}

void write_mesh(const LatticeMesh& mesh, OutputFile& out, MeshFormat format, const MeshWriteOptions& options) {
  check_mesh(mesh);
  const WorldVertices vertices = world_vertices(mesh, options.origin);
  switch (format) {
    case MeshFormat::glb:
    case MeshFormat::gltf:
      return write_gltf(mesh, out, format == MeshFormat::glb, options);
    case MeshFormat::ply:
      return write_ply(mesh, vertices, out, options);
    case MeshFormat::obj:
      return write_obj(mesh, vertices, out, options);
    case MeshFormat::stl:
      return write_stl(mesh, vertices, out);
  }
}

std::vector<std::array<float, 3>> vertex_normals(const LatticeMesh& mesh) {
  std::vector<Vec3d> sums(mesh.vertices.size(), Vec3d{});
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticeCoord &a = mesh.vertices[t[k]], u = mesh.vertices[t[(k + 1) % 3]] - a,
                         v = mesh.vertices[t[(k + 2) % 3]] - a;
      const Vec3d n{double(u.y) * double(v.z) - double(u.z) * double(v.y),
                    double(u.z) * double(v.x) - double(u.x) * double(v.z),
                    double(u.x) * double(v.y) - double(u.y) * double(v.x)};
      const double area = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      const double along = double(u.x) * double(v.x) + double(u.y) * double(v.y) + double(u.z) * double(v.z);
      if (!(area > 0)) continue;
      const double weight = std::atan2(area, along) / area;
      for (std::size_t i = 0; i < 3; ++i) sums[t[k]][i] += weight * n[i];
    }
  }
  std::vector<std::array<float, 3>> normals;
  for (const Vec3d& s : sums) {
    const double l = std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    normals.push_back(l > 0 ? std::array<float, 3>{float(s[0] / l), float(s[1] / l), float(s[2] / l)}
                            : std::array<float, 3>{0, 0, 1});
  }
  return normals;
}

std::vector<std::string> provenance_lines(const LatticeMesh& mesh, const MeshWriteOptions& options) {
  const std::string maker = mesh.provenance.empty() ? "bpmesh" : mesh.provenance.back().tool;
  std::vector<std::string> lines{"made by " + maker + " " BP_VERSION};
  for (const Provenance& step : mesh.provenance) {
    std::string line = "provenance: " + step.tool + " " + step.version + " " + step.options;
    if (!step.input_hash.empty()) line += " input " + step.input_hash;
    lines.push_back(one_line(line));
  }
  if (options.origin != Vec3d{}) lines.push_back("origin: " + text_of(options.origin));
  if (options.contract) lines.push_back("contract: " + contract_name(options));
  return lines;
}

void write_ply(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out,
               const MeshWriteOptions& options) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& line : provenance_lines(mesh, options)) header += "comment " + line + "\n";
  header +=
      fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", vertices.size());
  if (options.normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
  const PolygonFaces faces = polygon_faces(mesh);
  header += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                        faces.triangles.size() + faces.quads.size());
  out.write(header);
  Bytes bytes(out);
  if (options.normals) {
    const std::vector<std::array<float, 3>> normals = vertex_normals(mesh);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      bytes.put(vertices[i]);
      bytes.put(normals[i]);
    }
  } else {
    out.write(std::as_bytes(std::span(vertices)));
  }
  for (const auto& t : faces.triangles) {
    bytes.put(std::uint8_t(3));
    bytes.put(t);
  }
  for (const Quad& q : faces.quads) {
    bytes.put(std::uint8_t(4));
    bytes.put(q);
  }
}

void write_obj(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out,
               const MeshWriteOptions& options) {
  std::string text;
  for (const std::string& line : provenance_lines(mesh, options)) text += "# " + line + "\n";
  out.write(text);
  for (const Vec3d& p : vertices) out.write("v " + text_of(p) + "\n");
  if (options.normals) {
    for (const auto& n : vertex_normals(mesh)) out.write(fmt::format("vn {} {} {}\n", n[0], n[1], n[2]));
  }
  const auto corner = [&](std::uint32_t v) {
    return options.normals ? fmt::format(" {0}//{0}", std::uint64_t(v) + 1) : fmt::format(" {}", std::uint64_t(v) + 1);
  };
  const PolygonFaces faces = polygon_faces(mesh);
  for (const auto& t : faces.triangles) out.write(fmt::format("f{}{}{}\n", corner(t[0]), corner(t[1]), corner(t[2])));
  for (const Quad& q : faces.quads)
    out.write(fmt::format("f{}{}{}{}\n", corner(q[0]), corner(q[1]), corner(q[2]), corner(q[3])));
}

void write_stl(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out) {
  check_floats(mesh, vertices, out.name());
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    fail(ErrorCode::bad_argument, {Remedy::ply_format}, "{}: STL counts its triangles in 32 bits", out.name());
  char header[80] = "bpmesh " BP_VERSION;
  Bytes bytes(out);
  bytes.put(header);
  bytes.put(std::uint32_t(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    const Vec3d &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    bytes.put(normal_of(a, b, c));
    for (const Vec3d* p : {&a, &b, &c}) bytes.put(std::array<float, 3>{float((*p)[0]), float((*p)[1]), float((*p)[2])});
    bytes.put(std::uint16_t(0));
  }
}

}  // namespace bp
