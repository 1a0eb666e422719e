#include "lib/levels/tile_stage.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/clip.h"
#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/voxel_distance.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/store/packing.h"
#include "lib/volume/dilate.h"
#include "lib/volume/reach.h"

namespace bp {

namespace {

// The surface while it is simplified, what it encloses, distances.
constexpr std::uint64_t kBytesPerDenseFace = 320, kBytesPerTile = std::uint64_t(4) << 20;

constexpr const char* kJobName = "tile";

/// As the store keeps it.
std::string packed(const LevelTile& tile) {
  std::string bytes;
  pack(bytes, tile.measures);
  return bytes + tile.content;
}

bool unpack_tile(std::string_view bytes, LevelTile& tile) {
  if (!unpack(bytes, tile.measures)) return false;
  tile.content = bytes;
  return true;
}

/// Of the voxels of a tile, four times: leave_out_fringes().
std::uint64_t voxel_bytes(const Cells& cells) {
  const auto edge = std::uint64_t(cells.edge_vox);
  return 4 * (edge + 2 * kBrickEdge) * (edge + 2) * (edge + 2) / 8 + kBytesPerTile;
}

/// A cell with something to mesh.
struct Job {
  CellCoord cell{};
  std::uint64_t dense_faces = 0;  // about: of the closing in the cell, without walls
};

/// Cells of the closing's bricks, and how much there is to do in each.
std::vector<Job> jobs_of(const TileLevel& level, const std::function<bool(CellCoord)>& wanted) {
  const std::vector<BrickCoord> bricks = level.closing.coords();
  std::vector<std::pair<CellCoord, std::uint64_t>> parts(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    const BrickCoord brick = bricks[std::size_t(i)];
    parts[std::size_t(i)] = {level.cells.of(first_voxel(brick)), 2 * boundary_faces(level.closing, brick)};
  });
  std::sort(parts.begin(), parts.end());
  std::vector<Job> jobs;
  for (const auto& [cell, faces] : parts) {
    if (wanted && !wanted(cell)) continue;
    if (jobs.empty() || jobs.back().cell != cell) jobs.push_back({cell, 0});
    jobs.back().dense_faces += faces;
  }
  return jobs;
}

/// One tile: see the header of this stage.
class Maker {
 public:
  Maker(const TileTask& task, CellCoord coord)
      : level_(task.level),
        params_(task.params),
        coord_(coord),
        cell_(level_.cells.box(coord)),
        grown_(cell_.grown(1)) {}

  /// Everything that the tile depends on.
  [[nodiscard]] ResultKey key() const {
    const TileShape& shape = params_;
    KeyHash hash(kJobName);
    hash.add(shape, level_.header.frame, coord_, level_.cells);
    const BrickCoord origin = brick_of(cell_.min);
    add_voxels(hash, level_.closing, grown_, origin);
    add_voxels(hash, level_.solid, grown_, origin);
    add_voxels(hash, level_.surface, reach(), origin);
    if (params_.mode == MeshMode::fit) {
      const std::vector<TriangleD> scene = scene_nearby();
      hash.add(std::as_bytes(std::span(scene)));
    }
    if (params_.add_to_key) params_.add_to_key(coord_, hash);
    return hash.key();
  }

  /// False for a cell in a cavity that the closing filled: no voxel of the scene, and nothing to be seen.
  [[nodiscard]] bool begin() {
    solid_ = clipped(level_.solid, grown_, params_.make_shelf);
    closing_ = clipped(level_.closing, grown_, params_.make_shelf);
    if (solid_->coords().empty() && is_full(*closing_, cell_)) return false;
    if (params_.mode == MeshMode::bounding && params_.enclose == Enclose::input) leave_out_fringes();
    if (closing_->coords().empty()) return false;
    boundary_ = boundary_of(*solid_);
    hold_stray_parts();
    return true;
  }

  LatticeMesh make(const PieceMemory& memory, TileMeasures& measures) {
    MeshCounts counts;
    LatticeMesh mesh = mesh_cell(2 * boundary_.faces, memory, measures, counts);
    measure(mesh, boundary_.runs, measures);
    measures.faces_dense = counts.levels.front().simplify.faces_in;
    measures.volume = counts.levels.front().measures.volume;
    return mesh;
  }

 private:
  /// What the closing has here only for voxels of the next cells: sheets along the walls, over which a tile would stand
  /// far off all that it encloses. That is what lies beyond the closing's reach from the solid, and is not shut in by
  /// the rest: what fills cavities stays.
  void leave_out_fringes() {
    BitBox closing(grown_), kept(grown_), outside(grown_);
    load_voxels(*closing_, closing);
    load_voxels(*solid_, kept);
    dilate(kept, std::int32_t(std::ceil(params_.scale_world / level_.header.frame.voxel)) + 1);
    const VoxelBox box = closing.box();
    const std::int32_t words = closing.words_per_row();
    std::vector<std::uint64_t> here(std::size_t(words), 0);  // of a row, the voxels of the cell
    for (std::int32_t x = grown_.min.x; x < grown_.max.x; ++x)
      here[std::size_t((x - box.min.x) / 64)] |= std::uint64_t(1) << ((x - box.min.x) % 64);
    const auto for_each_word = [&](const auto& body) {
      for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
        for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
          for (std::int32_t i = 0; i < words; ++i)
            body(closing.row(y, z)[i], kept.row(y, z)[i], outside.row(y, z)[i], here[std::size_t(i)]);
        }
      }
    };
    std::uint64_t far = 0;
    for_each_word([&](std::uint64_t c, std::uint64_t& near, std::uint64_t& out, std::uint64_t cell) {
      far |= c & ~near;
      out = ~c & cell;
      near = (~c | ~near) & cell;  // where the outside may go
    });
    if (far == 0) return;
    grow_within(kept, outside);
    for_each_word([&](std::uint64_t& c, std::uint64_t, std::uint64_t out, std::uint64_t) { c &= ~out; });
    closing_ = params_.make_shelf();
    for_each_brick(grown_, [&](BrickCoord c) {
      BrickBits bits{};
      for (std::int32_t z = 0; z < kBrickEdge; ++z) {
        for (std::int32_t y = 0; y < kBrickEdge; ++y) {
          const VoxelCoord p = first_voxel(c) + VoxelCoord{0, y, z};
          if (row_within(c, y, z, grown_) == 0) continue;
          bits[std::size_t(z * kBrickEdge + y)] = closing.row(p.y, p.z)[(p.x - box.min.x) / kBrickEdge];
        }
      }
      if (classify(bits) != BrickFill::empty) closing_->put(c, classify(bits), bits);
    });
  }

  /// Where a part of the closing holds no voxel of the solid in this cell, nothing would stop it as it is tightened: it
  /// might pass through itself. So it is to enclose itself.
  void hold_stray_parts() {
    BitBox closing(grown_), held(grown_);
    load_voxels(*closing_, closing);
    load_voxels(*solid_, held);
    grow_within(closing, held);
    BrickBits bits, before;
    for_each_brick(grown_, [&](BrickCoord c) {
      const VoxelCoord first = first_voxel(c);
      bool stray = false;
      solid_->get(c, before);
      for (std::int32_t z = 0; z < kBrickEdge; ++z) {
        for (std::int32_t y = 0; y < kBrickEdge; ++y) {
          const VoxelCoord p = first + VoxelCoord{0, y, z};
          std::uint64_t& word = bits[std::size_t(z * kBrickEdge + y)];
          word = before[std::size_t(z * kBrickEdge + y)];
          if (row_within(c, y, z, grown_) == 0) continue;
          const std::int32_t i = (p.x - closing.box().min.x) / kBrickEdge;
          const std::uint64_t left = closing.row(p.y, p.z)[i] & ~held.row(p.y, p.z)[i];
          stray = stray || left != 0;
          word |= left;
        }
      }
      if (stray) solid_->put(c, classify(bits), bits);
    });
  }

  LatticeMesh mesh_cell(std::uint64_t solid_faces, const PieceMemory& memory, TileMeasures& measures,
                        MeshCounts& counts) {
    MeshParams mesh;
    mesh.memory = memory;
    mesh.mode = params_.mode;
    mesh.tighten = params_.tighten;
    mesh.enclose = params_.enclose;
    mesh.error_world = params_.error_world;
    mesh.near = true;  // where the error below is no limit
    if (params_.error_world == 0) {
      measures.faces_asked = params_.faces > 0
                                 ? params_.faces
                                 : std::max(solid_faces / TileParams::kDenseFacesPerFace, TileParams::kLeastFaces);
      mesh.faces = {measures.faces_asked};
      if (params_.faces == 0 && params_.mode == MeshMode::bounding && solid_faces <= TileParams::kMostFacesForError)
        mesh.error_world = TileParams::kErrorVox * level_.header.frame.voxel;
    }
    if (params_.mode == MeshMode::fit) {
      mesh.scene = scene_nearby();
      mesh.enclose = mesh.scene.empty() ? Enclose::closing : Enclose::scene;
    }
    ShelfSource source(header(), *solid_, closing_.get(), ShelfSource::Keep::solid);
    return std::move(mesh_stream(source, params_.make_shelf, std::move(mesh), counts).front());
  }

  [[nodiscard]] StreamHeader header() const {
    StreamHeader header = level_.header;
    header.bricks = bricks_of(grown_);
    header.slab_axis = longest_axis(header.bricks);
    header.has_closing = true;
    header.scale = {};
    header.scale.base = params_.scale_world;
    header.element = params_.element;
    return header;
  }

  /// Triangles that a fit may be drawn to.
  [[nodiscard]] std::vector<TriangleD> scene_nearby() const {
    std::vector<std::pair<std::uint32_t, TriangleD>> found;
    if (params_.scene == nullptr) return {};
    const VoxelBox reach = grown_.grown(4);
    Bounds3d bounds;
    for (const VoxelCoord p : {reach.min, reach.max}) {
      bounds.add(level_.header.frame.world({std::int64_t(p.x) * kLatticePerVoxel, std::int64_t(p.y) * kLatticePerVoxel,
                                            std::int64_t(p.z) * kLatticePerVoxel}));
    }
    params_.scene->visit(bounds, [&](const TriangleBvh::Item& item) {
      found.emplace_back(item.id, item.corners);
      return false;
    });
    std::sort(found.begin(), found.end());
    std::vector<TriangleD> triangles;
    for (const auto& [id, corners] : found) triangles.push_back(corners);
    return triangles;
  }

  /// Where every voxel of the closing in the cell finds one of the scene.
  [[nodiscard]] VoxelBox reach() const {
    return grown_.grown(std::int32_t(std::ceil(params_.scale_world / level_.header.frame.voxel)) + 2);
  }

  void measure(const LatticeMesh& mesh, const std::vector<VoxelRun>& walls, TileMeasures& measures) const {
    measures.faces = mesh.triangles.size();
    measures.min = measures.max = mesh.vertices.front();
    for (const LatticeCoord& v : mesh.vertices) {
      for (int i = 0; i < 3; ++i) {
        measures.min[i] = std::min(measures.min[i], v[i]);
        measures.max[i] = std::max(measures.max[i], v[i]);
      }
    }
    const GridFrame& frame = mesh.frame;
    const std::vector<TriangleD> triangles = world_triangles(mesh);
    std::vector<VoxelRun> near = runs_of(level_.surface, reach());
    near.insert(near.end(), walls.begin(), walls.end());
    measures.error_world = distance_from_mesh(triangles, TriangleBvh(segments_of(near, frame)), frame.voxel);
    if (params_.mode != MeshMode::fit) return;
    measures.error_world = distance_beyond_mesh(segments_of(runs_of(level_.surface, cell_), frame),
                                                TriangleBvh(triangles), frame.voxel, measures.error_world);
  }

  const TileLevel& level_;
  const TileParams& params_;
  const CellCoord coord_;
  const VoxelBox cell_, grown_;
  std::unique_ptr<BrickShelf> solid_, closing_;  // solid_: what must stay inside
  Boundary boundary_;                            // of the solid
};

/// Makes the tiles of some levels.
class TileMaking {
 public:
  TileMaking(std::span<const TileTask> tasks, const TileRun& run) : tasks_(tasks), run_(run) {
    for (const TileTask& task : tasks_) {
      check_memory(task.level.cells);
      for (const Job& job : jobs_of(task.level, task.params.wanted)) jobs_.push_back({&task, job, {}});
    }
  }

  void operator()() {
    take_kept();
    std::stable_sort(jobs_.begin(), jobs_.end(),
                     [](const TileJob& a, const TileJob& b) { return a.job.dense_faces > b.job.dense_faces; });
    const int n = in_flight();
    pieces_ = run_.pieces.split(std::uint64_t(n));
    std::size_t next = 0;
    run_jobs<std::size_t>(
        n,
        [&](std::size_t& i) {
          i = next++;
          return i < jobs_.size();
        },
        [&](const std::size_t& i) { make(jobs_[i]); });
  }

 private:
  struct TileJob {
    const TileTask* task;
    Job job;
    ResultKey key;  ///< if there is a store
  };

  void check_memory(const Cells& cells) const {
    const std::uint64_t bytes = voxel_bytes(cells);
    if (bytes <= run_.memory_bytes) return;
    fail(ErrorCode::out_of_resource,
         "a tile of {} voxels takes {} MiB, and --memory leaves {} MiB for it; raise --memory{}, or use a smaller "
         "--tile",
         cells.edge_vox, (bytes >> 20) + 1, run_.memory_bytes >> 20, run_.pieces.enough_for(bytes - run_.memory_bytes));
  }

  /// Jobs whose results are there leave the list. A hidden tile is kept as no bytes.
  void take_kept() {
    total_ = jobs_.size();
    std::vector<char> kept(jobs_.size());
    parallel_for(std::int64_t(jobs_.size()), [&](std::int64_t i) {
      TileJob& job = jobs_[std::size_t(i)];
      const TileParams& params = job.task->params;
      if (params.store == nullptr) return;
      job.key = Maker(*job.task, job.job.cell).key();
      LevelTile tile;
      std::string bytes;
      tile.kept = params.store->get(job.key, bytes) && (bytes.empty() || unpack_tile(bytes, tile));
      if (!tile.kept) return;
      kept[std::size_t(i)] = 1;
      finish(job, std::move(tile), !bytes.empty());
    });
    std::size_t left = 0;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (kept[i] == 0) jobs_[left++] = jobs_[i];
    }
    jobs_.resize(left);
  }

  /// The largest job is the first.
  [[nodiscard]] int in_flight() const {
    if (jobs_.empty()) return 1;
    std::uint64_t largest = jobs_.front().job.dense_faces * kBytesPerDenseFace + kBytesPerTile;
    for (const TileTask& task : tasks_) largest = std::max(largest, voxel_bytes(task.level.cells));
    return int(std::clamp<std::uint64_t>(run_.memory_bytes / largest, 1, std::uint64_t(thread_count())));
  }

  void make(const TileJob& job) {
    const TileTask& task = *job.task;
    Maker maker(task, job.job.cell);
    LevelTile tile;
    if (!task.params.make) return finish(job, std::move(tile), true);  // it is there, as far as is known
    const bool there = maker.begin();
    if (there) tile.content = task.encode(job.job.cell, maker.make(pieces_, tile.measures));
    if (task.params.store != nullptr) task.params.store->put(job.key, there ? packed(tile) : "");
    finish(job, std::move(tile), there);
  }

  void finish(const TileJob& job, LevelTile&& tile, bool there) {
    tile.cell = job.job.cell;
    const std::lock_guard lock(mutex_);
    if (run_.progress) run_.progress("meshing", "tiles", ++done_, total_);
    if (there) job.task->consume(std::move(tile));
  }

  const std::span<const TileTask> tasks_;
  const TileRun& run_;
  std::vector<TileJob> jobs_;
  PieceMemory pieces_;  // of each at work
  std::mutex mutex_;
  std::size_t done_ = 0, total_ = 0;
};

}  // namespace

void make_tiles(std::span<const TileTask> tasks, const TileRun& run) {
  for (const TileTask& task : tasks) {
    const std::int32_t edge = task.level.cells.edge_vox;
    if (edge < kBrickEdge || edge % kBrickEdge != 0)
      fail(ErrorCode::bad_argument, "a cell of {} voxels a side: must be a multiple of 64", edge);
  }
  TileMaking(tasks, run)();
}

}  // namespace bp
