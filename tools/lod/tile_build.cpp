#include "tools/lod/tile_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/mesh/lod_writer.h"
#include "io/store/chunk_store.h"
#include "io/store/result_store.h"
#include "io/tiles/tileset_file.h"
#include "lib/core/parallel.h"
#include "lib/levels/tile_pyramid.h"
#include "lib/pass/color/vertex_colors.h"
#include "lib/store/source_digest.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/tile_plan.h"
#include "tools/lod/tile_tree.h"
#include "tools/lod/tileset_folder.h"
#include "tools/lod/whole_levels.h"

namespace bp {

namespace {

/// The middle of a cell: the numbers in its file stay small.
LatticeCoord centre_of(const Cells& cells, CellCoord cell) {
  const VoxelCoord first = cells.box(cell).min;
  const std::int64_t half = cells.edge_vox / 2;
  return {(first.x + half) * kLatticePerVoxel, (first.y + half) * kLatticePerVoxel,
          (first.z + half) * kLatticePerVoxel};
}

/// A file that waits until all are there.
struct Waiting {
  std::string name;
  ChunkStore::Handle content;
};

/// Results that are there; nothing is added.
class LookUpStore final : public ResultStore {
 public:
  /// `folder` need not be there.
  explicit LookUpStore(const std::string& folder) {
    if (std::filesystem::is_directory(folder)) results_ = open_result_store(folder);
  }
  bool get(const ResultKey& key, std::string& out) override { return results_ && results_->get(key, out); }
  void put(const ResultKey&, std::string_view) override {}

 private:
  std::unique_ptr<ResultStore> results_;
};

/// What a cache holds belongs to the sources of a program: a file of their name tells which ones were here. True if
/// only others were. `leave`: this one's name, too, if that can be, and as of now: what is old may be deleted.
bool is_of_others(const std::string& folder, bool leave) {
  constexpr std::string_view kName = "made-by-";
  std::error_code error;
  bool mine = false, others = false;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    const bool tells = name.starts_with(kName);
    mine = mine || (tells && name.substr(kName.size()) == source_digest());
    others = others || tells || name.size() == 2;  // results are in folders ab/; not all builds told their name
  }
  if (leave) {
    const auto file = std::filesystem::path(folder) / (std::string(kName) + std::string(source_digest()));
    if (!mine) std::ofstream{file};
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
  }
  return others && !mine;
}

/// Of the levels that were asked for: each is one mesh, or a folder of tiles.
std::vector<std::string> certain_names(const BuildOptions& o) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < level_count(o.request); ++i) {
    names.push_back(level_name(o.name, i));
    names.push_back(names.back() + ".glb");
  }
  return names;
}

/// The whole tileset; results of some of its jobs; or a look at those that are there.
enum class Task { tileset, some_jobs, look_up };

class TilesetBuild {
 public:
  TilesetBuild(const BuildOptions& o, Task task) : options_(o), task_(task), build_(o), cells_{o.tile_vox} {
    if (task == Task::tileset)
      folder_ = std::make_unique<TilesetFolder>(o.out, certain_names(o), o.common.overwrite, o.resume);
    store_ = make_chunk_store(build_.budget.store, o.common.temp);
    if (const std::string text = cache_note(o); !text.empty() && task != Task::look_up) build_.note(text);
    const std::string results = o.resume ? TilesetFolder::results_of(o.out) : o.cache;
    if (task == Task::look_up) {
      results_ = std::make_unique<LookUpStore>(results);
    } else if (!results.empty()) {
      results_ = open_result_store(results, when_read_only());
      if (!o.resume) static_cast<void>(is_of_others(results, true));
    }
  }

  void run() {
    VoxelizedScene scene = make_levels();
    build_.progress.end();
    if (!read_only_.empty()) build_.note(read_only_ + "; what is not in the cache was made, and is not kept");
    if (task_ == Task::tileset) write(scene);
    if (task_ == Task::some_jobs) build_.finish_jobs(scene, *options_.tiles, plan_.jobs(), found_);
  }

  [[nodiscard]] const std::vector<FoundJobs>& found() const { return found_; }

 private:
  /// A cache that others fill is good to read. To fill it, or to resume, it must take what is put.
  [[nodiscard]] std::function<void(const std::string&)> when_read_only() {
    if (task_ == Task::some_jobs || options_.resume) return {};
    return [this](const std::string& why) { read_only_ = why; };
  }

  VoxelizedScene make_levels() {
    VoxelizedScene scene = build_.voxelize(cells_.edge_vox, results_.get());
    scene_voxel_ = scene.header.frame.voxel;
    bounds_ = scene.header.bounds;
    plan_ = plan_tileset(options_, scene.header);
    if (task_ == Task::some_jobs && options_.tiles->begin >= plan_.jobs())
      build_.note(fmt::format("--tiles {}..{}: there are {} jobs, numbered from 0: nothing is done",
                              options_.tiles->begin, options_.tiles->end, plan_.jobs()));
    tree_ = std::make_unique<TileTree>(scene.header.frame.up, cells_);
    build_.report.stage("measure the scene");
    PyramidOptions pyramid_options;
    pyramid_options.cells = cells_;
    pyramid_options.closing.element = options_.element;
    pyramid_options.context = build_.context(results_.get());
    TilePyramid pyramid(scene.header, std::move(scene.solid), build_.backends, pyramid_options);
    LodOptions lod = build_.lod_options();
    make_cut_levels(pyramid, scene.header, lod.scene);
    if (plan_.whole > 0 && is_wanted(plan_.whole_number(), 1))
      make_whole(pyramid, std::move(lod), scene.counts.input_hash);
    return scene;
  }

  /// Whether any of `count` jobs is.
  [[nodiscard]] bool is_wanted(std::uint64_t number, std::uint64_t count) const {
    return task_ != Task::some_jobs || options_.tiles->meets(number, count);
  }

  /// Those of more than one cell.
  void make_cut_levels(TilePyramid& pyramid, const StreamHeader& header, const std::vector<TriangleD>& scene) {
    std::unique_ptr<TriangleBvh> tree;
    if (!scene.empty() && !plan_.cut.empty()) tree = std::make_unique<TriangleBvh>(scene);
    std::vector<std::unique_ptr<LevelAtWork>> levels;
    for (std::size_t level = 0; level < plan_.cut.size(); ++level) {
      const CutLevel& cut = plan_.cut[level];
      build_.report.stage(fmt::format("close level {}", level));
      levels.push_back(std::make_unique<LevelAtWork>());
      levels.back()->found.what = fmt::format("level {}", level);
      if (is_wanted(cut.number, cut.cells.count())) add_level(pyramid, level, tree.get(), *levels.back());
      pyramid.reduce();
    }
    build_.report.stage("make tiles");
    pyramid.make_tiles();
    for (std::size_t level = 0; level < levels.size(); ++level) finish_level(level, *levels[level]);
    if (plan_.whole == 0 && task_ == Task::tileset)
      build_.note(
          fmt::format("the coarsest level has {} tiles, and nothing is drawn instead of them from afar: it takes {} "
                      "levels to come to one mesh, or larger tiles",
                      rows_.back().tiles, levels_to_one_mesh(options_, header)));
  }

  /// A level that is cut, while its tiles come in.
  struct LevelAtWork {
    FoundJobs found{};
    std::string folder;
    GridFrame frame;
    LevelRow row;
    std::uint64_t over_faces = 0, dense = 0;
    std::vector<std::pair<CellCoord, TreeTile>> tiles;
  };

  void add_level(TilePyramid& pyramid, std::size_t number, const TriangleBvh* scene, LevelAtWork& level) {
    const CutLevel& cut = plan_.cut[number];
    level.frame = pyramid.header().frame;
    level.folder = level_name(options_.name, number);
    level.row = {level.folder + "/*.glb", 0, 0, 0, 0, cut.scale_world, level.frame.voxel};
    OptionText text = option_text(options_, build_.enclosed(), cut.target, number, cut.scale_world, level.frame);
    if (build_.colors() != nullptr) text.add("colors", "auto");
    const std::vector<Provenance> provenance{make_provenance("bplod", text)};
    TileParams params = tile_params(cut.target, level.frame, scene);
    params.encoding = level.folder + " " + provenance[0].options;
    params.make = task_ != Task::look_up;
    if (task_ == Task::some_jobs)
      params.wanted = [this, &cut](CellCoord cell) { return is_wanted(cut.number_of(cell), 1); };
    if (build_.colors() != nullptr) {
      build_.colors()->prepare(level.frame);
      params.add_to_key = [this, &level, &cut](CellCoord cell, KeyHash& hash) {
        colors_around(cell, level.frame, cut.scale_world).add_to(hash);
      };
    }
    pyramid.add_level(
        cut.scale_world, std::move(params),
        [this, &level, &cut, provenance](CellCoord cell, const LatticeMesh& mesh) {
          LatticeMesh named = mesh;
          named.provenance = provenance;
          if (build_.colors() != nullptr) color_vertices(named, colors_around(cell, level.frame, cut.scale_world));
          return tile_glb({level.folder + "_" + name_of(cell), &named}, centre_of(cells_, cell));
        },
        [this, &level](LevelTile&& tile) { take(std::move(tile), level); });
  }

  void take(LevelTile&& tile, LevelAtWork& level) {
    level.found.jobs += 1;
    level.found.kept += tile.kept;
    if (task_ != Task::tileset) return;
    const TileMeasures& m = tile.measures;
    level.row.tiles += 1;
    level.row.faces += m.faces;
    level.row.bytes += tile.content.size();
    level.dense += m.faces_dense;
    level.over_faces += m.faces_asked > 0 && m.faces > m.faces_asked;
    TreeTile node{level.folder + "/" + name_of(tile.cell) + ".glb",
                  level.frame.world(centre_of(cells_, tile.cell)),
                  {},
                  m.error_world};
    node.bounds.add(level.frame.world(m.min));
    node.bounds.add(level.frame.world(m.max));
    files_.push_back({node.uri, store_->put(std::as_bytes(std::span(tile.content)))});
    level.tiles.emplace_back(tile.cell, std::move(node));
  }

  void finish_level(std::size_t number, LevelAtWork& level) {
    found_.push_back(level.found);
    if (task_ != Task::tileset) return;
    for (auto& [cell, node] : level.tiles) tree_->add(number, level.frame, cell, std::move(node));
    level.row.more = {{"faces_dense", level.dense}, {"kept", level.found.kept}};
    rows_.push_back(level.row);
    if (level.over_faces > 0 && !options_.request.faces.empty())
      build_.note(
          fmt::format("level {}: {} of {} tiles have more faces than were asked for: no further edge can be "
                      "merged at a scale of {:.4g}",
                      number, level.over_faces, level.row.tiles, level.row.scale_world));
    const double asked = plan_.cut[number].target.error_world;
    if (asked > 0 && level.row.error_world > asked) build_.note(error_note(number, level.row.error_world, asked));
  }

  [[nodiscard]] TileParams tile_params(const LodTarget& target, const GridFrame& frame,
                                       const TriangleBvh* scene) const {
    TileParams params;
    params.mode = options_.mode;
    params.enclose = options_.enclose.value_or(Enclose::input);
    params.tighten = !options_.loose;
    params.faces = target.faces;
    // What is enclosed is within a diagonal of a voxel of the scene.
    if (target.error_world > 0)
      params.error_world =
          std::max(target.error_world - std::sqrt(3.0) * (frame.voxel + scene_voxel_), target.error_world / 4);
    params.scene = scene;
    return params;
  }

  /// As far as a voxel of the closing may lie from the nearest one of the scene.
  [[nodiscard]] NearbyColors colors_around(CellCoord cell, const GridFrame& frame, double scale) const {
    return build_.colors()->around(frame, cells_.box(cell),
                                   std::int32_t(std::ceil(scale / frame.voxel)) + kColorCellVox);
  }

  static std::string name_of(CellCoord c) { return fmt::format("{}_{}_{}", c.x, c.y, c.z); }

  void make_whole(TilePyramid& pyramid, LodOptions lod, const std::string& input_hash) {
    const std::size_t cut = plan_.cut.size();
    build_.report.stage("levels in one mesh");
    if (cut > 0) lod.least_scale_world = TilesetPlan::kScaleVox * pyramid.header().frame.voxel;
    WholeInput input{pyramid.header(), pyramid.take_solid(), pyramid.take_surface(),   cut,
                     plan_.whole,      scene_voxel_,         cut > 0 ? "" : input_hash};
    FoundJobs& found = found_.emplace_back(FoundJobs{"levels in one mesh", 1, 0});
    if (task_ == Task::look_up) {
      found.kept = are_kept(build_, input, lod, *results_) ? 1 : 0;
      return;
    }
    const WholeLevels whole = make_whole_levels(build_, std::move(input), std::move(lod), results_.get());
    found.kept = whole.kept ? 1 : 0;
    if (task_ == Task::some_jobs) return;
    for (const WholeLevel& level : whole.levels) {
      files_.push_back({level.row.file, store_->put(std::as_bytes(std::span(level.content)))});
      tree_->add_whole({level.row.file, whole.origin, level.bounds, level.row.error_world});
      rows_.push_back(level.row);
    }
    if (cut == 0) provenance_ = whole.levels.front().provenance;
  }

  void write(const VoxelizedScene& scene) {
    build_.report.stage("write");
    const Tileset tileset = tree_->finish(bounds_.diagonal());
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].error_world = tree_->error_of(i);
    if (provenance_.empty()) provenance_ = {make_provenance("bplod", tileset_options(), scene.counts.input_hash)};
    parallel_for(std::int64_t(files_.size()), [&](std::int64_t i) {  // each waits for the disk
      const Waiting& file = files_[std::size_t(i)];
      std::vector<std::byte> bytes;
      store_->get(file.content, bytes);
      folder_->write(file.name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
      store_->drop(file.content);
    });
    folder_->write("tileset.json", tileset_text(tileset, provenance_));
    folder_->commit();
    if (!folder_->complaint().empty())
      build_.note(folder_->complaint() + "; tiles of the tileset that was there before are not known, and stay");
    build_.finish(scene, rows_, folder_->bytes());
  }

  /// Of a tileset whose levels are cut: each tile has its own.
  [[nodiscard]] OptionText tileset_options() const {
    OptionText text;
    text.add("levels", rows_.size()).add("tile", cells_.edge_vox).add("voxel", scene_voxel_);
    return text;
  }

  const BuildOptions& options_;
  const Task task_;
  std::unique_ptr<TilesetFolder> folder_;  ///< of a tileset
  Build build_;
  Cells cells_;
  std::unique_ptr<TileTree> tree_;
  TilesetPlan plan_;
  std::unique_ptr<ChunkStore> store_;     ///< files, until all are there
  std::unique_ptr<ResultStore> results_;  ///< of jobs; may be null
  std::string read_only_;                 ///< why results_ keeps nothing; known once the levels are made
  double scene_voxel_ = 0;
  Bounds3d bounds_;
  std::vector<Waiting> files_;
  std::vector<LevelRow> rows_;
  std::vector<FoundJobs> found_;
  std::vector<Provenance> provenance_;  ///< of the tileset, if no level is cut
};

}  // namespace

std::string cache_note(const BuildOptions& options) {
  if (options.cache.empty() || !is_of_others(options.cache, false)) return "";
  return options.cache + ": holds results of other builds of bplod, and none of this one: all is made anew";
}

void build_tileset(const BuildOptions& options) {
  TilesetBuild(options, options.tiles ? Task::some_jobs : Task::tileset).run();
}

std::vector<FoundJobs> look_up_tileset(const BuildOptions& options) {
  TilesetBuild build(options, Task::look_up);
  build.run();
  return build.found();
}

}  // namespace bp
