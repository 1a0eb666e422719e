#include "tools/deform/bind.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "io/scene/points/scene_points.h"
#include "io/scene/scene_pose.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/pool.h"
#include "lib/store/content_hash.h"
#include "tools/cli/common_options.h"
#include "tools/cli/names.h"
#include "tools/cli/report.h"
#include "tools/run/make_backend.h"
#include "tools/run/memory_shares.h"

namespace bp {

namespace {

/// A block of points between reading and writing.
struct Block {
  std::vector<Vec3d> points;
  std::uint64_t expected = 0;                    // points in the whole scene
  std::uint64_t outside = 0, first_outside = 0;  // first_outside: number within the block, if outside > 0
  Vec3d place{};                                 // place of the first point outside
  PackedWeights packed;
};

/// Cuts batches of points into blocks.
class BlockCutter {
 public:
  BlockCutter(ScenePoints& points, std::size_t size) : points_(points), size_(size) {}

  bool next(Block& block) {
    std::vector<Vec3d>& out = block.points;
    while (out.size() < size_) {
      if (at_ == batch_.size() && !refill()) break;
      const std::size_t n = std::min(size_ - out.size(), batch_.size() - at_);
      out.insert(out.end(), batch_.begin() + std::ptrdiff_t(at_), batch_.begin() + std::ptrdiff_t(at_ + n));
      at_ += n;
    }
    block.expected = points_.count();
    return !out.empty();
  }
  [[nodiscard]] ResultKey hash() const { return hash_.value(); }

 private:
  bool refill() {
    at_ = 0;
    const bool more = points_.read(batch_);
    hash_.add(std::as_bytes(std::span(batch_)));
    return more;
  }
  ScenePoints& points_;
  const std::size_t size_;
  std::vector<Vec3d> batch_;
  std::size_t at_ = 0;
  ContentHash hash_;
};

void work_on(Pool<Backend*>& backends, const CageCoordinates& coordinates, bool carry_outside, Block& block) {
  const std::size_t n = block.points.size();
  WeightBlock weights(n, coordinates.columns());
  std::vector<CoordinateRows::Place> places(n);
  {
    const Pool<Backend*>::Lease backend(backends);
    backend->weigh(coordinates, block.points, carry_outside, weights, places);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (places[i] != CoordinateRows::Place::outside || block.outside++ > 0) continue;
    block.first_outside = i;
    block.place = block.points[i];
  }
  if (block.outside == 0 || carry_outside) pack_weights(weights, block.packed);
}

/// Returns about how many seconds one core needs for the coordinates of a scene; 0 if blocks have too few points for a
/// GPU.
double core_seconds(const CageCoordinates& coordinates, std::uint64_t points) {
  constexpr double kPerFace = 1e-8;
  constexpr std::size_t kFewPoints = 256;
  const double kind = coordinates.kind() == CoordinateKind::mean_value ? 1 : 2;
  if (points_of_block(coordinates.columns()) < kFewPoints) return 0;
  return kPerFace * kind * double(coordinates.cage().faces.size()) * double(points);
}

/// Adds up counts, and remembers the first point outside the cage.
struct Tally {
  WeightTotals totals;
  std::uint64_t first = 0;
  Vec3d place{};

  void add(const Block& block) {
    if (block.outside > 0 && totals.outside == 0) first = totals.points + block.first_outside, place = block.place;
    totals.points += block.points.size();
    totals.outside += block.outside;
  }
};

std::vector<Backend*> pointers_to(const Backends& backends) {
  std::vector<Backend*> out;
  for (const auto& backend : backends) out.push_back(backend.get());
  return out;
}

constexpr const char* kSceneFirst = "bind takes the scene first, and then the cage";

/// Returns true if the cage's file is larger than the scene's: then the two were probably swapped.
bool seems_swapped(const BindRequest& request) {
  return size_of_files({request.cage}) > size_of_files({request.scene});
}

IndexedMesh read_cage(const BindRequest& request) {
  try {
    SceneOptions options = request.scene_options;
    ScenePose pose;
    pose.base = true;  // a cage's morph targets are poses for apply
    options.pose = std::make_shared<const ScenePose>(std::move(pose));
    IndexedMesh mesh = read_mesh(request.cage, options);
    (void)make_cage(mesh, request.cage);
    note_of_cage(mesh, request.cage, request.note);
    return mesh;
  } catch (const Error& e) {
    if (!seems_swapped(request)) throw;
    fail(ErrorCode::bad_input, "{}; {}, and {} is larger than {}", e.what(), kSceneFirst, request.cage, request.scene);
  }
}

[[noreturn]] void refuse_outside(const BindRequest& request, const Tally& tally) {
  const bool swapped = tally.totals.outside == tally.totals.points && seems_swapped(request);
  fail(ErrorCode::bad_input, "{}: vertices outside {}: {} of {}, the first is number {} at {:.6g},{:.6g},{:.6g}; {}",
       request.scene, request.cage, tally.totals.outside, tally.totals.points, tally.first + 1, tally.place[0],
       tally.place[1], tally.place[2], swapped ? kSceneFirst : "use a larger cage, or --outside near");
}

std::uint64_t block_bytes(const CageCoordinates& coordinates) {
  const std::size_t columns = coordinates.columns();
  return 24 * points_of_block(columns) * columns + coordinates.bytes_at_once();
}

/// Returns the memory that is needed in addition to blocks, bytes. `held`: bytes in use; the scene's description is
/// among them.
std::uint64_t fixed_bytes(std::uint64_t held, const CageCoordinates& coordinates) {
  constexpr std::uint64_t kPerFace = 512;  // for a cage: its vertices, edges, tables and hierarchy
  return least_memory(0) + held + kPerFace * coordinates.cage().faces.size();
}

/// Returns the name of a file relative to the folder of another; an absolute name stays.
std::string name_from(const std::string& from, const std::string& file) {
  const std::filesystem::path folder = std::filesystem::absolute(from).parent_path();
  if (std::filesystem::path(file).is_absolute()) return file;
  return std::filesystem::proximate(file, folder).string();
}

}  // namespace

/// Poses and morph targets of a glTF are not reported as lost: they move the cage.
void note_of_cage(const IndexedMesh& cage, const std::string& path, const NoteOfCage& note) {
  SceneCounts counts;
  counts.bad_faces = cage.bad_faces, counts.differing = cage.differing, counts.unfollowed = cage.unfollowed;
  if (const std::string text = skipped(counts); !text.empty()) note(path + ": " + text);
}

std::uint64_t limit_for_blocks(std::uint64_t held, const CageCoordinates& coordinates) {
  return fixed_bytes(held, coordinates) + block_bytes(coordinates);
}

int blocks_at_work(std::uint64_t memory_bytes, std::uint64_t held, const CageCoordinates& coordinates) {
  const std::uint64_t block = block_bytes(coordinates), fixed = fixed_bytes(held, coordinates);
  const std::uint64_t left = memory_bytes > fixed ? memory_bytes - fixed : 0;
  if (left < block) throw NeedsMemory("a block of weights", block, left, fixed + block);
  return int(std::clamp<std::uint64_t>(left / block, 1, 2 * std::uint64_t(thread_count())));
}

WeightTotals bind_scene(const BindRequest& request, OutputFile& out, Progress& progress) {
  constexpr std::uint64_t kBytesPerPoint = 100;  // for an OBJ, which does not tell its number of vertices
  const WeightHeader header{name_from(request.weights, request.scene), size_of_files({request.scene}),
                            read_cage(request), request.kind};
  const CageCoordinates coordinates(make_cage(header.cage, request.cage), request.kind);
  const std::unique_ptr<ScenePoints> points = open_points(request.scene, request.scene_options);
  const std::uint64_t expected = points->count() > 0 ? points->count() : header.scene_bytes / kBytesPerPoint;
  const Backends& backends = request.backends(core_seconds(coordinates, expected));
  Pool<Backend*> pool(pointers_to(backends));
  BlockCutter cutter(*points, points_of_block(coordinates.columns()));
  WeightWriter writer(out, header);
  Tally tally;
  progress.begin("bind", 0, "vertices");
  pipeline<Block>(
      blocks_at_work(unpinned(request.memory_bytes, pinned_bytes(backends)), points->memory_bytes(), coordinates),
      [&](Block& block) { return cutter.next(block); },
      [&](Block& block) { work_on(pool, coordinates, request.carry_outside, block); },
      [&](Block& block) {
        tally.add(block);
        if (tally.totals.outside == 0 || request.carry_outside) writer.write(block.packed);
        progress.set(tally.totals.points, std::max(block.expected, tally.totals.points));
      });
  progress.end();
  if (tally.totals.outside > 0 && !request.carry_outside) refuse_outside(request, tally);
  tally.totals.hash = cutter.hash();
  writer.finish(tally.totals);
  return tally.totals;
}

}  // namespace bp
