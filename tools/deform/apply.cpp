#include "tools/deform/apply.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "io/files/file.h"
#include "io/scene/points/scene_points.h"
#include "io/scene/scene_format.h"
#include "io/scene/scene_parts.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/deform/pose.h"
#include "lib/store/content_hash.h"
#include "tools/cli/report.h"

namespace bp {

namespace {

/// The moves of the scene's points, in their order.
class MoveStream {
 public:
  MoveStream(WeightReader& weights, const std::vector<Vec3d>& moves, int in_flight)
      : weights_(weights), moves_(moves), blocks_(std::size_t(in_flight)) {}

  /// Returns the moves of the next n points; fewer at the end.
  std::vector<Vec3d> take(std::size_t n) {
    while (ready_.size() - at_ < n && refill()) {
    }
    n = std::min(n, ready_.size() - at_);
    std::vector<Vec3d> out(ready_.begin() + std::ptrdiff_t(at_), ready_.begin() + std::ptrdiff_t(at_ + n));
    at_ += n;
    return out;
  }

 private:
  /// Reads some blocks of weights, and unpacks them in parallel.
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

/// Returns the faces of a moved cage, including faces that are not finite: moves_of_cage() reports those.
std::vector<TriangleD> faces_of(const MovedCage& cage, const ApplyRequest& request) {
  SceneOptions options = request.scene_options;
  options.pose = cage.pose;
  const IndexedMesh mesh = read_mesh(cage.path, options);
  note_of_cage(mesh, cage.path, request.note);
  std::vector<TriangleD> faces;
  for (const auto& t : mesh.triangles) faces.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return faces;
}

/// Turns the normals and tangents of a batch, in slices; each slice uses the memory of one worker.
void turn(const CageCoordinates& coordinates, const std::vector<Vec3d>& moves, int slices, PointBatch& batch) {
  const std::size_t all = batch.normals.size(), step = (all + std::size_t(slices) - 1) / std::size_t(slices);
  parallel_for(all == 0 ? 0 : slices, [&](std::int64_t slice) {
    const std::size_t first = std::min(all, std::size_t(slice) * step), n = std::min(step, all - first);
    const auto some = [&](std::vector<Vec3d>& total) {
      return total.empty() ? std::span<Vec3d>() : std::span(total).subspan(first, n);
    };
    turn_directions(coordinates, moves, some(batch.positions), some(batch.normals), some(batch.tangents));
  });
}

/// Moves the points of the scene as one moved cage tells.
class CageMover {
 public:
  CageMover(const ApplyRequest& request, const MovedCage& cage, const ScenePoints& scene)
      : request_(request),
        scene_(scene),
        weights_(request.weights),
        coordinates_(make_cage(weights_.header().cage, request.weights), weights_.header().kind),
        moves_(
            coordinates_.moves_of_columns(moves_of_cage(weights_.header().cage, faces_of(cage, request), cage.path))) {
    const std::uint64_t bytes = size_of_files({request.scene}), expected = weights_.header().scene_bytes;
    if (bytes != expected)
      fail(ErrorCode::bad_input, "{}: has {} bytes, and had {} when {} was made of it; bind it again", request.scene,
           bytes, expected, request.weights);
  }
  [[nodiscard]] std::uint64_t expected() const { return weights_.points_declared(); }
  void move(PointBatch& batch) {
    hash_.add(std::as_bytes(std::span(batch.positions)));
    begin();
    turn(coordinates_, moves_, at_work_, batch);
    const std::vector<Vec3d> shifts = stream_->take(batch.positions.size());
    for (std::size_t i = 0; i < shifts.size(); ++i) batch.positions[i] = batch.positions[i] + shifts[i];
    points_ += shifts.size();
  }
  /// Throws bad_input if the scene has changed; returns its number of vertices.
  std::uint64_t finish() {
    begin();
    if (!stream_->take(1).empty() || weights_.totals().points != points_ || weights_.totals().hash != hash_.value())
      fail(ErrorCode::bad_input, "{}: its vertices are not those that {} was made of; bind it again", request_.scene,
           request_.weights);
    return points_;
  }

 private:
  /// Opens the weights when the writing of the scene begins, since only then the memory that the writing takes is
  /// known.
  void begin() {
    if (stream_) return;
    at_work_ = blocks_at_work(request_.memory_bytes, scene_.memory_bytes(), coordinates_);
    stream_.emplace(weights_, moves_, at_work_);
  }

  const ApplyRequest& request_;
  const ScenePoints& scene_;
  WeightReader weights_;
  const CageCoordinates coordinates_;
  const std::vector<Vec3d> moves_;
  int at_work_ = 0;
  std::optional<MoveStream> stream_;
  ContentHash hash_;
  std::uint64_t points_ = 0;
};

}  // namespace

std::string scene_of(const WeightReader& weights, const std::string& path) {
  std::string scene = find_scene(weights.header(), path);
  if (!scene.empty()) return scene;
  fail(ErrorCode::bad_input, "{}: its scene is {}, which is not there; put it there, or bind it again", path,
       (std::filesystem::path(path).parent_path() / weights.header().scene).string());
}

std::vector<MovedCage> moved_cages(std::span<const std::string> paths, const SceneOptions& options,
                                   std::optional<double> per_second) {
  std::vector<MovedCage> cages;
  for (const std::string& path : paths) {
    for (ScenePose& pose : read_poses(path, options, per_second))
      cages.push_back({path, std::make_shared<const ScenePose>(std::move(pose))});
  }
  return cages;
}

Applied apply_cage(const ApplyRequest& request, const MovedCage& cage, OutputFile& out, Progress& progress) {
  const std::unique_ptr<ScenePoints> scene = open_points(request.scene, request.scene_options);
  CageMover mover(request, cage, *scene);
  progress.begin("apply", mover.expected(), "vertices");
  scene->write(
      [&](PointBatch& batch) {
        mover.move(batch);
        progress.add(batch.positions.size());
      },
      out);
  progress.end();
  return {mover.finish(), scene->left_behind()};
}

Applied animate_cages(const ApplyRequest& request, std::span<const MovedCage> cages, double per_second, OutputFile& out,
                      Progress& progress) {
  const std::unique_ptr<ScenePoints> scene = open_points(request.scene, request.scene_options);
  auto mover = std::make_unique<CageMover>(request, cages[0], *scene);
  progress.begin("apply", mover->expected() * cages.size(), "vertices");
  std::size_t at = 0;
  scene->write_frames(
      cages.size(), 1 / per_second,
      [&](std::size_t frame, PointBatch& batch) {
        if (frame != at) {
          (void)mover->finish();
          mover = std::make_unique<CageMover>(request, cages[at = frame], *scene);
        }
        mover->move(batch);
        progress.add(batch.positions.size());
      },
      out);
  progress.end();
  return {mover->finish(), ""};
}

std::string files_left(const std::string& scene, const std::string& written) {
  const std::string from = folder_of(scene) + "/", to = folder_of(written) + "/";
  std::vector<std::string> named;  // files that `written` names; of an OBJ's files each missing one counts
  if (scene_format_of(scene) != "obj") named = parts_of_scene(written);
  std::vector<std::string> left;
  std::error_code unknown;
  for (const std::string& part : parts_of_scene(scene)) {
    if (!part.starts_with(from) || !std::filesystem::exists(part, unknown)) continue;
    const std::string name = part.substr(from.size());
    if (std::filesystem::exists(to + name, unknown) || std::find(left.begin(), left.end(), name) != left.end())
      continue;
    if (scene_format_of(scene) == "obj" || std::find(named.begin(), named.end(), to + name) != named.end())
      left.push_back(name);
  }
  if (left.empty()) return "";
  return fmt::format("names files that are not in its folder; copy them there from {}: {}", folder_of(scene),
                     fmt::join(left, ", "));
}

}  // namespace bp
