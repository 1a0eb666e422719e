#include "tools/lod/tile_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/chunk_store.h"
#include "io/lod_writer.h"
#include "io/result_store.h"
#include "io/tileset_file.h"
#include "lib/stage/tile_pyramid.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/tile_tree.h"
#include "tools/lod/tileset_folder.h"
#include "tools/lod/whole_levels.h"

namespace bp {

namespace {

constexpr double kScaleVox = 2;        // closing radius of a level that is cut, in its voxels, if nobody says
constexpr double kScalesPerError = 4;  // as in LodChain

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

class TilesetBuild {
 public:
  explicit TilesetBuild(const BuildOptions& o)
      : options_(o), folder_(o.out, o.common.overwrite, o.resume), build_(o), cells_{o.tile_vox}, tree_(o.up, cells_) {
    store_ = make_chunk_store(build_.budget.store, o.common.temp);
    if (!o.cache.empty()) results_ = open_result_store(o.cache);
    if (o.resume) results_ = open_result_store(folder_.results());
  }

  void run() {
    VoxelizedScene scene = build_.voxelize(cells_.edge_vox);
    scene_voxel_ = scene.header.frame.voxel;
    bounds_ = scene.header.bounds;
    build_.report.stage("measure the scene");
    PyramidOptions pyramid_options;
    pyramid_options.cells = cells_;
    pyramid_options.closing.element = options_.element;
    pyramid_options.memory_bytes = build_.budget.closing_tiles();
    pyramid_options.make_shelf = build_.make_shelf;
    pyramid_options.store = results_.get();
    pyramid_options.progress = build_.show;
    TilePyramid pyramid(scene.header, std::move(scene.solid), build_.backends, pyramid_options);
    LodOptions lod = build_.lod_options();
    const std::size_t cut = make_cut_levels(pyramid, lod.scene);
    make_whole(pyramid, std::move(lod), cut, scene.counts.input_hash);
    build_.progress.end();
    write(scene);
  }

 private:
  /// As many as were asked for; else at least so many that the root is one mesh.
  [[nodiscard]] std::size_t level_count(std::size_t cut) const {
    const std::size_t asked = bp::level_count(options_.request);
    return is_explicit(options_.request) ? asked : std::max(asked, cut + 1);
  }

  /// Those of more than one cell; returns their number.
  std::size_t make_cut_levels(TilePyramid& pyramid, const std::vector<TriangleD>& scene) {
    std::unique_ptr<TriangleBvh> tree;
    if (!scene.empty() && !pyramid.in_one_cell()) tree = std::make_unique<TriangleBvh>(scene);
    std::size_t level = 0;
    for (; level < level_count(level) && !pyramid.in_one_cell(); ++level) {
      build_.report.stage(fmt::format("level {}", level));
      make_tiles(pyramid, level, tree.get());
      pyramid.reduce();
    }
    if (!pyramid.in_one_cell())
      build_.note(
          fmt::format("the coarsest level has {} tiles, and nothing is drawn instead of them from afar; ask for "
                      "more levels, or for larger tiles",
                      rows_.back().tiles));
    return level;
  }

  void make_tiles(TilePyramid& pyramid, std::size_t level, const TriangleBvh* scene) {
    const GridFrame& frame = pyramid.header().frame;
    const LodTarget target = tile_target_of(options_.request, level, bounds_.diagonal(), scene_voxel_);
    const double scale = scale_of(target, frame.voxel);
    const std::string level_folder = level_name(options_.name, level);
    const std::vector<Provenance> provenance{
        make_provenance("bplod", option_text(options_, target, level, scale, frame.voxel))};
    LevelRow row{level_folder + "/*.glb", 0, 0, 0, 0, scale, frame.voxel};
    std::uint64_t over_faces = 0, dense = 0, kept = 0;
    TileParams params = tile_params(target, frame, scene);
    params.encoding = level_folder + " " + provenance[0].options;
    pyramid.make(
        scale, std::move(params),
        [&](CellCoord cell, const LatticeMesh& mesh) {
          LatticeMesh named = mesh;
          named.provenance = provenance;
          return tile_glb({level_folder + "_" + name_of(cell), &named}, centre_of(cells_, cell));
        },
        [&](LevelTile&& tile) {
          const TileMeasures& m = tile.measures;
          row.tiles += 1;
          kept += tile.kept;
          row.faces += m.faces;
          row.bytes += tile.content.size();
          dense += m.faces_dense;
          over_faces += m.faces_asked > 0 && m.faces > m.faces_asked;
          TreeTile node{level_folder + "/" + name_of(tile.cell) + ".glb",
                        frame.world(centre_of(cells_, tile.cell)),
                        {},
                        m.error_world};
          node.bounds.add(frame.world(m.min));
          node.bounds.add(frame.world(m.max));
          files_.push_back({node.uri, store_->put(std::as_bytes(std::span(tile.content)))});
          tree_.add(level, frame, tile.cell, std::move(node));
        });
    row.more = {{"faces_dense", dense}, {"kept", kept}};
    rows_.push_back(row);
    if (over_faces > 0)
      build_.note(
          fmt::format("level {}: {} of {} tiles have more faces than were asked for: no further edge can be "
                      "merged at a scale of {:.4g}",
                      level, over_faces, row.tiles, scale));
  }

  [[nodiscard]] double scale_of(const LodTarget& target, double voxel) const {
    if (target.scale_world) return *target.scale_world;
    if (target.error_world > 0) return std::max(target.error_world / kScalesPerError, voxel);
    return kScaleVox * voxel;
  }

  [[nodiscard]] TileParams tile_params(const LodTarget& target, const GridFrame& frame,
                                       const TriangleBvh* scene) const {
    TileParams params;
    params.mode = options_.mode;
    params.enclose = options_.enclose;
    params.tighten = !options_.loose;
    params.faces = target.faces;
    // What is enclosed is within a diagonal of a voxel of the scene.
    if (target.error_world > 0)
      params.error_world =
          std::max(target.error_world - std::sqrt(3.0) * (frame.voxel + scene_voxel_), target.error_world / 4);
    params.scene = scene;
    return params;
  }

  static std::string name_of(CellCoord c) { return fmt::format("{}_{}_{}", c.x, c.y, c.z); }

  void make_whole(TilePyramid& pyramid, LodOptions lod, std::size_t cut, const std::string& input_hash) {
    if (cut == level_count(cut)) return;
    build_.report.stage("levels in one mesh");
    if (cut > 0) lod.least_scale_world = kScaleVox * pyramid.header().frame.voxel;
    WholeInput input{pyramid.header(),       pyramid.take_solid(), pyramid.take_surface(),   cut,
                     level_count(cut) - cut, scene_voxel_,         cut > 0 ? "" : input_hash};
    const WholeLevels whole = make_whole_levels(build_, std::move(input), std::move(lod), results_.get());
    for (const WholeLevel& level : whole.levels) {
      files_.push_back({level.row.file, store_->put(std::as_bytes(std::span(level.content)))});
      tree_.add_whole({level.row.file, whole.origin, level.bounds, level.row.error_world});
      rows_.push_back(level.row);
    }
    if (cut == 0) provenance_ = whole.levels.front().provenance;
  }

  void write(const VoxelizedScene& scene) {
    build_.report.stage("write");
    const Tileset tileset = tree_.finish(bounds_.diagonal());
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].error_world = tree_.error_of(i);
    if (provenance_.empty()) provenance_ = {make_provenance("bplod", tileset_options(), scene.counts.input_hash)};
    std::vector<std::byte> bytes;
    for (const Waiting& file : files_) {
      store_->get(file.content, bytes);
      folder_.write(file.name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
      store_->drop(file.content);
    }
    folder_.write("tileset.json", tileset_text(tileset, provenance_));
    folder_.commit();
    build_.finish(scene, rows_, folder_.bytes());
  }

  /// Of a tileset whose levels are cut: each tile has its own.
  [[nodiscard]] OptionText tileset_options() const {
    OptionText text;
    text.add("levels", rows_.size()).add("tile", cells_.edge_vox).add("voxel", scene_voxel_);
    return text;
  }

  const BuildOptions& options_;
  TilesetFolder folder_;
  Build build_;
  Cells cells_;
  TileTree tree_;
  std::unique_ptr<ChunkStore> store_;     ///< files, until all are there
  std::unique_ptr<ResultStore> results_;  ///< of jobs; may be null
  double scene_voxel_ = 0;
  Bounds3d bounds_;
  std::vector<Waiting> files_;
  std::vector<LevelRow> rows_;
  std::vector<Provenance> provenance_;  ///< of the tileset, if no level is cut
};

}  // namespace

void build_tileset(const BuildOptions& options) {
  TilesetBuild(options).run();
}

}  // namespace bp
