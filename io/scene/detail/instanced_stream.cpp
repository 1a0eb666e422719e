#include <algorithm>
#include <mutex>
#include <set>

#include "io/scene/detail/ahead/instanced_bounds.h"
#include "io/scene/detail/instanced/run_decoder.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/pool.h"

namespace bp {

namespace {

/// Returns the bytes that the scene's description leaves for vertices.
std::uint64_t cache_bytes(const InstancedScene& scene, const SceneOptions& options) {
  const std::uint64_t described = scene.memory_bytes();
  if (options.document.bytes == 0) return options.memory_bytes;
  if (described > most_described(options)) {
    const std::uint64_t again = options.document.limit_for(scene.document_bytes);
    throw NeedsMemory(fmt::format("{}: the list of its nodes", scene.bytes->name()), described, most_described(options),
                      std::max(again, limit_of_description(described, options)), {Remedy::split_scene});
  }
  return std::min(options.memory_bytes, 2 * options.memory_bytes - described);
}

class InstancedSource final : public TwoStepSource {
 public:
  InstancedSource(InstancedScene scene, const SceneOptions& options)
      : scene_(std::move(scene)),
        cache_bytes_(cache_bytes(scene_, options) / std::uint64_t(thread_count() + 1)),
        elements_(scene_.bytes, cache_bytes_) {
    rewind();
  }

  bool next(RawBatch& batch) override;
  void complete(RawBatch& batch) const override;
  [[nodiscard]] bool has_colors() const override {
    return std::any_of(scene_.primitives.begin(), scene_.primitives.end(), [](const Primitive& p) {
      return p.colors || p.base_color != std::array<double, 3>{1, 1, 1};
    });
  }
  [[nodiscard]] bool has_textures() const override {
    return std::any_of(scene_.primitives.begin(), scene_.primitives.end(),
                       [](const Primitive& p) { return p.has_image; });
  }
  void rewind() override {
    node_ = instances_ = skewed_ = 0;
    rounding_ = {};
    leaving_.clear();
    bad_faces_ = scene_.bad_faces;
    enter_node();
  }
  [[nodiscard]] std::uint64_t instances() const override { return instances_; }
  [[nodiscard]] Rounding rounding() const override {
    const std::lock_guard lock(mutex_);
    return rounding_;
  }
  [[nodiscard]] std::optional<UpAxis> up() const override { return scene_.up; }
  [[nodiscard]] std::optional<Bounds3d> bounds() override { return bounds_ahead(scene_); }
  [[nodiscard]] std::size_t levels() const override { return scene_.levels; }
  [[nodiscard]] UnreadParts unread() const override { return scene_.unread; }
  [[nodiscard]] std::size_t animations() const override { return scene_.animations; }
  [[nodiscard]] std::uint64_t posed() const override { return scene_.posed; }
  [[nodiscard]] std::uint64_t differing() const override { return scene_.differing; }
  [[nodiscard]] Unfollowed unfollowed() const override {
    Unfollowed all = scene_.unfollowed;
    all.transforms += skewed_;
    const std::lock_guard lock(mutex_);
    for (const std::uint32_t i : leaving_) ++(scene_.primitives[i].moved ? all.hidden : all.culled);
    return all;
  }
  [[nodiscard]] std::uint64_t points() const override { return scene_.points; }
  [[nodiscard]] std::uint64_t lines() const override { return scene_.lines; }

 private:
  [[nodiscard]] std::uint64_t instances_of(const MeshNode& n) const {
    return n.instances ? scene_.arrays[*n.instances].count : 1;
  }
  void enter_node() {
    instance_ = 0;
    if (node_ < scene_.nodes.size()) primitive_ = scene_.nodes[node_].first;
    open_ = false;
  }
  bool enter_primitive();
  void place();
  void count_triangles(const Primitive& p);

  InstancedScene scene_;
  const std::uint64_t cache_bytes_;  // of each reader
  ElementReader elements_;           // for next()
  // The position of the stream.
  std::size_t node_ = 0;
  std::uint64_t instance_ = 0;
  std::uint32_t primitive_ = 0;
  bool open_ = false;  // the members below belong to this primitive in this instance
  std::uint64_t triangle_ = 0, triangles_ = 0;
  std::shared_ptr<const MeshPlace> place_;
  std::uint64_t instances_ = 0, skewed_ = 0;              // skewed_: instances whose rotation is no turn
  mutable Spares<std::unique_ptr<RunDecoder>> decoders_;  // one for each thread that was at work
  mutable std::mutex mutex_;
  mutable Rounding rounding_;
  mutable std::set<std::uint32_t> leaving_;  // primitives that leave the bounds which their file tells
};

/// Finds the triangles of a batch. Their vertices are not read yet.
bool InstancedSource::next(RawBatch& batch) {
  batch.bad_faces = 0;
  batch.triangles.clear();
  batch.colors.clear();
  batch.textures.clear();
  batch.runs.clear();
  for (std::uint64_t left = kBatch; left > 0 && enter_primitive();) {
    const std::uint64_t first = triangle_;
    triangle_ = std::min(triangles_, first + left);
    left -= triangle_ - first;
    batch.runs.push_back({primitive_, place_, first, triangle_});
    if (triangle_ < triangles_) continue;
    ++primitive_;
    open_ = false;
  }
  return !batch.runs.empty();
}

void InstancedSource::complete(RawBatch& batch) const {
  std::unique_ptr<RunDecoder> decoder = decoders_.take();
  if (!decoder) decoder = std::make_unique<RunDecoder>(scene_, cache_bytes_);
  Rounding rounding;
  decoder->decode(batch, rounding);
  const std::vector<std::uint32_t> leaving = decoder->leaving();
  decoders_.give(std::move(decoder));
  const std::lock_guard lock(mutex_);
  rounding_.add(rounding);
  leaving_.insert(leaving.begin(), leaving.end());
}

// Finds the next primitive with triangles, through instances and nodes.
bool InstancedSource::enter_primitive() {
  while (!open_) {
    if (node_ == scene_.nodes.size()) return false;
    const MeshNode& node = scene_.nodes[node_];
    if (instance_ == instances_of(node)) {
      ++node_;
      enter_node();
    } else if (primitive_ == node.end) {
      ++instance_;
      primitive_ = node.first;
    } else {
      if (primitive_ == node.first) place();
      count_triangles(scene_.primitives[primitive_]);
      open_ = triangles_ > 0;
      if (!open_) ++primitive_;
    }
  }
  return true;
}

void InstancedSource::place() {
  const MeshNode& node = scene_.nodes[node_];
  ++instances_;
  MeshPlace place{node.transform};
  if (node.instances) {
    const InstanceArray& a = scene_.arrays[*node.instances];
    const Vec3d t = a.translation.count > 0 ? elements_.vector<3>(a.translation, instance_) : Vec3d{};
    const Vec3d s = a.scale.count > 0 ? elements_.vector<3>(a.scale, instance_) : Vec3d{1, 1, 1};
    std::array<double, 4> q{0, 0, 0, 1};
    if (a.rotation.count > 0) q = elements_.vector<4>(a.rotation, instance_);
    if (!is_unit_rotation(q)) ++skewed_;
    place.transform = place.transform * affine_of(t, q, s);
  }
  place.mirrors = place.transform.mirrors();
  place.stays = place.transform.m == Affine().m && !place.transform.off.any();
  place_ = std::make_shared<const MeshPlace>(std::move(place));
}

void InstancedSource::count_triangles(const Primitive& p) {
  const std::uint64_t n = p.indices ? p.indices->count : p.positions.count;
  triangles_ = p.mode == Primitive::Mode::triangles ? n / 3 : n < 3 ? 0 : n - 2;
  triangle_ = 0;
  if (p.mode == Primitive::Mode::triangles ? n % 3 != 0 : n == 1 || n == 2) ++bad_faces_;
}

}  // namespace

RawSourcePtr stream_instances(InstancedScene scene, const SceneOptions& options) {
  return std::make_unique<InstancedSource>(std::move(scene), options);
}

}  // namespace bp
