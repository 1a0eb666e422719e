#include "tools/deform/apply.h"

#include <algorithm>

#include "io/scene/points/scene_points.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/deform/pose.h"
#include "lib/store/content_hash.h"
#include "tools/cli/report.h"
#include "tools/deform/bind.h"

namespace bp {

namespace {

/// By how much the points of the scene move, in their order.
class MoveStream {
 public:
  MoveStream(WeightReader& weights, const std::vector<Vec3d>& moves, int in_flight)
      : weights_(weights), moves_(moves), blocks_(std::size_t(in_flight)) {}

  /// The next n; fewer at the end.
  std::vector<Vec3d> take(std::size_t n) {
    while (ready_.size() - at_ < n && refill()) {
    }
    n = std::min(n, ready_.size() - at_);
    std::vector<Vec3d> out(ready_.begin() + std::ptrdiff_t(at_), ready_.begin() + std::ptrdiff_t(at_ + n));
    at_ += n;
    return out;
  }

 private:
  /// Reads some blocks, and unpacks them at once.
  bool refill() {
    ready_.erase(ready_.begin(), ready_.begin() + std::ptrdiff_t(at_));
    at_ = 0;
    std::size_t count = 0, points = ready_.size();
    std::vector<std::size_t> begins;
    for (; count < blocks_.size() && weights_.next(blocks_[count]); ++count) {
      begins.push_back(points);
      points += blocks_[count].points;
    }
    ready_.resize(points);
    parallel_for(std::int64_t(count), [&](std::int64_t i) {
      WeightBlock block;
      weights_.unpack(blocks_[std::size_t(i)], block);
      add_moves(block, moves_, std::span(ready_).subspan(begins[std::size_t(i)], block.points));
    });
    return count > 0;
  }
  WeightReader& weights_;
  const std::vector<Vec3d>& moves_;
  std::vector<PackedWeights> blocks_;
  std::vector<Vec3d> ready_;
  std::size_t at_ = 0;
};

std::vector<TriangleD> faces_of(const std::string& path, SceneOptions options) {
  options.keep_degenerate = true;
  std::vector<TriangleD> all, some;
  const std::unique_ptr<TriangleSource> source = open_scene(path, options);
  while (source->read(some)) {
    all.insert(all.end(), some.begin(), some.end());
    if (all.size() > kMostCageTriangles)
      fail(ErrorCode::bad_input, "{}: has more than {} triangles, and is no cage", path, kMostCageTriangles);
  }
  return all;
}

void turn(const MeanValueCoordinates& coordinates, const std::vector<Vec3d>& moves, PointBatch& batch) {
  constexpr std::int64_t kGrain = 512;
  parallel_ranges(std::int64_t(batch.normals.size()), kGrain, [&](std::int64_t begin, std::int64_t end) {
    const auto first = std::size_t(begin), n = std::size_t(end - begin);
    const auto some = [&](std::vector<Vec3d>& all) {
      return all.empty() ? std::span<Vec3d>() : std::span(all).subspan(first, n);
    };
    turn_directions(coordinates, moves, some(batch.positions), some(batch.normals), some(batch.tangents));
  });
}

void check_scene(const WeightReader& weights, const std::string& path) {
  const WeightHeader& header = weights.header();
  const std::uint64_t bytes = size_of_files({header.scene});
  if (bytes != header.scene_bytes)
    fail(ErrorCode::bad_input, "{}: has {} bytes, and had {} when {} was made of it; bind it again", header.scene,
         bytes, header.scene_bytes, path);
}

}  // namespace

Applied apply_cage(WeightReader& weights, const ApplyRequest& request, OutputFile& out, Progress& progress) {
  const WeightHeader& header = weights.header();
  const std::unique_ptr<ScenePoints> scene = open_points(header.scene, request.scene_options);
  check_scene(weights, request.weights);
  const std::vector<Vec3d> moves =
      moves_of_cage(header.cage, faces_of(request.cage, request.scene_options), request.cage);
  const MeanValueCoordinates coordinates(make_cage(header.cage, request.weights));
  MoveStream stream(weights, moves, blocks_at_work(request.memory_bytes, moves.size()));
  Applied applied;
  ContentHash hash;
  progress.begin("apply", 0, "vertices");
  scene->write(
      [&](PointBatch& batch) {
        hash.add(std::as_bytes(std::span(batch.positions)));
        turn(coordinates, moves, batch);
        const std::vector<Vec3d> shifts = stream.take(batch.positions.size());
        for (std::size_t i = 0; i < shifts.size(); ++i) batch.positions[i] = batch.positions[i] + shifts[i];
        applied.points += shifts.size();
        progress.add(shifts.size());
      },
      out);
  progress.end();
  if (!stream.take(1).empty() || weights.totals().points != applied.points || weights.totals().hash != hash.value())
    fail(ErrorCode::bad_input, "{}: its vertices are not those that {} was made of; bind it again", header.scene,
         request.weights);
  applied.left_behind = scene->left_behind();
  return applied;
}

}  // namespace bp
