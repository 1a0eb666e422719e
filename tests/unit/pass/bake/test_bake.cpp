#include <cmath>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/image/mip_image.h"
#include "lib/pass/bake/bake.h"
#include "lib/store/memory_scratch.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/random_lattice.h"
#include "tests/support/textured_scene.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Six colour ramps side by side, each its own way: no two places look the same, and a texel is like its neighbours.
TextureImage six_ramps(int edge) {
  TextureImage image(6 * edge, edge);
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < 6 * edge; ++x) {
      const int side = x / edge, u = 255 * (x % edge) / edge, v = 255 * y / edge;
      image.at(x, y) = {std::uint8_t(side % 2 == 0 ? u : 255 - u), std::uint8_t(side % 3 == 0 ? v : 255 - v),
                        std::uint8_t(40 * side), 255};
    }
  }
  return image;
}

std::shared_ptr<MemoryTextures> textures_of(TextureImage image, TextureMaterial material = {}) {
  auto textures = std::make_shared<MemoryTextures>();
  textures->images.push_back(std::move(image));
  material.image = 0;
  textures->materials.push_back(material);
  return textures;
}

/// A cube of 1 unit around the one of 0.5 units at (0.25, 0.25, 0.25), or another box.
LatticeMesh box_mesh(LatticeBox box) {
  LatticeMesh mesh;
  mesh.frame.voxel = 1.0 / 64;  // 4096 lattice units
  add_box(mesh, box);
  return mesh;
}

ResultKey key_near_origin(const SceneLooks& looks) {
  KeyHash hash("test");
  looks.add_to(hash, Bounds3d{{-1, -1, -1}, {1, 1, 1}});
  return hash.key();
}

struct Baked {
  Atlas atlas;
  TextureImage image;
};

Baked bake_box(const LatticeMesh& mesh, const TexturedScene& scene, const std::shared_ptr<MemoryTextures>& textures,
               const BakeParams& params, double texel = 64) {
  Baked b;
  b.atlas = unwrap(mesh, {texel, 4096});
  b.image = bake(mesh, b.atlas, *looks_of(scene, textures), params);
  return b;
}

/// Calls see(texel, place on the mesh, normal) for each texel that lies whole in a face, by plain means.
template <class See>
void for_each_texel(const LatticeMesh& mesh, const Atlas& atlas, const TextureImage& image, const See& see) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = atlas.corners[f];
    const auto side = [&](std::size_t k, double x, double y) {
      const auto &a = t[k], &b = t[(k + 1) % 3];
      return (double(b[0]) - a[0]) * (y - a[1]) - (double(b[1]) - a[1]) * (x - a[0]);
    };
    const double area = side(0, t[2][0], t[2][1]);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        bool whole = area != 0;
        for (int c = 0; c < 4; ++c)
          for (std::size_t k = 0; k < 3; ++k) whole = whole && side(k, x + c % 2, y + c / 2) / area >= 0;
        if (!whole) continue;
        TriangleD corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.frame.world(mesh.vertices[mesh.triangles[f][k]]);
        Vec3d p{};
        for (std::size_t k = 0; k < 3; ++k) p = p + side((k + 1) % 3, x + 0.5, y + 0.5) / area * corners[k];
        const Vec3d n = cross(corners[1] - corners[0], corners[2] - corners[0]);
        see(image.at(x, y), p, (1 / length(n)) * n);
      }
    }
  }
}

/// The colour of the scene at the first place along the ray, by looking at every triangle; nearest texel.
TextureImage::Texel first_seen(const TexturedScene& scene, const TextureImage& image, const Vec3d& p, const Vec3d& d) {
  double first = 2;
  TextureImage::Texel seen{};
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const double along = along_segment(p, d, scene.triangles[i]);
    if (!(along < first)) continue;
    first = along;
    const std::array<double, 3> part = barycentric(scene.triangles[i], p + along * d);
    double u = 0, v = 0;
    for (std::size_t k = 0; k < 3; ++k)
      u += part[k] * scene.textures[i].uv[k][0], v += part[k] * scene.textures[i].uv[k][1];
    seen = image.at(std::clamp(int(u * image.width), 0, image.width - 1),
                    std::clamp(int(v * image.height), 0, image.height - 1));
  }
  return seen;
}

}  // namespace

TEST_CASE("a textured cube's own cube has its texture", "[quick][bake]") {
  TexturedScene scene;
  scene.add_cube({0.25, 0.25, 0.25}, 0.5, 0);
  const TextureImage image = six_ramps(64);
  const auto textures = textures_of(image);
  BakeParams params;
  params.reach_world = 0.3;
  // The cube itself; one around it, whose rays meet it where they are over it; and one inside it, as fits may be.
  for (const auto& [low, high, both] : {std::tuple{1024, 3072, false}, {1000, 3096, false}, {1050, 3040, true}}) {
    params.both_ways = both;
    const LatticeMesh mesh = box_mesh({{low, low, low}, {high, high, high}});
    const Baked baked = bake_box(mesh, scene, textures, params);
    int texels = 0;
    for_each_texel(mesh, baked.atlas, baked.image, [&](const TextureImage::Texel& t, const Vec3d& p, const Vec3d& n) {
      const bool over = std::count_if(p.begin(), p.end(), [](double x) { return x > 0.26 && x < 0.74; }) >= 2;
      if (!over) return;
      ++texels;
      const Vec3d from = p + 0.1 * n;
      const TextureImage::Texel seen = first_seen(scene, image, from, -0.5 * n);
      for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(int(t[i]) - int(seen[i])) <= 12);  // 3 texels of the image
    });
    CHECK(texels > 3000);
  }
}

TEST_CASE("the same texture for any number of threads", "[quick][bake]") {
  TexturedScene scene;
  RandomLattice random(5);
  for (int i = 0; i < 30; ++i) {
    const LatticeCoord c = random.point(0, 3000);
    scene.add_cube({double(c.x) / 4096, double(c.y) / 4096, double(c.z) / 4096}, 0.2, 0);
  }
  const auto textures = textures_of(six_ramps(32));
  BakeParams params;
  params.reach_world = 0.5;
  params.both_ways = true;
  const LatticeMesh mesh = box_mesh({{0, 0, 0}, {4096, 4096, 4096}});
  std::vector<TextureImage> images;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    images.push_back(bake_box(mesh, scene, textures, params, 40).image);
  }
  CHECK(images[0].texels == images[1].texels);
}

TEST_CASE("the first thing inwards is seen, and what lies behind it is not", "[quick][bake]") {
  TexturedScene scene;
  scene.add_cube({0.25, 0.25, 0.25}, 0.5, 0);
  const TextureMaterial plain;
  auto textures = textures_of(TextureImage(2, 2, {200, 10, 10, 255}), plain);
  textures->images.emplace_back(2, 2, TextureImage::Texel{10, 10, 200, 255});
  textures->materials.push_back(plain);
  textures->materials.back().image = 1;
  scene.add_cube({0.3, 0.3, 0.3}, 0.4, 1);
  BakeParams params;
  params.reach_world = 1;
  const LatticeMesh mesh = box_mesh({{1000, 1000, 1000}, {3096, 3096, 3096}});
  const Baked baked = bake_box(mesh, scene, textures, params);
  for (const TextureImage::Texel& t : baked.image.texels) CHECK(t == TextureImage::Texel{200, 10, 10, 255});
}

TEST_CASE("holes in images are looked through, and are holes where nothing is behind", "[quick][bake]") {
  TextureImage fence(64, 64, {90, 60, 30, 255});
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      if (x % 32 >= 8 && y % 32 >= 8) fence.at(x, y) = {0, 0, 0, 0};
  TextureMaterial masked;
  masked.alpha_mode = AlphaMode::mask;
  TexturedScene scene;
  scene.add({0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}, 0);
  BakeParams params;
  params.reach_world = 0.3;
  const LatticeMesh mesh = box_mesh({{0, 0, 2000}, {4096, 4096, 2096}});
  const Baked alone = bake_box(mesh, scene, textures_of(fence, masked), params, 16);
  int holes = 0, bars = 0;
  for_each_texel(mesh, alone.atlas, alone.image, [&](const TextureImage::Texel& t, const Vec3d& p, const Vec3d& n) {
    if (std::abs(n[2]) < 0.5) return;
    const double x = std::fmod(p[0] * 64, 32), y = std::fmod(p[1] * 64, 32);
    if (x > 10 && x < 30 && y > 10 && y < 30) {
      ++holes;
      CHECK(int(t[3]) == 0);
    } else if ((x > 2 && x < 6) || (y > 2 && y < 6)) {
      ++bars;
      CHECK(t == TextureImage::Texel{90, 60, 30, 255});
    }
  });
  CHECK(holes > 1000);
  CHECK(bars > 1000);

  auto textures = textures_of(fence, masked);
  textures->images.emplace_back(1, 1, TextureImage::Texel{0, 90, 0, 255});
  textures->materials.emplace_back();
  textures->materials.back().image = 1;
  scene.add({0, 0, 0.4}, {1, 0, 0}, {0, 1, 0}, 1);
  const Baked before_lawn = bake_box(mesh, scene, textures, params, 16);
  for_each_texel(mesh, before_lawn.atlas, before_lawn.image,
                 [&](const TextureImage::Texel& t, const Vec3d& p, const Vec3d& n) {
                   const double x = std::fmod(p[0] * 64, 32), y = std::fmod(p[1] * 64, 32);
                   if (n[2] > 0.5 && x > 10 && x < 30 && y > 10 && y < 30)
                     CHECK(t == TextureImage::Texel{0, 90, 0, 255});
                 });
}

TEST_CASE("the sides of what stands for a card are holes where the card's edge is one", "[quick][bake]") {
  TextureImage leaf(64, 64, {255, 255, 255, 0});
  for (int y = 0; y < 64; ++y)
    for (int x = 12; x < 64; ++x)  // it ends at x = 1, and 12 texels before the other edges
      if (y >= 12 && y < 52) leaf.at(x, y) = {30, 120, 40, 255};
  TextureMaterial masked;
  masked.alpha_mode = AlphaMode::mask;
  masked.wrap = {TextureWrap::clamp, TextureWrap::clamp};
  TexturedScene scene;
  scene.add({0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}, 0);
  const LatticeMesh mesh = box_mesh({{-40, -40, 1960}, {4136, 4136, 2136}});
  const BakeParams params{0.3, false, {}};
  const Baked alone = bake_box(mesh, scene, textures_of(leaf, masked), params, 16);
  int holes = 0, edges = 0;
  for_each_texel(mesh, alone.atlas, alone.image, [&](const TextureImage::Texel& t, const Vec3d& p, const Vec3d& n) {
    if (std::abs(n[2]) > 0.5) return;
    const bool at_leaf = n[0] > 0.5 && p[1] > 0.22 && p[1] < 0.78;
    if (n[0] > 0.5 && !at_leaf && p[1] > 0.16 && p[1] < 0.84) return;  // between
    ++(at_leaf ? edges : holes);
    CHECK(int(t[3]) == (at_leaf ? 255 : 0));
  });
  CHECK(holes > 1000);
  CHECK(edges > 500);

  scene.add({0, 0, 0.499}, {1, 0, 0}, {0, 1, 0}, TriangleTexture::kNoMaterial);  // a wall that it lies on
  const Baked on_wall = bake_box(mesh, scene, textures_of(leaf, masked), params, 16);
  for (const TextureImage::Texel& t : on_wall.image.texels) CHECK(int(t[3]) == 255);
}

TEST_CASE("an image that is not there leaves the colour of its triangles, and is named", "[quick][bake]") {
  TexturedScene scene;
  scene.add_cube({0.25, 0.25, 0.25}, 0.5, 0);
  scene.color = {LinearColor{65535, 0, 0}, {65535, 0, 0}, {65535, 0, 0}};
  const auto looks = looks_of(scene, textures_of(TextureImage()));
  const LatticeMesh mesh = box_mesh({{1024, 1024, 1024}, {3072, 3072, 3072}});
  const Atlas atlas = unwrap(mesh, {128, 4096});
  const TextureImage image = bake(mesh, atlas, *looks, BakeParams{0.1, false, {}});
  for (const TextureImage::Texel& t : image.texels) CHECK(t == TextureImage::Texel{255, 0, 0, 255});
  CHECK(looks->faults().size() == 1);
}

TEST_CASE("colours multiply images, or give way to them", "[quick][bake]") {
  TexturedScene scene;
  scene.add_cube({0.25, 0.25, 0.25}, 0.5, 0);
  scene.color = {LinearColor{0, 65535, 65535}, {0, 65535, 65535}, {0, 65535, 65535}};
  const LatticeMesh mesh = box_mesh({{1024, 1024, 1024}, {3072, 3072, 3072}});
  TextureMaterial material;
  const TextureImage grey(4, 4, {100, 100, 100, 255});
  CHECK(bake_box(mesh, scene, textures_of(grey, material), BakeParams{0.1, false, {}}).image.texels[0] ==
        TextureImage::Texel{0, 100, 100, 255});
  material.replaces_color = true;
  CHECK(bake_box(mesh, scene, textures_of(grey, material), BakeParams{0.1, false, {}}).image.texels[0] ==
        TextureImage::Texel{100, 100, 100, 255});
}

TEST_CASE("places in images that are no numbers are baked, too", "[quick][bake]") {
  TexturedScene scene;
  scene.add_cube({0.25, 0.25, 0.25}, 0.5, 0);
  const float bad[] = {NAN, INFINITY, -INFINITY, 3e38F, -3e38F, 0};
  for (std::size_t i = 0; i < scene.textures.size(); ++i)
    for (auto& uv : scene.textures[i].uv) uv = {bad[i % 6], bad[(i + 3) % 6]};
  const LatticeMesh mesh = box_mesh({{1024, 1024, 1024}, {3072, 3072, 3072}});
  const Baked baked = bake_box(mesh, scene, textures_of(six_ramps(16)), BakeParams{0.1, false, {}});
  for (const TextureImage::Texel& t : baked.image.texels) CHECK(int(t[3]) == 255);
}

TEST_CASE("where the scene is out of reach, colours are those beside", "[quick][bake]") {
  TexturedScene scene;
  scene.add({0, 0, 0.5}, {0.5, 0, 0}, {0, 1, 0}, 0);  // half of the plate
  const LatticeMesh mesh = box_mesh({{0, 0, 2000}, {4096, 4096, 2096}});
  const Baked baked =
      bake_box(mesh, scene, textures_of(TextureImage(2, 2, {9, 99, 199, 255})), BakeParams{0.05, false, {}});
  for (const TextureImage::Texel& t : baked.image.texels) CHECK(t == TextureImage::Texel{9, 99, 199, 255});
}

TEST_CASE("the same texture for any memory, and for any order of the scene's triangles", "[quick][bake]") {
  TexturedScene scene;
  RandomLattice random(7);
  for (int i = 0; i < 600; ++i) {  // some large, and some at one place with another image
    const LatticeCoord c = random.point(0, 3000);
    scene.add_cube({double(c.x) / 4096, double(c.y) / 4096, double(c.z) / 4096}, i % 50 == 0 ? 0.3 : 0.03, 0);
    if (i % 10 == 0) scene.add_cube({double(c.x) / 4096, double(c.y) / 4096, double(c.z) / 4096}, 0.03, 1);
  }
  REQUIRE(scene.triangles.size() > 3 * 2048);
  auto textures = textures_of(six_ramps(32));
  textures->images.push_back(six_ramps(16));
  textures->materials.push_back(textures->materials[0]);
  textures->materials[1].image = 1;
  TexturedScene turned = scene;
  std::reverse(turned.triangles.begin(), turned.triangles.end());
  std::reverse(turned.textures.begin(), turned.textures.end());
  const LatticeMesh mesh = box_mesh({{0, 0, 0}, {4096, 4096, 4096}});
  const Atlas atlas = unwrap(mesh, {40, 4096});
  const BakeParams params{0.5, true, {}};
  const auto baked = [&](const TexturedScene& s, std::uint64_t memory_bytes) {
    return bake(mesh, atlas, *looks_of(s, textures, {memory_bytes}), params).texels;
  };
  const auto plenty = baked(scene, std::uint64_t(1) << 30);
  CHECK(baked(scene, 100000) == plenty);  // blocks come and go, and images
  CHECK(baked(turned, std::uint64_t(1) << 30) == plenty);
}

TEST_CASE("an image that does not fit in the memory is refused with the figure", "[quick][bake]") {
  TexturedScene scene;
  scene.add_cube({0.25, 0.25, 0.25}, 0.5, 0);
  BakeParams params{0.1, false, {100000, 1, {std::uint64_t(1) << 30, 0}}};
  const LatticeMesh mesh = box_mesh({{1024, 1024, 1024}, {3072, 3072, 3072}});
  REQUIRE_NOTHROW(bake_box(mesh, scene, textures_of(six_ramps(4)), params, 128));
  REQUIRE_THROWS_AS(bake_box(mesh, scene, textures_of(six_ramps(4)), params, 16), NeedsMemory);
}

TEST_CASE("the key of a place knows its triangles and its images, not those elsewhere", "[quick][bake]") {
  TexturedScene scene;
  scene.add_cube({0, 0, 0}, 0.5, 0);
  scene.add_cube({10, 0, 0}, 0.5, 1);
  auto textures = textures_of(TextureImage(2, 2, {1, 2, 3, 255}));
  textures->images.emplace_back(2, 2, TextureImage::Texel{1, 2, 3, 255});
  textures->materials.push_back({1});
  const auto key = [&] { return key_near_origin(*looks_of(scene, textures)); };
  const ResultKey before = key();
  textures->images[1].at(0, 0) = {9, 9, 9, 255};
  CHECK(key() == before);
  textures->images[0].at(0, 0) = {9, 9, 9, 255};
  CHECK(key() != before);
  textures->images[0].at(0, 0) = {1, 2, 3, 255};
  CHECK(key() == before);
  scene.textures[0].uv[0][0] += 0.5F;
  CHECK(key() != before);
}

TEST_CASE("the key of a place knows how fine the scene's images are, wherever they lie", "[quick][bake]") {
  TexturedScene scene;
  scene.add_cube({0, 0, 0}, 0.5, 0);
  scene.add_cube({10, 0, 0}, 0.5, 1);
  auto textures = textures_of(TextureImage(6, 1, {1, 2, 3, 255}));
  textures->images.emplace_back(6, 1, TextureImage::Texel{1, 2, 3, 255});
  textures->materials.push_back({1});
  const auto key = [&] { return key_near_origin(*looks_of(scene, textures)); };
  const ResultKey before = key();
  textures->images[1] = TextureImage(600, 100, {1, 2, 3, 255});  // levels here get finer texels, too
  CHECK(key() != before);
}

TEST_CASE("of surfaces at one place the same is seen, whatever their numbers and order", "[quick][bake]") {
  const LatticeMesh mesh = box_mesh({{1000, 1000, 1000}, {3096, 3096, 3096}});
  const Atlas atlas = unwrap(mesh, {64, 4096});
  const auto seen = [&](bool swap_materials, bool swap_order) {
    TexturedScene scene;
    for (const int i : {0, 1}) scene.add_cube({0.25, 0.25, 0.25}, 0.5, std::uint32_t(swap_order ? 1 - i : i));
    auto textures = textures_of(TextureImage(2, 2, {200, 10, 10, 255}));
    textures->images.emplace_back(2, 2, TextureImage::Texel{10, 10, 200, 255});
    textures->materials.push_back({1});
    if (swap_materials) {
      std::swap(textures->images[0], textures->images[1]);
      for (TriangleTexture& t : scene.textures) t.material = 1 - t.material;
    }
    return bake(mesh, atlas, *looks_of(scene, textures), BakeParams{0.3, false, {}}).texels;
  };
  const auto plain = seen(false, false);
  CHECK((seen(false, true) == plain));  // as one value: pictures are long
  CHECK((seen(true, false) == plain));
  CHECK((seen(true, true) == plain));
}
