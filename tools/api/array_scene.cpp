#include "tools/api/array_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "tools/api/structs.h"

namespace bp::api {

namespace {

template <class T>
T number_at(const std::byte* p) {
  T value;
  std::memcpy(&value, p, sizeof value);  // rows may lie at any byte
  return value;
}

constexpr std::uint64_t kMostTriangles = std::uint64_t(1) << 40;

std::size_t bytes_of(std::int32_t type) {
  return type == BP_FLOAT64 || type == BP_UINT64 || type == BP_INT64 ? 8 : 4;
}

/// Borrowed numbers may have changed since they were checked.
[[noreturn]] void fail_changed(std::size_t triangle) {
  fail(ErrorCode::bad_input, "triangle {}: the arrays of the scene were changed after it was made", triangle);
}

/// The same triangles as a file of them would give.
class ArraySource final : public TwoStepSource {
 public:
  explicit ArraySource(const ArrayScene& scene) : scene_(scene) {}

  bool next(RawBatch& batch) override {
    batch.bad_faces = 0;
    batch.records = at_;
    batch.count = std::min(kBatch, scene_.size() - at_);
    at_ += batch.count;
    return batch.count > 0;
  }
  void complete(RawBatch& batch) const override {
    batch.triangles.resize(batch.count);
    for (std::size_t i = 0; i < batch.count; ++i) batch.triangles[i] = scene_.triangle(batch.records + i);
  }
  void rewind() override { at_ = 0; }
  [[nodiscard]] std::optional<Bounds3d> bounds() override { return scene_.bounds(); }
  [[nodiscard]] std::optional<UpAxis> up() const override { return scene_.up(); }

 private:
  const ArrayScene& scene_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<UpAxis> up_of(std::int32_t up) {
  if (up == BP_UP_UNKNOWN) return {};
  return choice<UpAxis>(up, 6, "up", BP_UP_Y);
}

ArrayScene::Rows ArrayScene::rows(const void* data, std::size_t count, std::size_t stride, std::int32_t type,
                                  const char* name) {
  const std::size_t row = 3 * bytes_of(type);
  if (data == nullptr && count > 0) fail(ErrorCode::bad_argument, "{} are NULL, and there are to be {}", name, count);
  if (stride != 0 && stride < row)
    fail(ErrorCode::bad_argument, "{}: its stride is {}, less than the {} bytes of a row", name, stride, row);
  return {static_cast<const std::byte*>(data), stride == 0 ? row : stride, count, type};
}

ArrayScene::ArrayScene(const bp_arrays& a) : triangle_count_(a.triangle_count), up_(up_of(a.up)) {
  if (a.vertex_type != BP_FLOAT64 && a.vertex_type != BP_FLOAT32)
    fail(ErrorCode::bad_argument, "vertex_type: vertices are BP_FLOAT64 or BP_FLOAT32");
  if (a.triangle_type < BP_UINT32 || a.triangle_type > BP_INT64)
    fail(ErrorCode::bad_argument, "triangle_type: triangles are BP_UINT32, BP_INT32, BP_UINT64 or BP_INT64");
  if (a.vertex_count > 0xffffffffU) fail(ErrorCode::bad_argument, "{} vertices are more than 2^32 - 1", a.vertex_count);
  if (a.triangle_count > kMostTriangles)
    fail(ErrorCode::bad_argument, "{} triangles are more than 2^40", a.triangle_count);
  vertices_ = rows(a.vertices, a.vertex_count, a.vertex_stride, a.vertex_type, "the vertices");
  triangles_ = rows(a.triangles, a.triangle_count, a.triangle_stride, a.triangle_type, "the triangles");
  if (a.triangle_count == 0) fail(ErrorCode::bad_input, "there are no triangles");
  check();
  if (a.borrow == 0) copy();
}

std::int64_t ArrayScene::index(std::size_t triangle, std::size_t corner) const {
  const std::byte* const p = triangles_.data + triangle * triangles_.stride + corner * bytes_of(triangles_.type);
  switch (triangles_.type) {
    case BP_UINT32:
      return number_at<std::uint32_t>(p);
    case BP_INT32:
      return number_at<std::int32_t>(p);
    case BP_UINT64:
      return std::int64_t(std::min<std::uint64_t>(number_at<std::uint64_t>(p), INT64_MAX));
    default:
      return number_at<std::int64_t>(p);
  }
}

Vec3d ArrayScene::vertex(std::size_t i) const {
  const std::byte* const p = vertices_.data + i * vertices_.stride;
  if (vertices_.type == BP_FLOAT64) return {number_at<double>(p), number_at<double>(p + 8), number_at<double>(p + 16)};
  return {number_at<float>(p), number_at<float>(p + 4), number_at<float>(p + 8)};
}

TriangleD ArrayScene::triangle(std::size_t i) const {
  TriangleD t;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto v = std::size_t(index(i, k));
    if (v >= vertices_.count) fail_changed(i);
    t[k] = vertex(v);
  }
  if (!is_finite(t)) fail_changed(i);
  return t;
}

std::string ArrayScene::index_text(std::size_t triangle, std::size_t corner) const {
  const std::byte* const p = triangles_.data + triangle * triangles_.stride + corner * bytes_of(triangles_.type);
  return triangles_.type == BP_UINT64 ? fmt::to_string(number_at<std::uint64_t>(p))
                                      : fmt::to_string(index(triangle, corner));
}

void ArrayScene::check() {
  constexpr std::int64_t kGrain = 1 << 15;
  struct Part {
    Bounds3d bounds;
    std::optional<std::string> fault;
  };
  std::vector<Part> parts(std::size_t((std::int64_t(triangle_count_) + kGrain - 1) / kGrain));
  parallel_ranges(std::int64_t(triangle_count_), kGrain, [&](std::int64_t begin, std::int64_t end) {
    Part& part = parts[std::size_t(begin / kGrain)];
    for (std::int64_t i = begin; i < end && !part.fault; ++i) {
      for (std::size_t k = 0; k < 3 && !part.fault; ++k) {
        const std::int64_t v = index(std::size_t(i), k);
        if (v < 0 || std::uint64_t(v) >= vertices_.count) {
          part.fault = fmt::format("triangle {} names vertex {}, and the number of vertices is {}", i,
                                   index_text(std::size_t(i), k), vertices_.count);
          break;
        }
        const Vec3d p = vertex(std::size_t(v));
        if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
          part.fault = fmt::format("vertex {} is not finite: {}, {}, {}", v, p[0], p[1], p[2]);
        part.bounds.add(p);
      }
    }
  });
  for (const Part& part : parts) {
    if (part.fault) fail(ErrorCode::bad_input, "{}", *part.fault);
    bounds_.add(part.bounds.min);
    bounds_.add(part.bounds.max);
  }
}

void ArrayScene::copy() {
  own_vertices_.resize(vertices_.count);
  own_triangles_.resize(triangle_count_);
  for (std::size_t i = 0; i < vertices_.count; ++i) own_vertices_[i] = vertex(i);
  for (std::size_t i = 0; i < triangle_count_; ++i) {
    for (std::size_t k = 0; k < 3; ++k) own_triangles_[i][k] = std::uint32_t(index(i, k));
  }
  vertices_ = rows(own_vertices_.data(), own_vertices_.size(), 0, BP_FLOAT64, "the vertices");
  triangles_ = rows(own_triangles_.data(), triangle_count_, 0, BP_UINT32, "the triangles");
}

IndexedMesh ArrayScene::mesh() const {
  SceneOptions options;
  options.keep_extremes = true;
  SceneCounts counts;
  ArraySource source(*this);
  return mesh_of("the proxy", source, options, counts);
}

IndexedMesh ArrayScene::mesh_as_given() const {
  IndexedMesh mesh;
  mesh.vertices.resize(vertices_.count);
  mesh.triangles.resize(triangle_count_);
  for (std::size_t i = 0; i < vertices_.count; ++i) mesh.vertices[i] = vertex(i);
  for (std::size_t i = 0; i < triangle_count_; ++i) {
    for (std::size_t k = 0; k < 3; ++k) mesh.triangles[i][k] = std::uint32_t(index(i, k));
  }
  return mesh;
}

RawSourcePtr ArrayScene::open() const {
  return std::make_unique<ArraySource>(*this);
}

}  // namespace bp::api
