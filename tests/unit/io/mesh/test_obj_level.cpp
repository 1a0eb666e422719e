#include "io/mesh/obj_level.h"
#include "lib/mesh/lattice_mesh.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Two faces of one plane, and one that stands on it.
LatticeMesh corner_mesh() {
  LatticeMesh mesh;
  mesh.frame.voxel = 64;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 0, 4}, {0, 0, 4}, {0, 4, 0}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}};
  return mesh;
}

std::string written(const LatticeMesh& mesh, const std::string& materials) {
  const TempDir dir;
  OutputFile out(dir.path("a.obj"), false);
  write_obj_level(mesh, "level", materials, out, {{1, 0, 0}});
  out.commit();
  return bytes_of_file(dir.path("a.obj"));
}

}  // namespace

TEST_CASE("a level as OBJ has exact vertices, creased normals and places counted from below", "[quick][io]") {
  LatticeMesh mesh = corner_mesh();
  MeshTexture texture;
  texture.uv.assign(3, {{{0, 0}, {0.25F, 1}, {1, 1}}});
  texture.chart = {0, 1, 2};
  mesh.texture = std::make_shared<MeshTexture>(texture);
  const std::string text = written(mesh, "level.mtl");
  CHECK_THAT(text, Contains("mtllib level.mtl\no level\nv -1 0 0\nv 3 0 0\n"));
  CHECK_THAT(text, Contains("vt 0 1\nvt 0.25 0\nvt 1 0\n"));
  CHECK_THAT(text, Contains("vn 0.0000 1.0000 0.0000\n"));
  CHECK_THAT(text, Contains("usemtl level\nf 1/1/1 3/2/2 2/3/3\n"));
  mesh.texture = nullptr;
  const std::string plain = written(mesh, "");
  CHECK_THAT(plain, !Contains("mtl") && !Contains("vt "));
  CHECK_THAT(plain, Contains("f 1//1 3//2 2//3\nf 1//1 4//4 3//2\nf 1//5 2//6 5//7\n"));  // the plane is not split
}

TEST_CASE("colours of a level as OBJ are numbers of its vertices, split where they differ", "[quick][io]") {
  LatticeMesh mesh = corner_mesh();
  const LinearColor red{65535, 0, 0}, white = kWhite;
  mesh.colors = {{red, red, red}, {red, red, red}, {white, white, white}};
  const std::string text = written(mesh, "");
  CHECK_THAT(text, Contains("v -1 0 0 1 0 0\n") && Contains("v -1 0 0 1 1 1\n"));
  const TempDir dir;
  const IndexedMesh read = read_mesh(dir.file("a.obj", text));
  CHECK(read.triangles.size() == 3);
  CHECK(read.vertices.size() == 5);
}

TEST_CASE("a material names the images that are there", "[quick][io]") {
  MeshTexture texture;
  CHECK(mtl_text("a", texture, {}) == "newmtl a\nKd 0.8 0.8 0.8\nKs 0 0 0\nillum 1\nPr 1\nPm 0\n");
  CHECK(mtl_text("a", texture, {"c.png", "a.jpg", "n.jpg", "r.jpg", "m.jpg", "e.jpg"}) ==
        "newmtl a\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd c.png\nmap_d a.jpg\nnorm n.jpg\nPr 1\nPm 1\nmap_Pr r.jpg\n"
        "map_Pm m.jpg\nKe 1 1 1\nmap_Ke e.jpg\n");
}
