#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/scene/detail/ahead/instanced_bounds.h"
#include "io/scene/detail/block_cache.h"
#include "io/scene/instanced_scene.h"
#include "lib/core/error.h"

namespace bp {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF data is decoded in place");

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <class T>
double decode(const std::byte* from, bool normalized) {
  const auto value = double(load<T>(from));
  return normalized ? std::max(value / double(std::numeric_limits<T>::max()), -1.0) : value;
}

double decode(const std::byte* from, ComponentType type, bool normalized) {
  switch (type) {
    case ComponentType::i8:
      return decode<std::int8_t>(from, normalized);
    case ComponentType::u8:
      return decode<std::uint8_t>(from, normalized);
    case ComponentType::i16:
      return decode<std::int16_t>(from, normalized);
    case ComponentType::u16:
      return decode<std::uint16_t>(from, normalized);
    case ComponentType::u32:
      return decode<std::uint32_t>(from, normalized);
    case ComponentType::f32:
      return double(load<float>(from));
    case ComponentType::f64:
      return load<double>(from);
  }
  return 0;
}

std::uint64_t decode_index(const std::byte* from, ComponentType type) {
  switch (type) {
    case ComponentType::u8:
      return load<std::uint8_t>(from);
    case ComponentType::u16:
      return load<std::uint16_t>(from);
    case ComponentType::u32:
      return load<std::uint32_t>(from);
    default:
      return ~std::uint64_t(0);
  }
}

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

/// Reads elements of accessors through one cache.
class ElementReader {
 public:
  /// A small file gets a small cache: thousands of a tileset's contents are opened in a run.
  ElementReader(const SceneFilePtr& file, std::uint64_t budget)
      : cache_(file, std::min(budget, file->size() + 8 * BlockCache::kBlockBytes)) {}

  /// Reads the bytes of element i into `raw`; returns false if it is zeros.
  bool fetch(const Accessor& a, std::uint64_t i, std::byte* raw) {
    const std::size_t size = bytes_of(a.type) * a.components;
    const std::uint64_t at = replacement(a, i);
    if (at == a.replaced_count && a.address == Accessor::kZeros) return false;
    cache_.read(at < a.replaced_count ? a.replaced_values + at * size : a.address + i * a.stride, raw, size);
    return true;
  }
  template <std::size_t N>
  std::array<double, N> vector(const Accessor& a, std::uint64_t i) {
    std::byte raw[N * 8];
    std::array<double, N> v{};
    if (!fetch(a, i, raw)) return v;
    if (a.type == ComponentType::f32) {  // nearly all
      for (std::size_t k = 0; k < N; ++k) v[k] = double(load<float>(raw + 4 * k));
      return v;
    }
    const std::size_t step = bytes_of(a.type);
    for (std::size_t k = 0; k < N; ++k) v[k] = decode(raw + k * step, a.type, a.normalized);
    return v;
  }
  std::uint64_t index(const Accessor& a, std::uint64_t i) {
    std::byte raw[8];
    return fetch(a, i, raw) ? decode_index(raw, a.type) : 0;
  }
  /// Reads the packed indices [first, first + n); n at most a cache block of them.
  void indices(const Accessor& a, std::uint64_t first, std::size_t n, std::vector<std::uint64_t>& out) {
    out.resize(n);
    const std::size_t size = bytes_of(a.type);
    if (a.replaced_count > 0 || a.stride != size || a.address == Accessor::kZeros) {
      for (std::size_t i = 0; i < n; ++i) out[i] = index(a, first + i);
      return;
    }
    cache_.read(a.address + first * size, block_, n * size);
    for (std::size_t i = 0; i < n; ++i) out[i] = decode_index(block_ + i * size, a.type);
  }

 private:
  /// Returns the position of element i among the replaced ones, or replaced_count.
  std::uint64_t replacement(const Accessor& a, std::uint64_t i) {
    std::uint64_t lo = 0, hi = a.replaced_count;
    while (lo < hi) {
      const std::uint64_t mid = lo + (hi - lo) / 2, number = replaced_number(a, mid);
      if (number == i) return mid;
      (number < i ? lo : hi) = number < i ? mid + 1 : mid;
    }
    return a.replaced_count;
  }
  std::uint64_t replaced_number(const Accessor& a, std::uint64_t k) {
    std::byte raw[8];
    const std::size_t size = bytes_of(a.number_type);
    cache_.read(a.replaced_numbers + k * size, raw, size);
    return decode_index(raw, a.number_type);
  }

  BlockCache cache_;
  std::byte block_[BlockCache::kBlockBytes];
};

class InstancedSource final : public RawSource {
 public:
  InstancedSource(InstancedScene scene, const SceneOptions& options)
      : scene_(std::move(scene)), elements_(scene_.bytes, cache_bytes(scene_, options)) {
    rewind();
  }

  bool read(std::vector<TriangleD>& out) override { return read(out, nullptr, nullptr); }
  bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) override {
    return read(out, &colors, nullptr);
  }
  bool next(RawBatch& batch) override {
    batch.bad_faces = 0;
    return read(batch.triangles, batch.colored ? &batch.colors : nullptr, batch.textured ? &batch.textures : nullptr);
  }
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
    node_ = instances_ = 0;
    rounding_ = {};
    bad_faces_ = scene_.bad_faces;
    enter_node();
  }
  [[nodiscard]] std::uint64_t instances() const override { return instances_; }
  [[nodiscard]] Rounding rounding() const override { return rounding_; }
  [[nodiscard]] std::optional<UpAxis> up() const override { return scene_.up; }
  [[nodiscard]] std::optional<Bounds3d> bounds() override { return bounds_ahead(scene_); }
  [[nodiscard]] std::size_t levels() const override { return scene_.levels; }
  [[nodiscard]] UnreadParts unread() const override { return scene_.unread; }
  [[nodiscard]] std::size_t animations() const override { return scene_.animations; }
  [[nodiscard]] std::uint64_t posed() const override { return scene_.posed; }
  [[nodiscard]] std::uint64_t differing() const override { return scene_.differing; }
  [[nodiscard]] Unfollowed unfollowed() const override { return scene_.unfollowed; }
  [[nodiscard]] std::uint64_t points() const override { return scene_.points; }
  [[nodiscard]] std::uint64_t lines() const override { return scene_.lines; }

 private:
  static constexpr std::size_t kWindow = 3 * 1024;  // indices at a time: whole triangles, within a cache block

  bool read(std::vector<TriangleD>& out, std::vector<TriangleColors>* colors, std::vector<TriangleTexture>* textures) {
    out.clear();
    if (colors != nullptr) colors->clear();
    if (textures != nullptr) textures->clear();
    while (out.size() < kBatch && enter_primitive()) {
      for (; out.size() < kBatch && triangle_ < triangles_; ++triangle_) add_triangle(out, colors, textures);
      if (triangle_ == triangles_) leave_primitive();
    }
    return !out.empty();
  }
  [[nodiscard]] std::uint64_t instances_of(const MeshNode& n) const {
    return n.instances ? scene_.arrays[*n.instances].count : 1;
  }
  void enter_node() {
    instance_ = 0;
    if (node_ < scene_.nodes.size()) primitive_ = scene_.nodes[node_].first;
    open_ = false;
  }
  bool enter_primitive();
  void leave_primitive() {
    ++primitive_;
    open_ = false;
  }
  void place();
  [[nodiscard]] PlacedPoint placed(const Primitive& p, std::uint64_t vertex);
  void count_triangles(const Primitive& p);
  void add_triangle(std::vector<TriangleD>& out, std::vector<TriangleColors>* colors,
                    std::vector<TriangleTexture>* textures);
  [[nodiscard]] TriangleTexture texture_of(const Primitive& p, const std::array<std::uint64_t, 3>& corners);
  [[nodiscard]] LinearColor color_of(const Primitive& p, std::uint64_t vertex);
  std::uint64_t index(std::uint64_t i);
  InstancedScene scene_;
  ElementReader elements_;
  // The position of the stream.
  std::size_t node_ = 0;
  std::uint64_t instance_ = 0;
  std::uint32_t primitive_ = 0;
  bool open_ = false;  // the members below belong to this primitive in this instance
  std::uint64_t triangle_ = 0, triangles_ = 0, first_index_ = 0;
  Affine transform_;
  bool mirrored_ = false, stays_ = true;  // the transform mirrors; it moves nothing
  std::vector<std::uint64_t> window_;     // indices from window_begin_ on
  std::uint64_t window_begin_ = 0;
  std::uint64_t instances_ = 0;
  Rounding rounding_;
};

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
  transform_ = node.transform;
  if (node.instances) {
    const InstanceArray& a = scene_.arrays[*node.instances];
    const Vec3d t = a.translation.count > 0 ? elements_.vector<3>(a.translation, instance_) : Vec3d{};
    const Vec3d s = a.scale.count > 0 ? elements_.vector<3>(a.scale, instance_) : Vec3d{1, 1, 1};
    std::array<double, 4> q{0, 0, 0, 1};
    if (a.rotation.count > 0) q = elements_.vector<4>(a.rotation, instance_);
    transform_ = transform_ * affine_of(t, q, s);
  }
  mirrored_ = transform_.mirrors();
  stays_ = transform_.m == Affine().m && !transform_.off.any();
}

/// Returns a placed vertex. Integers that stand for [-1, 1] are divided, which rounds once.
PlacedPoint InstancedSource::placed(const Primitive& p, std::uint64_t vertex) {
  const Vec3d point = elements_.vector<3>(p.positions, vertex);
  double off = p.positions.off;
  if (const double share = p.positions.share + (p.positions.normalized ? 0x1p-53 : 0); share > 0)
    off += share * std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
  return stays_ ? PlacedPoint{point, off} : transform_.place(point, off);
}

void InstancedSource::count_triangles(const Primitive& p) {
  const std::uint64_t n = p.indices ? p.indices->count : p.positions.count;
  triangles_ = p.mode == Primitive::Mode::triangles ? n / 3 : n < 3 ? 0 : n - 2;
  triangle_ = 0;
  window_.clear();
  if (triangles_ > 0) first_index_ = p.indices ? elements_.index(*p.indices, 0) : 0;
  if (p.mode == Primitive::Mode::triangles ? n % 3 != 0 : n == 1 || n == 2) ++bad_faces_;
}

std::uint64_t InstancedSource::index(std::uint64_t i) {
  const Primitive& p = scene_.primitives[primitive_];
  if (!p.indices) return i;
  if (i - window_begin_ >= window_.size()) {
    window_begin_ = i;
    elements_.indices(*p.indices, i, std::size_t(std::min<std::uint64_t>(kWindow, p.indices->count - i)), window_);
  }
  return window_[std::size_t(i - window_begin_)];
}

void InstancedSource::add_triangle(std::vector<TriangleD>& out, std::vector<TriangleColors>* colors,
                                   std::vector<TriangleTexture>* textures) {
  const Primitive& p = scene_.primitives[primitive_];
  const std::uint64_t t = triangle_;
  std::array<std::uint64_t, 3> corner{};
  if (p.mode == Primitive::Mode::triangles) {
    corner = {index(3 * t), index(3 * t + 1), index(3 * t + 2)};
  } else if (p.mode == Primitive::Mode::strip) {
    corner = {index(t), index(t + 1), index(t + 2)};
    if (t % 2 != 0) std::swap(corner[0], corner[1]);
  } else {
    corner = {first_index_, index(t + 1), index(t + 2)};
  }
  if (mirrored_) std::swap(corner[1], corner[2]);
  TriangleD triangle;
  double off = 0, largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (corner[k] >= p.positions.count) {
      ++bad_faces_;
      return;
    }
    const PlacedPoint placed_corner = placed(p, corner[k]);
    triangle[k] = placed_corner.point;
    off = std::max(off, placed_corner.off);
    for (const double x : triangle[k]) largest = std::max(largest, std::abs(x));
  }
  // A bound of no more than a few roundings of the numbers themselves comes mostly from other triangles.
  if (off > 0) rounding_.see(off, largest, std::max(0x1p-50, 4 * p.positions.share));
  out.push_back(triangle);
  if (colors != nullptr) colors->push_back({color_of(p, corner[0]), color_of(p, corner[1]), color_of(p, corner[2])});
  if (textures != nullptr) textures->push_back(texture_of(p, corner));
}

TriangleTexture InstancedSource::texture_of(const Primitive& p, const std::array<std::uint64_t, 3>& corners) {
  TriangleTexture t{.material = p.material};
  const auto place = [&](const Accessor& places, std::uint64_t vertex, const std::array<double, 6>& m) {
    const std::array<double, 2> uv = elements_.vector<2>(places, vertex);
    return std::array{float(m[0] * uv[0] + m[1] * uv[1] + m[2]), float(m[3] * uv[0] + m[4] * uv[1] + m[5])};
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (p.uv) t.uv[k] = place(*p.uv, corners[k], p.uv_transform);
    if (p.second_uv) t.second_uv[k] = place(*p.second_uv, corners[k], p.second_uv_transform);
    if (p.normals) t.normals[k] = pack_normal(transform_.normal(elements_.vector<3>(*p.normals, corners[k])));
  }
  return t;
}

LinearColor InstancedSource::color_of(const Primitive& p, std::uint64_t vertex) {
  std::array<double, 3> rgb = p.base_color;
  if (p.colors) {
    const std::array<double, 3> c = elements_.vector<3>(*p.colors, vertex);
    for (std::size_t i = 0; i < 3; ++i) rgb[i] *= c[i];
  }
  return p.srgb ? color_from_srgb(rgb) : color_from_linear(rgb);
}

}  // namespace

std::vector<double> read_numbers(const SceneFilePtr& bytes, const Accessor& accessor) {
  constexpr std::uint64_t kCache = std::uint64_t(1) << 20;
  ElementReader elements(bytes, kCache);
  std::vector<double> out;
  out.reserve(accessor.count * accessor.components);
  const std::size_t step = bytes_of(accessor.type);
  for (std::uint64_t i = 0; i < accessor.count; ++i) {
    std::byte raw[16 * 8];
    const bool there = elements.fetch(accessor, i, raw);
    for (std::size_t k = 0; k < accessor.components; ++k)
      out.push_back(there ? decode(raw + k * step, accessor.type, accessor.normalized) : 0);
  }
  return out;
}

RawSourcePtr stream_instances(InstancedScene scene, const SceneOptions& options) {
  return std::make_unique<InstancedSource>(std::move(scene), options);
}

}  // namespace bp
