#include "tools/lod/tiles/visual_tileset.h"

#include <fmt/format.h>

#include <cmath>

#include "io/files/file.h"
#include "lib/pass/leaf/scene_tiles.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/explain.h"
#include "tools/lod/kept_results.h"
#include "tools/lod/tiles/visual_tiles.h"

namespace bp {

void build_visual_tileset(const BuildOptions& o) {
  TilesetFolder folder(o.out, {o.name + "_tiles"}, o.common.overwrite);
  Build build(o);
  build.note(cache_note(o));
  std::string fault;  // the reason why the cache keeps nothing, known after the tiles are made
  const std::unique_ptr<ResultStore> results = open_kept_results(o, fault);
  const LodScene scene = measure_scene(build);
  build.report.begin("looks");
  const std::unique_ptr<SceneLooks> looks = read_looks(build, scene, part_of(build.budget.work, kLooksBeside));
  const std::vector<LevelRow> rows = write_visual_tiles(build, scene, *looks, results.get(), fault, folder);
  folder.commit();
  if (!folder.complaint().empty())
    build.note(folder.complaint() + "; tiles of the tileset that was there before are not known, and stay");
  finish(build, scene.told(), rows, folder.bytes());
}

void explain_visual_tileset(const BuildOptions& o) {
  Build build(o);
  const LodScene scene = measure_scene(build);
  const std::uint64_t triangles = scene.size.triangles, most = most_tile_triangles(o);
  // Leaf tiles are half full in the mean. A tile has about as many triangles as each of the four below it, if the scene
  // is a surface, so all others are a third as many.
  const auto tiles = triangles <= most ? 1 : std::uint64_t(std::ceil(double(triangles) / double(most) * 2 * 4 / 3));
  const double lattice = tile_cube(scene.size.bounds).unit;
  Json& counts = build.report.counts;
  counts = {{"triangles", triangles}, {"min", scene.size.bounds.min},   {"max", scene.size.bounds.max},
            {"lattice", lattice},     {"tile_triangles_at_most", most}, {"tiles_about", tiles}};
  build.report.bytes_in = size_of_files(o.voxels.scenes);
  build.report.write(o.common);
  print(scene_text(triangles, scene.size.bounds) +
        fmt::format("tiles\tabout {}, of at most {} triangles; leaf tiles are the scene itself\n"
                    "lattice\t{:.3g}: vertices are rounded to this\n",
                    tiles, most, lattice));
}

}  // namespace bp
