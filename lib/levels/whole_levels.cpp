#include "lib/levels/whole_levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "lib/core/error.h"
#include "lib/grid/clip.h"
#include "lib/store/result_key.h"

namespace bp {

namespace {

constexpr const char* kJob = "levels in one mesh";

Bounds3d bounds_of(const LatticeMesh& mesh) {
  Bounds3d bounds;
  for (const LatticeCoord v : mesh.vertices) bounds.add(mesh.frame.world(v));
  return bounds;
}

/// A point that is a lattice point of every level: a corner of the largest voxels, near the middle.
Vec3d common_origin(const std::vector<LodLevel>& levels) {
  double voxel = 0;
  Bounds3d bounds;
  for (const LodLevel& level : levels) {
    voxel = std::max(voxel, level.mesh.frame.voxel);
    bounds.merge(bounds_of(level.mesh));
  }
  Vec3d origin;
  for (std::size_t i = 0; i < 3; ++i)
    origin[i] = std::nearbyint((bounds.min[i] / 2 + bounds.max[i] / 2) / voxel) * voxel + 0.0;
  return origin;
}

/// Writes values one after the other: numbers as their bytes, texts and lists with their length.
class Packer {
 public:
  template <class... T>
  void operator()(T&... values) {
    (put(values), ...);
  }
  std::string bytes;

 private:
  template <class T>
  void put(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      std::uint64_t size = value.size();
      put(size);
      if constexpr (std::is_same_v<T, std::string>) {
        bytes += value;
      } else {
        for (auto& item : value) fields(*this, item);
      }
    }
  }
};

/// Reads them again. Throws bad_input if they end too early.
class Unpacker {
 public:
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      std::memcpy(&value, take(sizeof value), sizeof value);
    } else {
      std::uint64_t size = 0;
      get(size);
      if constexpr (std::is_same_v<T, std::string>) {
        value.assign(take(size), size);
      } else {
        (void)take(0);
        for (value.clear(); value.size() < size;) fields(*this, value.emplace_back());
      }
    }
  }
  const char* take(std::uint64_t size) {
    if (size > bytes_.size() - at_) fail(ErrorCode::bad_input, "a kept result is too short");
    at_ += size;
    return bytes_.data() + at_ - size;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class Archive>
void fields(Archive& a, Provenance& p) {
  a(p.tool, p.version, p.options, p.input_hash);
}

template <class Archive>
void fields(Archive& a, LevelFacts& f) {
  a(f.target.faces, f.target.error_world, f.faces, f.error_world, f.distance_world, f.scale_world, f.voxel, f.volume,
    f.voxels, f.faces_dense, f.attempts, f.reached, f.stopped_by);
}

template <class Archive>
void fields(Archive& a, WholeLevel& level) {
  a(level.content, level.bounds.min, level.bounds.max, level.provenance);
  fields(a, level.facts);
}

template <class Archive>
void fields(Archive& a, WholeLevels& whole) {
  a(whole.origin, whole.left_out, whole.levels);
}

/// Everything that the levels depend on.
ResultKey key_of(const WholeInput& input) {
  KeyHash hash(kJob);
  hash.add(std::string_view(input.encoding));
  hash.add(std::int64_t(input.first)).add(std::int64_t(input.count)).add(input.lod.least_scale_world);
  hash.add(std::int64_t(input.lod.scene.size())).add(std::as_bytes(std::span(input.lod.scene)));
  const GridFrame& frame = input.header.frame;
  hash.add(frame.voxel).add(std::int64_t(frame.up));
  for (const std::int64_t x : frame.origin) hash.add(x);
  for (const Vec3d& p : {input.header.bounds.min, input.header.bounds.max})
    for (const double x : p) hash.add(x);
  for (std::size_t i = 0; i < input.count; ++i) {  // dense faces are of the solid
    const LodTarget target = level_target(input.request, input.first + i, input.first, 1000000);
    hash.add(std::int64_t(target.faces)).add(target.error_world).add(target.scale_world.value_or(-1));
  }
  hash.add(std::int64_t(input.request.faces.size()));
  add_voxels(hash, *input.solid, voxels_of(input.header.bricks), {});
  add_voxels(hash, *input.lod.surface, voxels_of(input.header.bricks), {});
  if (input.colors != nullptr) {
    input.colors->prepare(frame);
    input.colors->all(frame).add_to(hash);
  }
  return hash.key();
}

WholeLevels make(WholeInput input, Backends& backends, const LevelSteps& steps, const WholeEncoder& encode) {
  LodChain chain(input.header, std::move(input.solid), backends, std::move(input.lod));
  const MadeLevels made =
      make_levels(chain, {input.request, input.first, input.count, input.header.bounds.diagonal()}, steps);
  WholeLevels whole;
  whole.origin = common_origin(made.levels);
  whole.left_out = made.left_out;
  for (std::size_t i = 0; i < made.levels.size(); ++i) {
    const LatticeMesh& mesh = made.levels[i].mesh;
    whole.levels.push_back(
        {encode(input.first + i, mesh, whole.origin), bounds_of(mesh), made.facts[i], mesh.provenance});
  }
  return whole;
}

}  // namespace

bool are_kept(const WholeInput& input, ResultStore& store) {
  std::string bytes;
  return store.get(key_of(input), bytes);
}

WholeLevels make_whole_levels(WholeInput input, Backends& backends, const LevelSteps& steps, const WholeEncoder& encode,
                              ResultStore* store) {
  if (store == nullptr) return make(std::move(input), backends, steps, encode);
  const ResultKey key = key_of(input);
  WholeLevels whole;
  if (std::string bytes; store->get(key, bytes)) {
    Unpacker unpack(bytes);
    fields(unpack, whole);
    whole.kept = true;
    return whole;
  }
  whole = make(std::move(input), backends, steps, encode);
  Packer pack;
  fields(pack, whole);
  store->put(key, pack.bytes);
  return whole;
}

}  // namespace bp
