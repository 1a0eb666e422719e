#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/atlas/tangents.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/image/mip_image.h"
#include "lib/pass/bake/bake.h"
#include "lib/store/memory_scratch.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/textured_scene.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A cube of half a unit; a material with images of one colour each.
struct Fixture {
  TexturedScene scene;
  std::shared_ptr<MemoryTextures> textures = std::make_shared<MemoryTextures>();
  LatticeMesh mesh;
  Atlas atlas;

  Fixture() {
    scene.add_cube({0.25, 0.25, 0.25}, 0.5, 0);
    mesh.frame.voxel = 1.0 / 64;
    add_box(mesh, {{1000, 1000, 1000}, {3096, 3096, 3096}});
    atlas = unwrap(mesh, {64, 4096});
    textures->materials.emplace_back();
  }
  std::uint32_t add(TextureImage::Texel texel) {
    textures->images.emplace_back(4, 4, texel);
    return std::uint32_t(textures->images.size() - 1);
  }
  TextureSurface& surface() { return textures->materials[0].surface; }
  template <class Bake>
  [[nodiscard]] auto bake_with(const Bake& bake) const {
    TexturedSource source(scene);
    Bounds3d bounds;
    for (const TriangleD& t : scene.triangles) bounds.merge(bounds_of(t));
    const SceneLooks looks({source, bounds, scene.triangles.size(), textures}, std::make_unique<MemoryScratch>(), {});
    BakeParams params;
    params.reach_world = 0.3;
    return bake(mesh, atlas, looks, params);
  }
  [[nodiscard]] BakedSurface bake() const { return bake_with(bake_surface); }
  [[nodiscard]] TextureImage bake_color() const { return bake_with(bp::bake); }
  /// Returns, for each face, the direction in the scene that the image gives at the middle of the face, as a viewer
  /// reads it.
  [[nodiscard]] std::vector<Vec3d> directions(const TextureImage& image) const {
    LatticeMesh placed = mesh;
    auto texture = std::make_shared<MeshTexture>();
    texture->uv = atlas.corners;
    texture->chart = atlas.chart;
    placed.texture = texture;
    const ShadedMesh drawn = shaded(placed);
    const std::vector<std::array<float, 4>> tangents = tangents_of(placed, drawn);
    std::vector<Vec3d> all;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      double x = 0, y = 0;
      for (const auto& p : atlas.corners[f]) x += double(p[0]) / 3, y += double(p[1]) / 3;
      const TextureImage::Texel& said = image.at(int(x), int(y));
      const std::uint32_t copy = drawn.triangles[f][0];
      const std::array<float, 4>& t = tangents[copy];
      const Vec3d n{drawn.normals[copy][0], drawn.normals[copy][1], drawn.normals[copy][2]}, along{t[0], t[1], t[2]};
      const Vec3d up = double(t[3]) * cross(n, along);
      const auto part = [&](std::size_t i) { return 2 * double(said[i]) / 255 - 1; };
      all.push_back(part(0) * along + part(1) * up + part(2) * n);
    }
    return all;
  }
};

Vec3d unit(const Vec3d& v) {
  return (1 / length(v)) * v;
}

Vec3d normal_of(const LatticeMesh& mesh, std::size_t f) {
  const auto at = [&](std::size_t k) { return mesh.frame.world(mesh.vertices[mesh.triangles[f][k]]); };
  return unit(cross(at(1) - at(0), at(2) - at(0)));
}

}  // namespace

TEST_CASE("a level's image of directions says what the scene's says, on all sides", "[quick][bake]") {
  Fixture f;
  const bool mirrored = GENERATE(false, true);
  if (mirrored) {
    for (TriangleTexture& t : f.scene.textures)
      for (auto& uv : t.uv) uv[0] = 1 - uv[0];
  }
  const Vec3d said = unit({0.4, 0.2, 0.9});
  const auto byte = [](double x) { return std::uint8_t((x / 2 + 0.5) * 255 + 0.5); };
  f.surface().normal.image = f.add({byte(said[0]), byte(said[1]), byte(said[2]), 255});
  const std::vector<Vec3d> found = f.directions(f.bake().normal);
  for (std::size_t face = 0; face < found.size(); ++face) {
    const Vec3d n = normal_of(f.mesh, face);
    // The scene's side that looks this way: u and v by its places.
    for (std::size_t i = 0; i < f.scene.triangles.size(); ++i) {
      const TriangleD& t = f.scene.triangles[i];
      if (dot(unit(cross(t[1] - t[0], t[2] - t[0])), n) < 0.9) continue;
      const auto& uv = f.scene.textures[i].uv;
      Vec3d right{}, down{};  // from corners that share v, or u
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t m = (k + 1) % 3;
        const float du = uv[m][0] - uv[k][0], dv = uv[m][1] - uv[k][1];
        if (dv == 0) right = (du > 0 ? 1.0 : -1.0) * unit(t[m] - t[k]);
        if (du == 0) down = (dv > 0 ? 1.0 : -1.0) * unit(t[m] - t[k]);
      }
      const Vec3d expected = said[0] * right - said[1] * down + said[2] * n;
      CHECK(dot(found[face], expected) > 0.995);
      break;
    }
  }
}

TEST_CASE("an image of directions says nothing of triangles without an area in it", "[quick][bake]") {
  Fixture f;
  const float place = GENERATE(0.5F, std::numeric_limits<float>::infinity(), NAN);
  for (TriangleTexture& t : f.scene.textures)
    for (auto& uv : t.uv) uv = {place, 0.5F};
  f.surface().normal.image = f.add({200, 150, 220, 255});
  const std::vector<Vec3d> found = f.directions(f.bake().normal);
  for (std::size_t face = 0; face < found.size(); ++face) CHECK(dot(found[face], normal_of(f.mesh, face)) > 0.995);
}

TEST_CASE("a level's image of directions has the normals of the scene's corners", "[quick][bake]") {
  Fixture f;
  const Vec3d lean = unit({0.3, 0.2, 1});
  for (std::size_t i = 0; i < f.scene.triangles.size(); ++i) {
    const TriangleD& t = f.scene.triangles[i];
    const Vec3d n = unit(cross(t[1] - t[0], t[2] - t[0]));
    if (n[2] > 0.9) f.scene.textures[i].normals.fill(pack_normal(lean));
  }
  const std::vector<Vec3d> found = f.directions(f.bake().normal);
  for (std::size_t face = 0; face < found.size(); ++face) {
    const Vec3d n = normal_of(f.mesh, face);
    CHECK(dot(found[face], n[2] > 0.9 ? lean : n) > 0.99);
  }
}

TEST_CASE("roughness, metal and light are the material's images times its factors", "[quick][bake]") {
  Fixture f;
  f.surface().roughness.image = f.add({7, 200, 100, 255});
  f.surface().roughness_factor = 0.5F;
  f.surface().metal_factor = 1;
  f.surface().emission.image = f.add({255, 128, 0, 255});
  f.surface().emission_factor = {1, 0.5F, 1};
  const BakedSurface baked = f.bake();
  const TextureImage::Texel rough = baked.roughness.texels[0], light = baked.emission.texels[0];
  CHECK(std::abs(int(rough[1]) - 100) <= 1);
  CHECK(std::abs(int(rough[2]) - 100) <= 1);
  CHECK(int(light[0]) == 255);
  CHECK(int(light[1]) == int(byte_of_linear(linear_of_byte(128) / 2)));
  CHECK(int(light[2]) == 0);
}

TEST_CASE("an image of colours alone shows colours and light together", "[quick][bake]") {
  Fixture f;
  f.textures->materials[0].image = f.add({128, 128, 128, 255});
  f.scene.color = {kWhite, kWhite, kWhite};
  f.surface().emission.image = f.add({255, 128, 0, 255});
  f.surface().emission_factor = {1, 0.5F, 1};
  const TextureImage::Texel sum = f.bake_color().texels[0];
  CHECK(int(sum[0]) == 255);
  CHECK(int(sum[1]) == int(byte_of_linear(linear_of_byte(128) * 1.5F)));
  CHECK(int(sum[2]) == 128);
  f.textures->materials[0].image = TextureMaterial::kNoImage;
  f.scene.color = {LinearColor{0, 0, 0}, LinearColor{0, 0, 0}, LinearColor{0, 0, 0}};
  CHECK(int(f.bake_color().texels[0][1]) == int(byte_of_linear(linear_of_byte(128) / 2)));
  f.textures->images[1] = {};  // broken: no light
  CHECK(f.bake_color().texels[0] == TextureImage::Texel{0, 0, 0, 255});
  CHECK(f.bake().emission.texels[0] == TextureImage::Texel{0, 0, 0, 255});
}

TEST_CASE("a scene without materials is rough, no metal, and dark", "[quick][bake]") {
  Fixture f;
  for (TriangleTexture& t : f.scene.textures) t = {};
  const BakedSurface baked = f.bake();
  CHECK(baked.roughness.texels[0] == TextureImage::Texel{255, 255, 0, 255});
  CHECK(baked.emission.texels[0] == TextureImage::Texel{0, 0, 0, 255});
}

TEST_CASE("an image of directions says nothing if hardly a texel leans", "[quick][bake]") {
  TextureImage image(20, 10, {128, 128, 255, 255});
  CHECK(says_nothing(image));
  image.at(3, 7) = {255, 128, 128, 255};
  image.at(4, 7) = {128, 0, 128, 255};
  CHECK(says_nothing(image));  // one in a hundred
  image.at(5, 7) = {std::uint8_t(GENERATE(115, 140)), 128, 254, 255};
  CHECK_FALSE(says_nothing(image));
  image.at(5, 7) = {133, 125, 255, 255};  // less than 4 degrees
  CHECK(says_nothing(image));
}

TEST_CASE("a small detail of a large image of directions says something, a line of texels does not", "[quick][bake]") {
  TextureImage image(400, 300, {128, 128, 255, 255});
  for (int x = 0; x < 300; ++x) image.at(x, 17 + x / 2) = {255, 128, 128, 255};
  CHECK(says_nothing(image));
  const int top = GENERATE(200, 204), left = GENERATE(300, 304);
  for (int y = top; y < top + 8; ++y)
    for (int x = left; x < left + 8; ++x) image.at(x, y) = {150, 128, 254, 255};  // with the line, less than 1 %
  CHECK_FALSE(says_nothing(image));
}

TEST_CASE("any of a material's images tells how small texels are worth it", "[quick][bake]") {
  Fixture f;
  const auto finest = [&] {
    TexturedSource source(f.scene);
    Bounds3d bounds;
    for (const TriangleD& t : f.scene.triangles) bounds.merge(bounds_of(t));
    return SceneLooks({source, bounds, f.scene.triangles.size(), f.textures}, std::make_unique<MemoryScratch>(), {})
        .finest_texel();
  };
  CHECK(finest() == 0);
  const int which = GENERATE(0, 1, 2);
  TextureSurface& surface = f.surface();
  TextureMap& map = which == 0 ? surface.normal : which == 1 ? surface.roughness : surface.emission;
  f.textures->images.emplace_back(48, 48, TextureImage::Texel{});
  map.image = std::uint32_t(f.textures->images.size() - 1);
  // A side of half a unit has a sixth of the image: 8 x 48 texels.
  const double texel = 0.5 / std::sqrt(8.0 * 48);
  CHECK(finest() <= texel);
  CHECK(finest() > 0.8 * texel);
  f.textures->materials[0].image = f.add({9, 9, 9, 255});  // 4 x 4 texels
  CHECK(finest() > 0.8 * texel);
  CHECK(finest() <= texel);
}

TEST_CASE("packed normals are within a hundredth of a degree", "[quick][bake]") {
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) {
      for (int z = -3; z <= 3; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3d n = unit({double(x), double(y), double(z)}), back = unpack_normal(pack_normal(n));
        CHECK(length(n - back) < 1.7e-4);
      }
    }
  }
  CHECK(pack_normal({}) == 0);
  CHECK(pack_normal({NAN, 0, 0}) == 0);
}
