#include "io/scene/detail/ahead/instanced_bounds.h"

#include <cstring>
#include <mutex>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::int64_t kAtOnce = std::int64_t(1) << 14;  // vertices: some hundred kilobytes
constexpr std::uint64_t kMostStride = 64;                // bytes: a position and some numbers beside it

bool is_plain(const Accessor& a) {
  return a.type == ComponentType::f32 && a.replaced_count == 0 && a.address != Accessor::kZeros &&
         a.stride <= kMostStride;
}

bool is_plain(const InstancedScene& scene) {
  std::uint64_t vertices = 0, corners = 0;
  for (const MeshNode& node : scene.nodes) {
    if (node.instances) return false;
    for (std::uint32_t i = node.first; i < node.end; ++i) {
      const Primitive& p = scene.primitives[i];
      if (!is_plain(p.positions)) return false;
      vertices += p.positions.count;
      corners += p.indices ? p.indices->count : p.positions.count;
    }
  }
  return vertices <= corners;
}

/// Returns the bounds of the vertices [begin, end). `transform`: null if it moves nothing.
Bounds3d bounds_of(const SceneFile& file, const Accessor& a, std::uint64_t begin, std::uint64_t end,
                   const Affine* transform) {
  float p[3];
  std::vector<std::byte> bytes(std::size_t((end - begin - 1) * a.stride + sizeof p));
  bytes.resize(file.read_at(a.address + begin * a.stride, bytes));
  Bounds3d bounds;
  for (std::size_t at = 0; at + sizeof p <= bytes.size(); at += std::size_t(a.stride)) {
    std::memcpy(p, bytes.data() + at, sizeof p);
    const Vec3d point{p[0], p[1], p[2]};
    bounds.add(transform != nullptr ? transform->place(point, 0).point : point);
  }
  return bounds;
}

}  // namespace

std::optional<Bounds3d> bounds_ahead(const InstancedScene& scene) {
  if (!is_plain(scene)) return {};
  Bounds3d all;
  std::mutex mutex;
  parallel_for(std::int64_t(scene.nodes.size()), [&](std::int64_t i) {
    const MeshNode& node = scene.nodes[std::size_t(i)];
    const bool stays = node.transform.m == Affine().m && !node.transform.off.any();
    for (std::uint32_t k = node.first; k < node.end; ++k) {
      const Accessor& a = scene.primitives[k].positions;
      parallel_ranges(std::int64_t(a.count), kAtOnce, [&](std::int64_t begin, std::int64_t end) {
        const Bounds3d part =
            bounds_of(*scene.bytes, a, std::uint64_t(begin), std::uint64_t(end), stays ? nullptr : &node.transform);
        const std::lock_guard lock(mutex);
        all.merge(part);
      });
    }
  });
  return all;
}

}  // namespace bp
