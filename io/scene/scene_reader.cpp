#include "io/scene/scene_reader.h"

#include <algorithm>
#include <cmath>

#include "io/scene/detail/degenerate.h"
#include "io/scene/detail/foreign_format.h"
#include "io/scene/detail/open_raw.h"
#include "io/scene/detail/position_index.h"
#include "io/scene/raw_source.h"
#include "io/scene/scene_format.h"
#include "io/scene/scene_pose.h"
#include "lib/core/error.h"
#include "lib/core/packed_normal.h"
#include "lib/core/parallel.h"
#include "lib/exact/predicates.h"
#include "lib/place/scene_map.h"

namespace bp {

namespace {

bool in_predicate_domain(const TriangleD& t) {
  return bp::in_predicate_domain(t[0]) && bp::in_predicate_domain(t[1]) && bp::in_predicate_domain(t[2]);
}

/// Checks the limit for a mesh read so far. Counts all remaining triangles, so that the error has the right figure.
void check_limit(const std::string& name, const MeshLimit& limit, std::uint64_t before, const IndexedMesh& mesh,
                 RawSource& raw, RawBatch& batch) {
  const std::uint64_t here = mesh.triangles.size();
  if (limit.memory.bytes == 0 || here == 0 || before + limit.needed(here, mesh.vertices.size()) <= limit.memory.bytes)
    return;
  std::uint64_t all = here;
  while (raw.next(batch)) {
    raw.complete(batch);
    all += batch.triangles.size();
  }
  // The same number for each triangle.
  const double vertices = double(mesh.vertices.size()) / double(here) * double(all);
  const std::uint64_t bytes = before + limit.needed(all, std::uint64_t(vertices));
  throw NeedsMemory(fmt::format("{}: {} {} triangles", name, limit.purpose, all), bytes, limit.memory.bytes,
                    limit.memory.limit_with(bytes - limit.memory.bytes));
}

/// Reads a mesh. `before`: bytes of levels that are in memory.
IndexedMesh mesh_of(const std::string& name, RawSource& raw, const SceneOptions& options, std::uint64_t before,
                    SceneCounts& met) {
  const bool keep_extremes = options.keep_extremes;
  IndexedMesh mesh;
  PositionIndex index(mesh.vertices);
  RawBatch batch;
  while (raw.next(batch)) {
    raw.complete(batch);
    met.bad_faces += batch.bad_faces;
    if (!batch.inner_edges.empty()) mesh.inner_edges.resize(mesh.triangles.size());
    mesh.inner_edges.insert(mesh.inner_edges.end(), batch.inner_edges.begin(), batch.inner_edges.end());
    for (TriangleD& t : batch.triangles) {
      keep_extremes ? drop_signs_of_zeros(t) : normalize(t);
      if (!is_finite(t)) {
        ++met.non_finite;
      } else if (in_predicate_domain(t) && is_degenerate(t)) {
        ++met.degenerate;
      }
      mesh.triangles.push_back({index.add(t[0]), index.add(t[1]), index.add(t[2])});
    }
    check_limit(name, options.mesh, before, mesh, raw, batch);
  }
  mesh.up = raw.up();
  mesh.rounding = raw.rounding();
  met.triangles = mesh.triangles.size();
  met.kept_degenerate = met.degenerate;
  met.bad_faces += raw.bad_faces();
  met.differing = raw.differing();
  met.unfollowed = raw.unfollowed();
  met.instances = raw.instances();
  mesh.bad_faces = met.bad_faces, mesh.differing = met.differing, mesh.unfollowed = met.unfollowed;
  met.rounding = raw.rounding();
  return mesh;
}

std::size_t batches_in(std::uint64_t memory_bytes) {
  constexpr std::uint64_t kBatchBytes = RawSource::kBatch * (sizeof(TriangleD) + 16);
  const auto wanted = std::uint64_t(thread_count() > 1 ? 2 * thread_count() : 1);
  return std::size_t(std::clamp<std::uint64_t>(memory_bytes / 2 / kBatchBytes, 1, wanted));
}

/// Returns whether no coordinate is zero, tiny, huge or NaN: then nothing must be normalized or checked.
bool is_plain(const TriangleD& t) {
  bool plain = true;
  for (const Vec3d& p : t) {
    for (const double c : p) plain &= std::abs(c) >= 1e-90 && std::abs(c) <= 1e90;
  }
  return plain;
}

/// Moves a batch. Returns its largest coordinate before.
double move(const SceneMap& map, const std::optional<UpAxis>& up, RawBatch& batch) {
  double largest = 0;
  for (const TriangleD& t : batch.triangles) {
    for (const Vec3d& p : t) {
      for (const double c : p) largest = std::isfinite(c) ? std::max(largest, std::abs(c)) : largest;
    }
  }
  map.move(batch.triangles, up);
  for (TriangleTexture& texture : batch.textures) {
    for (PackedNormal& n : texture.normals) n = n == 0 ? n : pack_normal(map.normal(unpack_normal(n), up));
  }
  return largest;
}

/// Returns what a bound on the coordinates of the file, which are at most `largest`, means for those after the map.
/// They are smaller, so a share of them would be too little.
Rounding mapped(const SceneMap& map, const Rounding& of_file, double largest) {
  if (!of_file.any()) return of_file;
  const double bound = map.stretch() * of_file.of(largest);
  return {0, bound, bound};
}

/// Drops the triangles that are not good, and returns the counts of all.
SceneCounts keep_good(RawBatch& batch, bool keep_degenerate, bool keep_extremes) {
  std::vector<TriangleD>& triangles = batch.triangles;
  if (batch.colored) batch.colors.resize(triangles.size());
  if (batch.textured) batch.textures.resize(triangles.size());
  if (!batch.inner_edges.empty()) batch.inner_edges.resize(triangles.size());
  SceneCounts counts;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    TriangleD& t = triangles[i];
    const bool plain = is_plain(t);
    if (!plain) keep_extremes ? drop_signs_of_zeros(t) : normalize(t);
    if (!plain && !is_finite(t)) {
      ++counts.non_finite;
      continue;
    }
    // Beyond the domain of the predicates, whether there is area cannot be decided; a caller that keeps extremes can
    // handle these.
    const bool degenerate = (plain || in_predicate_domain(t)) && is_degenerate(t);
    if (degenerate) ++counts.degenerate;
    if (degenerate && !keep_degenerate) continue;
    if (degenerate) ++counts.kept_degenerate;
    if (batch.colored) batch.colors[kept] = batch.colors[i];
    if (batch.textured) batch.textures[kept] = batch.textures[i];
    if (!batch.inner_edges.empty()) batch.inner_edges[kept] = batch.inner_edges[i];
    if (kept != i) triangles[kept] = t;
    ++kept;
  }
  triangles.resize(kept);
  if (batch.colored) batch.colors.resize(kept);
  if (batch.textured) batch.textures.resize(kept);
  counts.triangles = kept;
  return counts;
}

/// Drops and counts triangles without area or with coordinates that are not finite. Batches are decoded and sifted in
/// parallel, some ahead of the caller.
class FilteredScene final : public TriangleSource {
 public:
  FilteredScene(std::string name, RawSourcePtr raw, const SceneOptions& options)
      : name_(std::move(name)),
        raw_(std::move(raw)),
        keep_degenerate_(options.keep_degenerate),
        keep_extremes_(options.keep_extremes),
        some_parts_(!options.parts.empty()),
        map_(options.map),
        batches_(batches_in(options.memory_bytes)) {}

  bool read(std::vector<TriangleD>& out) override {
    const bool more = read_batch(false);
    out.swap(batch_->triangles);
    return more;
  }
  bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) override {
    const bool more = read_batch(true);
    out.swap(batch_->triangles);
    colors.swap(batch_->colors);
    return more;
  }
  bool read_textured(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                     std::vector<TriangleTexture>& textures) override {
    const bool more = read_batch(true, true);
    out.swap(batch_->triangles);
    colors.swap(batch_->colors);
    textures.swap(batch_->textures);
    return more;
  }
  bool read_faces(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                  std::vector<std::uint8_t>& inner_edges) override {
    const bool more = read_colored(out, colors);
    inner_edges.swap(batch_->inner_edges);
    inner_edges.resize(out.size());
    return more;
  }
  [[nodiscard]] bool has_colors() const override { return raw_->has_colors(); }
  [[nodiscard]] bool has_textures() const override { return raw_->has_textures(); }
  void rewind() override {
    raw_->rewind();
    counts_ = {};
    next_ = ready_ = 0;
    bad_faces_ = 0;
    largest_ = 0;
  }
  [[nodiscard]] const SceneCounts& counts() const override { return counts_; }
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::optional<Bounds3d> bounds() override { return map_ ? std::nullopt : raw_->bounds(); }
  [[nodiscard]] std::optional<UpAxis> up() const override { return map_ ? map_->up() : raw_->up(); }

 private:
  struct Batch {
    RawBatch raw;
    SceneCounts counts;  // counts of its triangles
    double largest = 0;  // coordinate before the map
  };

  /// Sets batch_ to the next one with triangles; at the end returns false and sets an empty one.
  bool read_batch(bool colored, bool textured = false) {
    batch_ = &end_;
    end_.triangles.clear();
    end_.colors.clear();
    end_.textures.clear();
    end_.inner_edges.clear();
    while (batch_->triangles.empty() && (next_ < ready_ || fetch(colored, textured))) {
      Batch& batch = batches_[next_++];
      batch_ = &batch.raw;
      counts_.add(batch.counts);
      largest_ = std::max(largest_, batch.largest);
    }
    counts_.bad_faces = raw_->bad_faces() + bad_faces_;
    counts_.instances = raw_->instances();
    counts_.animations = raw_->animations();
    counts_.posed = raw_->posed();
    counts_.differing = raw_->differing();
    counts_.unfollowed = raw_->unfollowed();
    counts_.rounding = map_ ? mapped(*map_, raw_->rounding(), largest_) : raw_->rounding();
    const SceneCounts& c = counts_;  // at the end; somebody who names a file of points wants them enclosed
    if (!some_parts_ && batch_->triangles.empty() && c.triangles + c.degenerate + c.non_finite + c.bad_faces == 0 &&
        raw_->points() + raw_->lines() > 0)
      refuse_points(name_, raw_->points(), raw_->lines());
    return !batch_->triangles.empty();
  }

  bool fetch(bool colored, bool textured) {
    next_ = ready_ = 0;
    while (ready_ < batches_.size()) {
      RawBatch& batch = batches_[ready_].raw;
      batch.colored = colored;
      batch.textured = textured;
      batch.colors.clear();
      batch.textures.clear();
      batch.inner_edges.clear();
      if (!raw_->next(batch)) break;
      ++ready_;
    }
    const std::optional<UpAxis> up = raw_->up();
    parallel_for(std::int64_t(ready_), [&](std::int64_t i) {
      Batch& batch = batches_[std::size_t(i)];
      raw_->complete(batch.raw);
      if (map_) batch.largest = move(*map_, up, batch.raw);
      batch.counts = keep_good(batch.raw, keep_degenerate_, keep_extremes_);
    });
    for (std::size_t i = 0; i < ready_; ++i) bad_faces_ += batches_[i].raw.bad_faces;
    return ready_ > 0;
  }

  std::string name_;
  RawSourcePtr raw_;
  bool keep_degenerate_, keep_extremes_, some_parts_;
  std::shared_ptr<const SceneMap> map_;  // null: nothing moves
  SceneCounts counts_;
  std::vector<Batch> batches_;
  RawBatch end_;  // an empty batch
  RawBatch* batch_ = &end_;
  std::size_t next_ = 0, ready_ = 0;  // range in batches_
  std::uint64_t bad_faces_ = 0;       // found by complete()
  double largest_ = 0;                // coordinate before the map
};

}  // namespace

std::unique_ptr<TriangleSource> filtered(std::string name, RawSourcePtr raw, const SceneOptions& options) {
  return std::make_unique<FilteredScene>(std::move(name), std::move(raw), options);
}

std::unique_ptr<TriangleSource> open_scene(const std::string& path, const SceneOptions& options) {
  return filtered(path == "-" ? "stdin" : path, open_raw(path, options), options);
}

void check_stdin_once(const std::vector<std::string>& paths) {
  if (std::count(paths.begin(), paths.end(), "-") > 1)
    fail(ErrorCode::bad_argument, "stdin (-) is named twice, and can be read once");
}

IndexedMesh mesh_of(const std::string& name, RawSource& raw, const SceneOptions& options, SceneCounts& counts) {
  return mesh_of(name, raw, options, 0, counts);
}

IndexedMesh read_mesh(const std::string& path, const SceneOptions& options, SceneCounts* counts) {
  SceneCounts met;
  IndexedMesh mesh = mesh_of(path, *open_raw(path, options), options, met);
  if (counts != nullptr) *counts = met;
  return mesh;
}

std::vector<ScenePose> read_poses(const std::string& path, const SceneOptions& options,
                                  std::optional<double> per_second) {
  const std::string format = scene_format_of(path);
  if (format != "gltf" && format != "glb") return std::vector<ScenePose>(1);
  return gltf_poses(open_scene_file(path, temp_dir_of(options)), options, per_second);
}

std::vector<IndexedMesh> read_levels(const std::string& path, const SceneOptions& options) {
  const SceneFilePtr file = open_scene_or_mesh(path, options);  // stdin can be opened only once
  std::vector<IndexedMesh> levels;
  SceneOptions one = options;
  std::size_t count = 1;
  std::uint64_t bytes = 0;
  for (one.level = 0; one.level < count; ++one.level) {
    const RawSourcePtr raw = open_raw(file, path, one);
    count = raw->levels();
    constexpr std::size_t kMost = 64;  // each of them is read separately
    if (count > kMost) fail(ErrorCode::bad_input, "{}: {} levels, and at most {} are read", path, count, kMost);
    SceneCounts ignored;
    levels.push_back(mesh_of(path, *raw, one, bytes, ignored));
    bytes += options.mesh.needed(levels.back().triangles.size(), levels.back().vertices.size());
  }
  return levels;
}

}  // namespace bp
