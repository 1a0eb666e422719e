#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/gltf/detail/data_uri.h"
#include "io/gltf/detail/gltf_copy.h"
#include "io/gltf/detail/gltf_sketch.h"
#include "io/gltf/detail/gltf_vertices.h"
#include "io/scene/points/scene_points.h"
#include "lib/core/vec3.h"

// glTF and GLB: the accessors POSITION, NORMAL and TANGENT of every mesh that a node shows are written anew, as are the
// bounds of POSITION in the JSON. They stay in their places; a mesh in several places gets copies at the end of the
// first buffer. Files with vertices that cannot follow are refused (gltf_vertices.cpp).

namespace bp {

namespace {

using detail::GltfVertices;

Vec3d linear(const Affine& a, const Vec3d& v) {
  return {a.m[0][0] * v[0] + a.m[0][1] * v[1] + a.m[0][2] * v[2],
          a.m[1][0] * v[0] + a.m[1][1] * v[1] + a.m[1][2] * v[2],
          a.m[2][0] * v[0] + a.m[2][1] * v[1] + a.m[2][2] * v[2]};
}

Vec3d transposed(const Affine& a, const Vec3d& v) {
  return {a.m[0][0] * v[0] + a.m[1][0] * v[1] + a.m[2][0] * v[2],
          a.m[0][1] * v[0] + a.m[1][1] * v[1] + a.m[2][1] * v[2],
          a.m[0][2] * v[0] + a.m[1][2] * v[1] + a.m[2][2] * v[2]};
}

Vec3d unit(const Vec3d& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : v;
}

class GltfPoints final : public ScenePoints {
 public:
  GltfPoints(SceneFilePtr file, const SceneOptions& options)
      : file_(std::move(file)), options_(options), doc_(file_, options_) {
    detail::check_container(*file_);
    plan_ = detail::plan_of_vertices(doc_, file_->name(), options_);
  }
  bool read(std::vector<Vec3d>& out) override {
    out.clear();
    for (; at_ < plan_.vertices.size(); ++at_, first_ = 0) {
      const GltfVertices& v = plan_.vertices[at_];
      const auto n = std::size_t(std::min<std::uint64_t>(kBatch, v.position.count - first_));
      if (n == 0) continue;
      take(*doc_.bytes(), v.position, first_, n, out);
      for (Vec3d& p : out) p = v.to_world(p);
      first_ += n;
      return true;
    }
    return false;
  }
  [[nodiscard]] std::uint64_t count() const override {
    std::uint64_t sum = 0;
    for (const GltfVertices& v : plan_.vertices) sum += v.position.count;
    return sum;
  }
  [[nodiscard]] std::uint64_t memory_bytes() const override {
    return doc_.memory_bytes() + plan_.memory_bytes() + copy_bytes_;
  }
  void write(const MovePoints& move, OutputFile& out) override {
    detail::GltfCopy copy = copy_of_file();
    copy.plan_copies(plan_);
    copy_bytes_ = copy.memory_bytes();
    const std::vector<GltfVertices> targets = targets_in(copy);
    for (const GltfVertices& v : targets) {
      Bounds3d bounds;
      for (std::uint64_t first = 0; first < v.position.count; first += kBatch)
        write_batch(v, first, std::size_t(std::min<std::uint64_t>(kBatch, v.position.count - first)), move, copy,
                    bounds);
      copy.set_bounds(v.numbers[0] - 1, bounds);
    }
    copy.write(out);
  }
  void write_frames(std::size_t frames, double seconds, const MoveFrame& move, OutputFile& out) override;

 private:
  [[nodiscard]] detail::GltfCopy copy_of_file() {
    const std::uint64_t bytes = plan_.vertices.empty() ? 0 : doc_.root().item("buffers", 0).number("byteLength");
    return {file_, *doc_.bytes(), std::min(bytes, doc_.bytes()->size()), doc_.memory_bytes() + plan_.memory_bytes(),
            options_};
  }
  [[nodiscard]] std::vector<GltfVertices> targets_in(detail::GltfCopy& copy);
  void append(detail::GltfCopy& copy, Accessor& accessor, std::uint64_t& number);
  /// Moves some vertices. Returns them in the scene; `local` gets them in their nodes, before and after.
  PointBatch move_batch(const GltfVertices& v, std::uint64_t first, std::size_t n, const MovePoints& move,
                        const detail::GltfCopy& copy, PointBatch& local);
  std::vector<float> changes_of(const GltfVertices& v, std::uint64_t first, std::size_t n, const MovePoints& move,
                                const detail::GltfCopy& copy, Bounds3d& bounds);
  void write_batch(const GltfVertices& v, std::uint64_t first, std::size_t n, const MovePoints& move,
                   detail::GltfCopy& copy, Bounds3d& bounds);
  /// Reads the first three components; the bytes stay in bytes_.
  template <class File>
  void take(const File& file, const Accessor& a, std::uint64_t first, std::size_t n, std::vector<Vec3d>& out) {
    bytes_.resize((n - 1) * a.stride + 4 * a.components);
    file.read_at(a.address + first * a.stride, std::span(bytes_));
    out.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      std::array<float, 3> values;
      std::memcpy(values.data(), bytes_.data() + i * a.stride, sizeof values);
      out[i] = {values[0], values[1], values[2]};
    }
  }
  /// Writes elements that take() read. Values that stay keep their bytes.
  void put(detail::GltfCopy& copy, const Accessor& a, std::uint64_t first, const std::vector<Vec3d>& values) {
    take(copy, a, first, values.size(), scratch_);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::array<float, 3> now{float(values[i][0]), float(values[i][1]), float(values[i][2])};
      if (values[i] != scratch_[i]) std::memcpy(bytes_.data() + i * a.stride, now.data(), sizeof now);
    }
    copy.write_at(a.address + first * a.stride, bytes_);
  }

  SceneFilePtr file_;
  const SceneOptions options_;
  GltfDocument doc_;
  detail::GltfPlan plan_;
  std::size_t at_ = 0;
  std::uint64_t first_ = 0, copy_bytes_ = 0;
  std::vector<std::byte> bytes_;
  std::vector<Vec3d> scratch_;
};

/// Returns the places to which all vertices are written. Copies get accessors at the end of the buffer, which their
/// primitives name.
std::vector<GltfVertices> GltfPoints::targets_in(detail::GltfCopy& copy) {
  std::vector<GltfVertices> targets = plan_.vertices;
  for (GltfVertices& v : targets) {
    if (!v.is_copy) continue;
    append(copy, v.position, v.numbers[0]);
    if (v.normal) append(copy, *v.normal, v.numbers[1]);
    if (v.tangent) append(copy, *v.tangent, v.numbers[2]);
  }
  for (const bool own_mesh : {true, false}) {  // meshes are copied before they change
    for (const detail::GltfEdit& e : plan_.edits) {
      if (e.own_mesh != own_mesh) continue;
      const std::uint64_t mesh = own_mesh ? copy.mesh_of_its_own(e.node, e.mesh) : e.mesh;
      copy.set_accessors(mesh, e.primitive, targets[e.vertices].numbers);
    }
  }
  return targets;
}

void GltfPoints::append(detail::GltfCopy& copy, Accessor& a, std::uint64_t& number) {
  const std::size_t size = 4 * a.components;
  const std::uint64_t address = copy.size();
  std::vector<std::byte> packed;
  for (std::uint64_t first = 0; first < a.count; first += kBatch) {
    const auto n = std::size_t(std::min<std::uint64_t>(kBatch, a.count - first));
    bytes_.resize((n - 1) * a.stride + size);
    doc_.bytes()->read_at(a.address + first * a.stride, bytes_);
    packed.resize(n * size);
    for (std::size_t i = 0; i < n; ++i) std::memcpy(packed.data() + i * size, bytes_.data() + i * a.stride, size);
    copy.append(packed);
  }
  a.address = address;
  a.stride = size;
  number = copy.add_accessor(number - 1, address, a.count * size) + 1;
}

PointBatch GltfPoints::move_batch(const GltfVertices& v, std::uint64_t first, std::size_t n, const MovePoints& move,
                                  const detail::GltfCopy& copy, PointBatch& local) {
  PointBatch world;
  take(copy, v.position, first, n, local.positions);
  for (const Vec3d& p : local.positions) world.positions.push_back(v.to_world(p));
  if (v.normal) take(copy, *v.normal, first, n, local.normals);
  for (const Vec3d& d : local.normals) world.normals.push_back(unit(transposed(v.from_world, d)));
  if (v.tangent) take(copy, *v.tangent, first, n, local.tangents);
  for (const Vec3d& d : local.tangents) world.tangents.push_back(linear(v.to_world, d));
  const PointBatch before = world, rest = local;
  move(world);
  for (std::size_t i = 0; i < n; ++i) {
    local.positions[i] = local.positions[i] + linear(v.from_world, world.positions[i] - before.positions[i]);
    for (double& c : local.positions[i]) c = double(float(c));
  }
  for (std::size_t i = 0; i < local.normals.size(); ++i) {
    if (world.normals[i] != before.normals[i]) local.normals[i] = unit(transposed(v.to_world, world.normals[i]));
  }
  for (std::size_t i = 0; i < local.tangents.size(); ++i) {
    if (world.tangents[i] != before.tangents[i]) local.tangents[i] = unit(linear(v.from_world, world.tangents[i]));
  }
  return rest;
}

void GltfPoints::write_batch(const GltfVertices& v, std::uint64_t first, std::size_t n, const MovePoints& move,
                             detail::GltfCopy& copy, Bounds3d& bounds) {
  PointBatch local;
  move_batch(v, first, n, move, copy, local);
  for (const Vec3d& p : local.positions) bounds.add(p);
  put(copy, v.position, first, local.positions);
  if (v.normal) put(copy, *v.normal, first, local.normals);
  if (v.tangent) put(copy, *v.tangent, first, local.tangents);
}

/// Writes an animation. The scene itself stays at rest.
void GltfPoints::write_frames(std::size_t frames, double seconds, const MoveFrame& move, OutputFile& out) {
  detail::GltfCopy copy = copy_of_file();
  copy.plan_copies(plan_);
  const std::vector<GltfVertices> targets = targets_in(copy);
  copy.plan_targets(targets, frames);
  copy_bytes_ = copy.memory_bytes();
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const MovePoints here = [&](PointBatch& batch) { move(frame, batch); };
    copy.begin_frame();
    for (std::size_t part = 0; part < targets.size(); ++part) {
      const GltfVertices& v = targets[part];
      Bounds3d bounds;
      for (std::uint64_t first = 0; first < v.position.count; first += kBatch) {
        const auto n = std::size_t(std::min<std::uint64_t>(kBatch, v.position.count - first));
        const std::vector<float> changes = changes_of(v, first, n, here, copy, bounds);
        copy.append(std::as_bytes(std::span(changes)));
      }
      copy.add_target(part, bounds);
    }
  }
  copy.add_animation(frames, seconds);
  copy.write(out);
}

/// Returns the changes of positions, each followed by that of the normal if there are normals.
std::vector<float> GltfPoints::changes_of(const GltfVertices& v, std::uint64_t first, std::size_t n,
                                          const MovePoints& move, const detail::GltfCopy& copy, Bounds3d& bounds) {
  PointBatch local;
  const PointBatch rest = move_batch(v, first, n, move, copy, local);
  std::vector<float> changes;
  const auto add = [&](const Vec3d& from, const Vec3d& to) {
    Vec3d change = to - from;
    for (double& c : change) changes.push_back(float(c)), c = double(changes.back());
    return change;
  };
  for (std::size_t i = 0; i < n; ++i) {
    bounds.add(add(rest.positions[i], local.positions[i]));
    if (!local.normals.empty()) add(rest.normals[i], local.normals[i]);
  }
  return changes;
}

}  // namespace

std::uint64_t bytes_of_gltf_points(const SceneFilePtr& file, const SceneOptions& options, const PointsUse& use) {
  const detail::JsonPlace json = detail::json_place(*file);
  const detail::GltfSketch sketch =
      detail::sketch_of(read_lean_json(file, json.begin, json.size, temp_dir_of(options), false).text);
  const std::uint64_t opened = sketch.parsed_bytes + sketch.places * detail::GltfPlan::kPlaceBytes;
  const std::uint64_t read = std::max(sketch.text_bytes + sketch.parsed_bytes, opened);
  if (!use.written) return read;
  return std::max(
      read, opened + detail::GltfCopy::kPerByte * json.size + sketch.copied_bytes + use.frames * sketch.target_bytes);
}

std::unique_ptr<ScenePoints> gltf_points(SceneFilePtr file, const SceneOptions& options) {
  return std::make_unique<GltfPoints>(std::move(file), options);
}

}  // namespace bp
