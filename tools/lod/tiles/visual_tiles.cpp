#include "tools/lod/tiles/visual_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "io/files/file.h"
#include "io/mesh/leaf_writer.h"
#include "io/store/scratch.h"
#include "io/tiles/tileset_file.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/pass/bake/textured_triangle.h"
#include "lib/pass/leaf/scene_tiles.h"
#include "lib/store/packing.h"
#include "lib/store/result_key.h"
#include "lib/tileset/tile_tree.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/tiles/image_files.h"
#include "tools/lod/tiles/texel_size.h"
#include "tools/run/provenance.h"

namespace bp {

namespace {

/// The parts of the memory for work that tiles have, and one image while it is made smaller. Looks have kLooksBeside.
constexpr double kTileShare = 0.45, kImageShare = 0.15;
/// The lattice is coarse where a mean edge has fewer units.
constexpr double kUnitsPerEdge = 64;

std::span<const std::byte> bytes_of_text(const std::string& text) {
  return std::as_bytes(std::span(text));
}

/// Makes the tiles: those of the deepest octants first, then those above them. Tiles of one depth are jobs of their
/// own, which run at the same time as far as the memory goes. Tiles wait in `files` until they are written.
class VisualTiles {
 public:
  VisualTiles(Build& build, const LodScene& scene, const SceneLooks& looks, Scratch& files, ResultStore* results)
      : build_(build),
        scene_(scene),
        looks_(looks),
        files_(files),
        results_(results),
        cube_(tile_cube(scene.size.bounds)),
        most_(most_tile_triangles(build.options)),
        memory_(build.context(nullptr, kTileShare).memory),
        images_(looks.images(), files, part_of(build.budget.work, kImageShare)) {
    OptionText text;
    text.add("mode", "visual").add("faces", most_);
    if (build.options.compression == TileCompression::none) text.add("compression", "none");
    provenance_ = {make_provenance("bplod", text)};
    add(leaf_tree(looks, cube_.box, most_), 0);
    if (results == nullptr) return;
    number_materials();
    for (std::size_t i = jobs_.size(); i-- > 0;) add_key(jobs_[i]);
  }
  void make() {
    require_memory();
    check_outputs();
    for (std::size_t depth = depths(); depth-- > 0;) {
      std::vector<std::size_t> jobs;
      for (std::size_t i = 0; i < jobs_.size(); ++i) {
        if (jobs_[i].depth == depth) jobs.push_back(i);
      }
      std::size_t next = 0;
      run_jobs<std::size_t>(
          at_once(jobs),
          [&](std::size_t& i) {
            if (next == jobs.size()) return false;
            i = jobs[next++];
            return true;
          },
          [&](const std::size_t& i) { make(jobs_[i]); });
    }
    if (jobs_.front().triangles == 0)
      fail(ErrorCode::bad_input, "no triangle of the scene has an area on a lattice of {:.3g}", cube_.unit);
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> all;
    for (const std::string& fault : images_.faults()) all.push_back(fault + "; it is left out");
    std::uint64_t over = 0, largest = 0, leaves = 0;
    double area = 0;
    for (const Job& job : jobs_) {
      over += job.triangles > most_;
      largest = std::max(largest, job.triangles);
      if (job.below.empty()) leaves += job.triangles, area += job.area;
    }
    if (over > 0)
      all.push_back(
          fmt::format("{} of {} tiles have more than {} triangles, {} at most: those that many large triangles meet, "
                      "or whose sides "
                      "cut through much of the scene",
                      over, jobs_.size(), most_, largest));
    if (leaves > 0 && std::sqrt(area / double(leaves)) < kUnitsPerEdge * cube_.unit)
      all.push_back(
          fmt::format("vertices are rounded to {:.3g}, since the scene spans {:.4g}: is a part of it far away?",
                      cube_.unit, scene_.size.bounds.longest_side()));
    return all;
  }
  Tileset tileset() const {
    Tileset tileset = tileset_of(tile_of(jobs_.front(), {}), scene_.size.bounds.diagonal(),
                                 scene_.voxels.header.frame.up, build_.placed.placement);
    for (const std::string& name : used_images_) tileset.images.push_back(folder() + "/" + name);
    return tileset;
  }
  void write_to(TilesetFolder& out) const {
    parallel_for(std::int64_t(jobs_.size()), [&](std::int64_t i) {  // each waits for the disk
      const Job& job = jobs_[std::size_t(i)];
      if (job.triangles == 0) return;
      std::vector<std::byte> bytes;
      files_.get(job.content, bytes);
      out.write(name_of(job), file_text(bytes));
    });
    for (const std::string& name : used_images_) out.write(folder() + "/" + name, images_.bytes_of(name));
  }
  std::vector<LevelRow> rows() const {
    std::vector<LevelRow> rows(depths());
    std::vector<std::uint64_t> kept(rows.size());
    for (const Job& job : jobs_) {
      const std::size_t i = rows.size() - 1 - job.depth;
      LevelRow& row = rows[i];
      kept[i] += job.kept;
      if (job.triangles == 0) continue;
      row.tiles += 1;
      row.faces += job.triangles;
      row.bytes += job.bytes;
      row.error_world = std::max(row.error_world, job.error_world);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].file = fmt::format("{}/{}.glb", folder(), std::string(rows.size() - i, '?'));
      rows[i].more = {{"kept", kept[i]}};
    }
    return rows;
  }
  [[nodiscard]] const std::vector<Provenance>& provenance() const { return provenance_; }

 private:
  /// A tile of the octree.
  struct Job {
    LeafBox box;
    std::size_t depth = 0;
    std::vector<std::size_t> below{};  ///< numbers of the jobs of its octants
    ResultKey key{};                   ///< of its result; set if results are kept
    // make() sets the members below. After that, a job with 0 triangles has no tile.
    Scratch::Handle tile = 0;     ///< the SceneTile, until the tile above is made
    Scratch::Handle content = 0;  ///< the file
    std::uint64_t triangles = 0, bytes = 0;
    double error_world = 0, area = 0;  ///< area: of leaves only
    Bounds3d bounds{};                 ///< of the tile and those below it
    bool kept = false;
  };
  using ImageNames = std::map<std::uint32_t, std::string>;
  [[nodiscard]] std::string folder() const { return build_.options.name + "_tiles"; }
  std::size_t add(const LeafTree& tree, std::size_t depth) {
    if (tree.octants.size() == 1) return add(tree.octants.front(), depth);  // a tile above one would be the same
    const std::size_t number = jobs_.size();
    jobs_.push_back({tree.box, depth});
    for (const LeafTree& octant : tree.octants) {
      const std::size_t below = add(octant, depth + 1);
      jobs_[number].below.push_back(below);
    }
    if (tree.octants.empty() && tree.box.triangles > most_) {  // it cannot be divided, but has fewer from afar
      constexpr char kWhole = '8';                             // after the digits of octants
      jobs_.push_back({tree.box, depth + 1});
      jobs_.back().box.path += kWhole;
      jobs_[number].below.push_back(jobs_.size() - 1);
    }
    return number;
  }
  /// Sets the key of a job; those of the tiles below it are set.
  void add_key(Job& job) const {
    KeyHash hash("visual tile");
    hash.add(build_.options.name, job.box.path, cube_.unit, build_.options.appearance, scene_.voxels.header.frame.up,
             provenance_.front().options, job.below.size());
    if (job.below.empty()) {
      add_leaf_to(hash, looks_, job.box.box);
    } else {
      hash.add(job.box.box);
    }
    for (const std::size_t i : job.below) hash.add(jobs_[i].key);
    job.key = hash.key();
  }
  /// Kept tiles name materials by what they look like, since numbers change with the scene.
  void number_materials() {
    looks_.visit(cube_.box, [&](const TexturedTriangle& t) {
      const std::uint32_t material = t.texture.material;
      const auto [found, is_new] = materials_.try_emplace(looks_.key_of(material), material);
      if (!is_new) found->second = std::min(found->second, material);
    });
  }
  std::size_t depths() const {
    std::size_t most = 0;
    for (const Job& job : jobs_) most = std::max(most, job.depth + 1);
    return most;
  }
  /// Returns the name of a tile's file: a digit for each octant from the root down to it.
  std::string name_of(const Job& job) const { return fmt::format("{}/0{}.glb", folder(), job.box.path); }
  /// Estimates the triangles of a tile. A tile without tiles below has those that meet its box. Another one has the sum
  /// of those below, at most `most_`; it may exceed that if much of it lies on the faces of its box.
  std::uint64_t planned(const Job& job) const {
    if (job.below.empty()) return job.box.triangles;
    std::uint64_t sum = 0;
    for (const std::size_t i : job.below) sum += planned(jobs_[i]);
    return std::min(sum, most_);
  }
  /// Returns the memory that a tile takes while it is made. `of`: returns the triangles of a tile below.
  template <class Triangles>
  std::uint64_t bytes_of(const Job& job, const Triangles& of) const {
    if (job.below.empty()) return job.box.triangles * kLeafBytesPerTriangle;
    std::uint64_t triangles = 0;
    for (const std::size_t i : job.below) triangles += of(jobs_[i]);
    return triangles * kTileBytesPerTriangle;
  }
  /// Refuses before the work if a tile will not fit.
  void require_memory() const {
    std::uint64_t most = 0;
    for (const Job& job : jobs_) most = std::max(most, bytes_of(job, [&](const Job& below) { return planned(below); }));
    if (most > memory_.bytes) throw NeedsMemory("a tile of the scene", most, memory_.bytes, memory_.limit_for(most));
    images_.require_memory();
  }
  /// Returns how many of the jobs are done at the same time: the largest fit into the memory together. The tiles below
  /// are done.
  int at_once(const std::vector<std::size_t>& jobs) const {
    std::uint64_t most = 1;
    for (const std::size_t i : jobs)
      most = std::max(most, bytes_of(jobs_[i], [](const Job& below) { return below.triangles; }));
    return int(std::clamp(memory_.bytes / most, std::uint64_t(1), std::uint64_t(thread_count())));
  }
  void make(Job& job) {
    SceneTile tile;
    std::string content;
    job.kept = results_ != nullptr && get_kept(job, tile, content);
    if (!job.kept) tile = made(job);
    job.bounds = tile.leaf.bounds;
    for (const std::size_t i : job.below) {
      if (jobs_[i].triangles == 0) continue;
      job.bounds.merge(jobs_[i].bounds);
      files_.drop(jobs_[i].tile);
    }
    job.error_world = tile.error_world;
    job.triangles = tile.leaf.triangles();
    if (job.below.empty()) {
      for (const TriangleD& t : world_triangles(tile.leaf)) job.area += area_of(t);
    }
    const ImageNames images = images_of(tile);
    if (!job.kept) {
      if (job.triangles > 0) content = content_of(job, tile, images);
      if (results_ != nullptr) keep(job, tile, content);
    }
    if (job.triangles == 0) return;
    job.bytes = content.size();
    job.content = files_.put(bytes_of_text(content));
    std::string bytes;
    pack(bytes, tile);
    job.tile = files_.put(bytes_of_text(bytes));
  }
  SceneTile made(const Job& job) const {
    if (job.below.empty()) return leaf_tile(looks_, job.box.box, cube_.unit);
    std::vector<SceneTile> below;
    for (const std::size_t i : job.below) {
      if (jobs_[i].triangles > 0) below.push_back(taken(jobs_[i]));
    }
    if (below.empty()) return {};
    return tile_above(below, job.box.box, most_, [&](std::uint32_t material) { return looks_.key_of(material); });
  }
  SceneTile taken(const Job& job) const {
    std::vector<std::byte> bytes;
    files_.get(job.tile, bytes);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    SceneTile tile;
    if (!unpack(text, tile)) fail(ErrorCode::failed, "a tile that waits in the scratch is damaged");
    return tile;
  }
  bool get_kept(const Job& job, SceneTile& tile, std::string& content) const {
    std::string bytes;
    if (!results_->get(job.key, bytes)) return false;
    std::string_view text = bytes;
    std::vector<ResultKey> looks;
    if (!unpack(text, tile) || !unpack(text, looks) || looks.size() != tile.leaf.parts.size()) return false;
    for (std::size_t i = 0; i < looks.size(); ++i) {
      const auto found = materials_.find(looks[i]);
      if (found == materials_.end()) return false;
      tile.leaf.parts[i].material = found->second;
    }
    content = text;
    return true;
  }
  void keep(const Job& job, SceneTile tile, const std::string& content) const {
    std::vector<ResultKey> looks;
    for (LeafPart& part : tile.leaf.parts) {
      looks.push_back(looks_.key_of(part.material));
      part.material = 0;
    }
    std::string bytes;
    pack(bytes, tile);
    pack(bytes, looks);
    results_->put(job.key, bytes + content);
  }
  /// Returns the files of the images that a tile shows. An image is halved while its texels are finer than a share of
  /// the tile's error, as textures of levels are: a viewer does not tell them where it draws the tile.
  ImageNames images_of(const SceneTile& tile) {
    struct Use {
      MipImage::Kind kind = MipImage::Kind::numbers;
      Texels texels;
    };
    std::map<std::uint32_t, Use> uses;
    const TextureSet* const set = looks_.images();
    for (const LeafPart& part : tile.leaf.parts) {
      if (set == nullptr || part.material == TriangleTexture::kNoMaterial) continue;
      const TextureMaterial& m = set->material(part.material);
      for (const std::uint32_t image : m.images()) {
        if (image == kNoTextureImage) continue;
        Use& use = uses[image];
        if (image == m.image || image == m.surface.emission.image) use.kind = MipImage::Kind::color;
        if (tile.error_world > 0) add_texels(tile.leaf, part, places_of(m, image), set->size(image), use.texels);
      }
    }
    ImageNames names;
    for (auto& [image, use] : uses) {
      const double texel = finest_of(use.texels), wanted = tile.error_world / kTexelsPerError;
      const int halvings = texel > 0 && wanted > texel ? int(std::log2(wanted / texel)) : 0;
      names[image] = images_.name_of(image, halvings, use.kind);
    }
    const std::lock_guard lock(mutex_);
    for (const auto& [image, name] : names) {
      if (!name.empty()) used_images_.insert(name);
    }
    return names;
  }
  std::string content_of(const Job& job, const SceneTile& tile, const ImageNames& images) const {
    const auto name_of_image = [&](std::uint32_t image) {
      const auto found = images.find(image);
      return found == images.end() ? std::string() : found->second;
    };
    const LeafLooks looks{looks_.images(), name_of_image, build_.options.colors(), build_.options.compression};
    const std::string name = build_.options.name + "_0" + job.box.path;
    return leaf_glb(name, tile.leaf, looks, scene_.voxels.header.frame.up, provenance_, false);
  }
  Tile tile_of(const Job& job, const Vec3d& parent) const {
    const Vec3d origin = middle_of(job.box.box);
    Tile tile = tile_at({name_of(job), origin, job.bounds, job.error_world}, parent, scene_.voxels.header.frame.up);
    for (const std::size_t i : job.below) {
      if (jobs_[i].triangles > 0) tile.children.push_back(tile_of(jobs_[i], origin));
    }
    return tile;
  }

  Build& build_;
  const LodScene& scene_;
  const SceneLooks& looks_;
  Scratch& files_;
  ResultStore* const results_;
  const TileCube cube_;
  const std::uint64_t most_;
  const MemoryShare memory_;
  ImageFiles images_;
  std::vector<Provenance> provenance_;
  std::vector<Job> jobs_;                         // those above come first
  std::map<ResultKey, std::uint32_t> materials_;  // their numbers; set if results are kept
  std::mutex mutex_;
  std::set<std::string> used_images_;
};

}  // namespace

std::uint64_t most_tile_triangles(const BuildOptions& options) {
  // A tile is drawn while its box fills no more than the screen: then a triangle has some ten pixels. With a quarter of
  // them, houses that are ten pixels wide became single triangles.
  constexpr std::uint64_t kVisualTileTriangles = 65536;
  return options.levels.faces.empty() ? kVisualTileTriangles : options.levels.faces.front();
}

std::vector<LevelRow> write_visual_tiles(Build& build, const LodScene& scene, const SceneLooks& looks,
                                         ResultStore* results, const std::string& cache_fault, TilesetFolder& folder) {
  build.report.begin("tiles");
  const std::unique_ptr<Scratch> files = make_scratch(build.budget.store, build.options.common.temp);
  VisualTiles tiles(build, scene, looks, *files, results);
  tiles.make();
  build.progress.end();
  if (!cache_fault.empty()) build.note(cache_fault + "; what is not in the cache was made, and is not kept");
  for (const std::string& text : tiles.notes()) build.note(text);
  build.report.begin("write");
  tiles.write_to(folder);
  folder.write("tileset.json", tileset_text(tiles.tileset(), tiles.provenance()));
  return tiles.rows();
}

}  // namespace bp
