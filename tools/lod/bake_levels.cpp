#include "tools/lod/bake_levels.h"

#include <algorithm>
#include <cmath>

#include "io/image/texture_writer.h"
#include "io/store/scratch.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/pass/bake/bake.h"

namespace bp {

namespace {

/// Least texels for a face, which take about as many bytes as the face.
constexpr double kTexelsPerFace = 64;
/// Reach of the search for the scene along the normal, in errors or scales of the level.
constexpr double kReach = 4;

double area_of(const LatticeMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.frame.world(mesh.vertices[t[0]]);
    area += length(cross(mesh.frame.world(mesh.vertices[t[1]]) - a, mesh.frame.world(mesh.vertices[t[2]]) - a)) / 2;
  }
  return area;
}

/// Returns the edge of a texel of a level: as fine as its error or its faces deserve, but not finer than the scene's
/// images.
double texel_of(const LatticeMesh& mesh, double error, const SceneLooks& looks) {
  const double by_faces = std::sqrt(area_of(mesh) / (kTexelsPerFace * double(mesh.triangles.size())));
  return std::max(std::min(error / kTexelsPerError, by_faces), looks.finest_texel());
}

Atlas atlas_of(const LatticeMesh& mesh, const LevelLengths& level, const SceneLooks& looks) {
  const double voxel = mesh.frame.voxel;
  AtlasParams params;
  const double error = std::max({error_or(level.error, level.scale, voxel), level.asked_error, voxel});
  params.texel = texel_of(mesh, error, looks) / voxel * kLatticePerVoxel;
  return unwrap(mesh, params);
}

MeshTexture with_places(const Atlas& atlas) {
  MeshTexture texture;
  texture.chart = atlas.chart;
  texture.uv = atlas.corners;
  for (MeshTexture::Corners& corners : texture.uv) {
    for (std::array<float, 2>& p : corners) p = {p[0] / float(atlas.width), p[1] / float(atlas.height)};
  }
  return texture;
}

/// Returns whether all texels have about the same colour.
bool is_plain(const TextureImage& image) {
  constexpr int kSame = 2;
  const TextureImage::Texel first = image.texels.front();
  return std::all_of(image.texels.begin(), image.texels.end(), [&](const TextureImage::Texel& t) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (std::abs(int(t[i]) - int(first[i])) > kSame) return false;
    }
    return true;
  });
}

/// Encodes an image. A plain one becomes four texels, since places in it are shares of its size.
ImageFile file_of(const TextureImage& image) {
  EncodedImage file = encode_texture(is_plain(image) ? TextureImage(2, 2, image.texels.front()) : image);
  return {std::move(file.bytes), std::move(file.type)};
}

void add_color(const TextureImage& image, MeshTexture& texture) {
  texture.has_holes =
      std::any_of(image.texels.begin(), image.texels.end(), [](const TextureImage::Texel& t) { return t[3] < 255; });
  ImageFile file = file_of(image);
  texture.image = std::move(file.bytes);
  texture.type = std::move(file.type);
}

/// Adds an image only for properties that differ from place to place; plain ones become factors.
void add_surface(const BakedSurface& baked, MeshTexture& texture) {
  if (!says_nothing(baked.normal)) texture.normal = file_of(baked.normal);
  const TextureImage::Texel light = baked.emission.texels.front();
  const bool dark = is_plain(baked.emission) && std::max({light[0], light[1], light[2]}) < 4;
  if (!dark) texture.emission = file_of(baked.emission);
  if (is_plain(baked.roughness)) {
    const TextureImage::Texel rough = baked.roughness.texels.front();
    texture.roughness_factor = rough[1] / 255.0;
    texture.metal_factor = rough[2] / 255.0;
  } else {
    texture.roughness = file_of(baked.roughness);
  }
}

}  // namespace

double error_or(double error_world, double scale_world, double voxel) {
  return error_world > 0 ? error_world : scale_world + 2 * voxel;
}

/// The scene's outside is hardly larger than its bounds, so these stand for its area.
double planned_texels(double faces, const Bounds3d& bounds, double error_world) {
  const double texels = kTexelsPerError / error_world;
  return std::max(kTexelsPerFace * faces, error_world > 0 ? area_of(bounds) * texels * texels : 0);
}

double texture_reach(double error_world, double scale_world, double voxel) {
  return kReach * std::max(error_or(error_world, scale_world, voxel), scale_world);
}

Bounds3d texture_bounds(const VoxelBox& box, const GridFrame& frame, double scale_world) {
  const double by = texture_reach(0, scale_world, frame.voxel) + scale_world + 2 * frame.voxel;
  Bounds3d bounds = bounds_of(box, frame);
  for (double& x : bounds.min) x -= by;
  for (double& x : bounds.max) x += by;
  return bounds;
}

std::unique_ptr<SceneLooks> read_looks(const Build& build, const LodScene& scene, const MemoryShare& memory) {
  SceneOptions how = build.scene_options(true);
  how.colors = build.options.colors();
  how.textures = scene.textures;
  how.keep_degenerate = false;  // triangles without area show nothing
  const auto source = build.open_scene(how);
  const SceneSize& size = scene.size;
  const SceneLooks::Scene read{*source, size.bounds, size.triangles - size.without_area, scene.textures};
  return std::make_unique<SceneLooks>(read, make_scratch(build.budget.tiles, build.options.common.temp), memory);
}

std::uint64_t looks_limit(const Build& build, const LodScene& scene, double share) {
  if (!scene.textured) return 0;
  return part_of(build.budget.work, share).limit_for(SceneLooks::bytes_needed(*scene.textures, scene.size.triangles));
}

std::shared_ptr<const MeshTexture> level_texture(const Build& build, const LodScene& scene, const LatticeMesh& mesh,
                                                 const LevelLengths& level, const SceneLooks& looks,
                                                 const MemoryShare& memory) {
  const double voxel = mesh.frame.voxel;
  const Atlas atlas = atlas_of(mesh, level, looks);
  BakeParams params;
  params.reach_world = texture_reach(level.error, level.scale, voxel);
  params.memory = memory;
  params.both_ways = build.options.proxy.mode == MeshMode::fit;
  MeshTexture texture = with_places(atlas);
  if (build.options.full()) {
    const BakedSurface baked = bake_surface(mesh, atlas, looks, params);
    if (scene.has_colors()) add_color(baked.color, texture);
    add_surface(baked, texture);
  } else {
    add_color(bake(mesh, atlas, looks, params), texture);
  }
  return std::make_shared<const MeshTexture>(std::move(texture));
}

void bake_levels(Build& build, const LodScene& scene, CompleteLevels& made) {
  if (!scene.textured) return;
  build.report.begin("textures");
  const std::unique_ptr<SceneLooks> looks = read_looks(build, scene, part_of(build.budget.work, kLooksAfter));
  const MemoryShare memory = part_of(build.budget.work, 1 - kLooksAfter);
  const auto for_each_level = [&](const auto& body) {
    for (std::size_t i = 0; i < made.levels.size(); ++i) {
      if (made.scene_of(i) != nullptr) continue;  // it shows the scene's own images
      LodLevel& level = made.levels[i];
      body(level.mesh, LevelLengths{level.error_world, made.facts[i].target.error_world, level.scale_world});
    }
  };
  const auto limit = [&] {
    std::uint64_t most = looks_limit(build, scene, kLooksAfter);
    for_each_level([&](const LatticeMesh& mesh, const LevelLengths& lengths) {
      const std::uint64_t bytes = bytes_to_bake(mesh, atlas_of(mesh, lengths, *looks), build.options.full());
      most = std::max(most, memory.limit_for(bytes));
    });
    return most;
  };
  naming_limit(
      [&] {
        for_each_level([&](LatticeMesh& mesh, const LevelLengths& lengths) {
          mesh.texture = level_texture(build, scene, mesh, lengths, *looks, memory);
        });
      },
      limit);
  for (const std::string& fault : looks->faults()) build.note(fault + "; its material's colour is used");
}

}  // namespace bp
