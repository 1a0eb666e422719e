#include "lib/pass/voxelize/voxelize_pass.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/cells.h"
#include "lib/pass/voxelize/detail/chunked_surface.h"
#include "lib/pass/voxelize/detail/grid_voxelizer.h"
#include "lib/pass/voxelize/detail/scene_passes.h"

namespace bp {

namespace {

/// The work of voxelize_stream() for one scene.
class SceneVoxelizer {
 public:
  SceneVoxelizer(TriangleSource& source, const VoxelizeOptions& options)
      : source_(source),
        options_(options),
        chunks_(options.context.results != nullptr && options.fill != FillMode::winding
                    ? std::make_unique<ChunkedSurface>(*options.context.results, options.context.turn)
                    : nullptr),
        // Three fifths for triangles: their bins, which are half as large, then fit in the rest.
        scene_(source, options.context.memory.bytes / 5 * 3, chunks_.get()) {}

  VoxelizeCounts operator()(const OpenSink& open) {
    const bool guessed = guess_grid();
    measure(guessed);
    const bool sorted = lay_grid(guessed);
    BrickSink& sink = open(header_, counts_);
    if (!sorted) sort_triangles();
    scene_.release();
    grid_->voxelize(counts_);
    grid_->fill_and_emit(sink, counts_);
    counts_.scratch_bytes = grid_->scratch_bytes();
    return counts_;
  }

 private:
  using Portion = ScenePasses::Portion;
  using NextPortion = ScenePasses::NextPortion;
  [[nodiscard]] bool guess_grid();
  void measure(bool guessed);
  bool lay_grid(bool guessed);
  [[nodiscard]] StreamHeader header_of(const Bounds3d& bounds, double off);
  void make_grid();
  void sort_triangles();
  void bin(const NextPortion& next);
  void look_up_chunks();

  TriangleSource& source_;
  const VoxelizeOptions& options_;
  VoxelizeCounts counts_;
  std::unique_ptr<ChunkedSurface> chunks_;  ///< null: none are kept
  ScenePasses scene_;
  StreamHeader header_;
  std::int64_t slack_ = kFixedSlack;  ///< that voxels are grown by; a grid that is guessed does not know it
  std::unique_ptr<GridVoxelizer> grid_;
};

/// Makes a grid for the bounds that the source tells beforehand. If they turn out to be right, the scene is read once.
bool SceneVoxelizer::guess_grid() {
  if (!options_.voxel_by_bounds || chunks_) return false;
  const std::optional<Bounds3d> bounds = source_.bounds();
  if (!bounds) return false;
  try {
    header_ = header_of(*bounds, 0);
    make_grid();
  } catch (const Error&) {  // the error is reported when the bounds are known
    return false;
  }
  return true;
}

void SceneVoxelizer::measure(bool guessed) {
  std::optional<ScenePasses::Sorter> sorter;
  if (guessed) {
    sorter = {header_.bounds, [&](std::span<const TriangleD> triangles) { return grid_->sort(triangles); },
              [&](TriangleBatch&& batch) { grid_->add(std::move(batch)); }};
  }
  scene_.measure(options_.context.progress, sorter);
  counts_.scene = source_.counts();
  counts_.area = scene_.sums().area();
  counts_.extent = scene_.sums().extent();
  counts_.stray = scene_.sums().stray();
  counts_.signed_volume = scene_.sums().volume();
  counts_.input_hash = scene_.input_hash();
}

/// `off`: what points may be off by, scene units.
StreamHeader SceneVoxelizer::header_of(const Bounds3d& bounds, double off) {
  counts_.voxel_asked = options_.voxel_size(bounds);
  const UpAxis up = options_.up ? *options_.up : source_.up().value_or(UpAxis::y);
  return solid_header(bounds, std::max(counts_.voxel_asked, kVoxelsPerOff * off), up, options_);
}

void SceneVoxelizer::make_grid() {
  grid_.reset();  // its memory goes before a new one takes some
  grid_ = std::make_unique<GridVoxelizer>(header_, slack_, options_, chunks_.get());
}

/// Makes the grid of the scene's bounds, unless it was guessed. Returns whether all triangles are in it.
bool SceneVoxelizer::lay_grid(bool guessed) {
  const GridFrame guess = header_.frame;
  const BrickBox guessed_bricks = header_.bricks;
  const double off = counts_.scene.rounding.of(scene_.sums().bounds());
  header_ = header_of(scene_.sums().bounds(), off);
  slack_ = fixed_slack(header_.frame, off);
  const bool sorted =
      guessed && scene_.sorted() && header_.frame == guess && header_.bricks == guessed_bricks && slack_ == kFixedSlack;
  if (!sorted) make_grid();
  if (!sorted && guessed) scene_.read_twice();  // no triangle stayed in memory
  counts_.read_twice = scene_.reads_twice();
  counts_.tiles = grid_->tiles();
  return sorted;
}

void SceneVoxelizer::sort_triangles() {
  if (chunks_) {
    look_up_chunks();
  } else {
    scene_.again([&](const NextPortion& next) { bin(next); });
  }
}

/// Triangles of known chunks are not read again. If all chunks are known, the scene is not read twice.
void SceneVoxelizer::look_up_chunks() {
  chunks_->look_up(header_.frame, slack_, header_.bricks, options_.context.memory.bytes / 10 * 3, grid_->shelf());
  counts_.chunks = chunks_->chunks();
  counts_.chunks_kept = chunks_->kept();
  if (chunks_->complete()) return;
  if (chunks_->needs_met()) scene_.read_twice();
  counts_.read_twice = scene_.reads_twice();
  PassSteps steps(options_.context.progress, "voxelizing", "triangles", counts_.scene.triangles);
  scene_.again([&](const NextPortion& next) {
    const std::uint64_t memory = options_.context.memory.bytes;
    chunks_->add_missing(next, memory / 10, memory / 5 * 3, [&](std::uint64_t n, std::vector<TriangleD>&& large) {
      if (!large.empty()) grid_->add(grid_->sort(large));
      steps.add(n);
    });
  });
  counts_.chunks_kept = chunks_->kept();
}

/// Puts triangles into bricks, or into the bins of their tiles.
void SceneVoxelizer::bin(const NextPortion& next) {
  struct Item {
    Portion portion;
    TriangleBatch batch;
  };
  PassSteps steps(options_.context.progress, "sorting", "triangles", counts_.scene.triangles);
  pipeline<Item>(
      thread_count() + 2, [&](Item& item) { return next(item.portion); },
      [&](Item& item) {
        item.batch = grid_->sort(item.portion.triangles);
        if (scene_.reads_twice()) {
          scene_.give_back(std::move(item.portion.triangles));
        } else {
          std::vector<TriangleD>().swap(item.portion.triangles);
        }
      },
      [&](Item& item) {
        grid_->add(std::move(item.batch));
        steps.add(item.portion.count);
      });
}

}  // namespace

double voxel_size_of(const Bounds3d& bounds, std::int64_t voxels) {
  double side = 0, reach = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    side = std::max(side, bounds.max[i] - bounds.min[i]);
    reach = std::max({reach, std::abs(bounds.min[i]), std::abs(bounds.max[i])});
  }
  // Eight bits: with them the lattice of a few hundred voxels a side, near the origin, fits the 24 bits of a float32
  // (STL).
  if (side > 0) return round_up_to_bits(side / double(voxels), 8);
  return reach > 0 ? reach / (1 << 20) : 1;
}

StreamHeader solid_header(const Bounds3d& bounds, double voxel, UpAxis up, const VoxelizeOptions& options) {
  StreamHeader header;
  header.frame = make_frame(bounds, voxel, up);
  if (options.cell_vox > 0) header.frame = aligned_to_cells(header.frame, bounds, options.cell_vox);
  header.bounds = bounds;
  header.bricks = bricks_of(voxel_bounds(header.frame, bounds));
  header.slab_axis = longest_axis(header.bricks);
  header.fill = options.fill;
  return header;
}

VoxelizeCounts voxelize_stream(TriangleSource& source, const OpenSink& open, const VoxelizeOptions& options) {
  return SceneVoxelizer(source, options)(open);
}

}  // namespace bp
