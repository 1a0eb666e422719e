#include "io/mesh/obj_level.h"

#include "io/mesh/detail/mesh_writers.h"
#include "lib/core/error.h"
#include "lib/mesh/shaded_mesh.h"

namespace bp {

namespace {

/// Writes vertices. Without colours: those of the mesh, so that it stays closed. With colours: one for each copy, which
/// has one colour.
void write_vertices(const LatticeMesh& mesh, const ShadedMesh& drawn, OutputFile& out, const Vec3d& origin) {
  const auto line = [&](std::uint32_t v, const std::string& rest) {
    const Vec3d p = moved_exactly(mesh.frame, mesh.frame.world(mesh.vertices[v]), origin);
    out.write(fmt::format("v {} {} {}{}\n", p[0], p[1], p[2], rest));
  };
  if (drawn.colors.empty()) {
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) line(v, "");
    return;
  }
  for (std::size_t i = 0; i < drawn.vertex.size(); ++i) {
    const auto c = srgb_bytes(drawn.colors[i]);
    line(drawn.vertex[i], fmt::format(" {:.4g} {:.4g} {:.4g}", c[0] / 255.0, c[1] / 255.0, c[2] / 255.0));
  }
}

}  // namespace

void write_obj_level(const LatticeMesh& mesh, const std::string& name, const std::string& materials, OutputFile& out,
                     const MeshWriteOptions& options) {
  if (mesh.triangles.empty()) fail(ErrorCode::bad_argument, "{}: the mesh has no triangle", name);
  const ShadedMesh drawn = shaded(mesh);
  for (const std::string& line : provenance_lines(mesh, options)) out.write("# " + line + "\n");
  if (!materials.empty()) out.write("mtllib " + materials + "\n");
  out.write("o " + name + "\n");
  write_vertices(mesh, drawn, out, options.origin);
  for (const auto& p : drawn.uv) out.write(fmt::format("vt {:.7g} {:.7g}\n", p[0], 1 - double(p[1])));  // v from below
  for (const auto& n : drawn.normals) out.write(fmt::format("vn {:.4f} {:.4f} {:.4f}\n", n[0], n[1], n[2]));
  if (!materials.empty()) out.write("usemtl " + name + "\n");
  for (const auto& t : drawn.triangles) {
    std::string face = "f";
    for (const std::uint32_t i : t) {
      const std::uint64_t copy = std::uint64_t(i) + 1, v = drawn.colors.empty() ? drawn.vertex[i] + 1ULL : copy;
      face += drawn.uv.empty() ? fmt::format(" {}//{}", v, copy) : fmt::format(" {}/{}/{}", v, copy, copy);
    }
    out.write(face + "\n");
  }
}

std::string mtl_text(const std::string& name, const MeshTexture& texture, const MtlImages& images) {
  constexpr double kGrey = 0.8;  // sRGB
  const double c = images.color.empty() ? kGrey : 1;
  std::string text = fmt::format("newmtl {}\nKd {} {} {}\nKs 0 0 0\nillum 1\n", name, c, c, c);
  const auto map = [&](const char* key, const std::string& image) {
    if (!image.empty()) text += fmt::format("{} {}\n", key, image);
  };
  map("map_Kd", images.color);
  map("map_d", images.alpha);
  map("norm", images.normal);
  text += fmt::format("Pr {}\nPm {}\n", images.roughness.empty() ? texture.roughness_factor : 1.0,
                      images.metal.empty() ? (images.roughness.empty() ? texture.metal_factor : 0.0) : 1.0);
  map("map_Pr", images.roughness);
  map("map_Pm", images.metal);
  if (!images.emission.empty()) text += "Ke 1 1 1\n";
  map("map_Ke", images.emission);
  return text;
}

}  // namespace bp
