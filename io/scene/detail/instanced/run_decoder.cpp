#include "io/scene/detail/instanced/run_decoder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns a placed vertex. Integers that stand for [-1, 1] are divided, which rounds once.
PlacedPoint placed(const Accessor& positions, const MeshPlace& place, const Vec3d& point) {
  double off = positions.off;
  if (const double share = positions.share + (positions.normalized ? 0x1p-53 : 0); share > 0)
    off += share * std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
  return place.stays ? PlacedPoint{point, off} : place.transform.place(point, off);
}

bool lies_in(const Vec3d& p, const Bounds3d& b) {
  return !(p[0] < b.min[0] || p[0] > b.max[0] || p[1] < b.min[1] || p[1] > b.max[1] || p[2] < b.min[2] ||
           p[2] > b.max[2]);
}

/// Returns how many vertices can be named. The largest index of a type ends a strip or a fan, and programs drop or
/// follow it (glTF 2.0, section 3.7.2.1).
std::uint64_t named_vertices(const Primitive& p) {
  if (!p.indices) return p.positions.count;
  return std::min(p.positions.count, (std::uint64_t(1) << (8 * bytes_of(p.indices->type))) - 1);
}

}  // namespace

void RunDecoder::decode(RawBatch& batch, Rounding& rounding) {
  rounding_ = {};
  leaving_.clear();
  for (const PlacedRun& run : batch.runs) decode(run, batch);
  rounding.add(rounding_);
}

void RunDecoder::decode(const PlacedRun& run, RawBatch& batch) {
  const Primitive& p = scene_.primitives[run.primitive];
  read_corners(p, run);
  if (read_points(p, run.end - run.first)) {
    const std::uint64_t stride = p.positions.stride;
    add_triangles(
        run,
        [&](std::uint64_t i) -> Vec3d {
          const std::byte* const at = points_.data() + (i - first_point_) * stride;
          return {load_value<float>(at), load_value<float>(at + 4), load_value<float>(at + 8)};
        },
        batch);
  } else {
    add_triangles(
        run, [&](std::uint64_t i) { return elements_.vector<3>(p.positions, i); }, batch);
  }
}

void RunDecoder::read_corners(const Primitive& p, const PlacedRun& run) {
  const std::uint64_t triangles = run.end - run.first;
  const bool apart = p.mode == Primitive::Mode::triangles;
  first_index_ = apart ? 3 * run.first : run.first;
  const auto n = std::size_t(apart ? 3 * triangles : triangles + 2);
  if (p.indices) {
    elements_.indices(*p.indices, first_index_, n, indices_);
  } else {
    indices_.resize(n);
    std::iota(indices_.begin(), indices_.end(), first_index_);
  }
  fan_centre_ = p.mode == Primitive::Mode::fan && p.indices ? elements_.index(*p.indices, 0) : 0;
}

RunDecoder::Corners RunDecoder::corners_of(const Primitive& p, const PlacedRun& run, std::uint64_t triangle) const {
  const std::uint64_t* const at =
      indices_.data() + (p.mode == Primitive::Mode::triangles ? 3 * triangle : triangle) - first_index_;
  Corners corners{at[0], at[1], at[2]};
  if (p.mode == Primitive::Mode::strip && triangle % 2 != 0) std::swap(corners[0], corners[1]);
  if (p.mode == Primitive::Mode::fan) corners[0] = fan_centre_;
  if (run.place->mirrors) std::swap(corners[1], corners[2]);
  return corners;
}

/// Reads the vertices of a run at once. Vertices that follow each other in the file are mostly neighbours in space, so
/// those of a run lie together. Returns false if they do not, if they are no plain floats, or if the run is so small
/// that the cache is as fast.
bool RunDecoder::read_points(const Primitive& p, std::uint64_t triangles) {
  constexpr std::uint64_t kFewTriangles = 256;  // their vertices fit in a block of the cache
  const Accessor& a = p.positions;
  const bool plain = a.type == ComponentType::f32 && a.replaced_count == 0 && a.address != Accessor::kZeros;
  if (!plain || triangles < kFewTriangles) return false;
  std::uint64_t first = a.count, end = 0;
  const auto see = [&](std::uint64_t i) {
    if (i >= a.count) return;
    first = std::min(first, i);
    end = std::max(end, i + 1);
  };
  std::for_each(indices_.begin(), indices_.end(), see);
  if (p.mode == Primitive::Mode::fan) see(fan_centre_);
  if (first >= end || a.stride > sizeof(TriangleD) || (end - first) * a.stride > triangles * sizeof(TriangleD))
    return false;
  constexpr std::size_t kPointBytes = 3 * sizeof(float);
  points_.resize(std::size_t((end - first - 1) * a.stride) + kPointBytes);
  first_point_ = first;
  if (scene_.bytes->read_at(a.address + first * a.stride, points_) < points_.size()) {
    fail(ErrorCode::bad_input, "{}: ends before the vertices that its triangles have; the file is truncated",
         scene_.bytes->name());
  }
  return true;
}

/// `point(i)`: position of vertex i.
template <class Point>
void RunDecoder::add_triangles(const PlacedRun& run, const Point& point, RawBatch& batch) {
  const Primitive& p = scene_.primitives[run.primitive];
  const std::uint64_t count = named_vertices(p);
  bool leaves = false;
  for (std::uint64_t t = run.first; t < run.end; ++t) {
    const Corners corners = corners_of(p, run, t);
    if (corners[0] >= count || corners[1] >= count || corners[2] >= count) {
      ++batch.bad_faces;
      continue;
    }
    TriangleD& triangle = batch.triangles.emplace_back();
    double off = 0, largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d at = point(corners[k]);
      leaves = leaves || (p.told && !lies_in(at, *p.told));
      const PlacedPoint corner = placed(p.positions, *run.place, at);
      triangle[k] = corner.point;
      off = std::max(off, corner.off);
      for (const double x : triangle[k]) largest = std::max(largest, std::abs(x));
    }
    // A bound of no more than a few roundings of the numbers themselves comes mostly from other triangles.
    if (off > 0) rounding_.see(off, largest, std::max(0x1p-50, 4 * p.positions.share));
    if (batch.colored)
      batch.colors.push_back({color_of(p, corners[0]), color_of(p, corners[1]), color_of(p, corners[2])});
    if (batch.textured) batch.textures.push_back(texture_of(p, run.place->transform, corners));
  }
  if (leaves) leaving_.push_back(run.primitive);
}

TriangleTexture RunDecoder::texture_of(const Primitive& p, const Affine& transform, const Corners& corners) {
  TriangleTexture t{.material = p.material};
  const auto place = [&](const Accessor& places, std::uint64_t vertex, const std::array<double, 6>& m) {
    const std::array<double, 2> uv = elements_.vector<2>(places, vertex);
    return std::array{float(m[0] * uv[0] + m[1] * uv[1] + m[2]), float(m[3] * uv[0] + m[4] * uv[1] + m[5])};
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (p.uv) t.uv[k] = place(*p.uv, corners[k], p.uv_transform);
    if (p.second_uv) t.second_uv[k] = place(*p.second_uv, corners[k], p.second_uv_transform);
    if (p.normals) t.normals[k] = pack_normal(transform.normal(elements_.vector<3>(*p.normals, corners[k])));
  }
  return t;
}

LinearColor RunDecoder::color_of(const Primitive& p, std::uint64_t vertex) {
  std::array<double, 3> rgb = p.base_color;
  if (p.colors) {
    const std::array<double, 3> c = elements_.vector<3>(*p.colors, vertex);
    for (std::size_t i = 0; i < 3; ++i) rgb[i] *= c[i];
  }
  return p.srgb ? color_from_srgb(rgb) : color_from_linear(rgb);
}

}  // namespace bp
