#include "tools/lod/bake_levels.h"

#include <algorithm>
#include <cmath>

#include "io/image/texture_writer.h"
#include "lib/core/error.h"
#include "lib/pass/bake/bake.h"

namespace bp {

namespace {

/// A level is drawn where its error is less than a pixel; from there texels of half of it are as fine as can be seen.
constexpr double kTexelsPerError = 4;
/// So many errors, or scales, the scene is looked for along the normal.
constexpr double kReach = 4;

MeshTexture with_file(const Atlas& atlas, const TextureImage& image) {
  MeshTexture texture;
  texture.chart = atlas.chart;
  texture.uv = atlas.corners;
  for (MeshTexture::Corners& corners : texture.uv) {
    for (std::array<float, 2>& p : corners) p = {p[0] / float(atlas.width), p[1] / float(atlas.height)};
  }
  texture.has_holes =
      std::any_of(image.texels.begin(), image.texels.end(), [](const TextureImage::Texel& t) { return t[3] < 255; });
  EncodedImage file = encode_texture(image);
  texture.image = std::move(file.bytes);
  texture.type = std::move(file.type);
  return texture;
}

}  // namespace

std::unique_ptr<SceneLooks> read_looks(const Build& build, const MemoryShare& memory) {
  SceneOptions scene = build.scene_options(true);
  scene.colors = true;
  scene.textures = build.textures();
  const auto source = open_scenes(build.options.voxels.scenes, scene);
  try {
    return std::make_unique<SceneLooks>(*source, build.triangles(), build.textures(), memory);
  } catch (const NeedsMemory& e) {
    throw Error(e.code(), e.what(), {Remedy::more_memory, Remedy::no_textures}, e.memory_bytes());
  }
}

std::shared_ptr<const MeshTexture> level_texture(const Build& build, const LatticeMesh& mesh, double error_world,
                                                 double scale_world, const SceneLooks& looks) {
  const double voxel = mesh.frame.voxel;
  const double error = error_world > 0 ? error_world : std::max(scale_world, voxel);
  AtlasParams atlas_params;
  atlas_params.texel = error / kTexelsPerError / voxel * kLatticePerVoxel;
  const Atlas atlas = unwrap(mesh, atlas_params);
  BakeParams params;
  params.reach_world = kReach * std::max({error, scale_world, voxel});
  params.both_ways = build.options.proxy.mode == MeshMode::fit;
  return std::make_shared<const MeshTexture>(with_file(atlas, bake(mesh, atlas, looks, params)));
}

void bake_levels(Build& build, std::vector<LodLevel>& levels) {
  if (!build.textured()) return;
  build.report.stage("textures");
  const std::unique_ptr<SceneLooks> looks = read_looks(build, build.budget.work);
  for (LodLevel& level : levels)
    level.mesh.texture = level_texture(build, level.mesh, level.error_world, level.scale_world, *looks);
  for (const std::string& fault : looks->faults()) build.note(fault + "; its material's colour is used");
}

}  // namespace bp
