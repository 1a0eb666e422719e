#pragma once
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "io/scene/detail/block_cache.h"
#include "io/scene/instanced_scene.h"

namespace bp {

static_assert(std::endian::native == std::endian::little, "glTF data is decoded in place");

template <class T>
T load_value(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// Reads elements of accessors through one cache.
class ElementReader {
 public:
  /// A small file gets a small cache: thousands of a tileset's contents are opened in a run.
  ElementReader(const SceneFilePtr& file, std::uint64_t budget)
      : file_(file), cache_(file, std::min(budget, file->size() + 8 * BlockCache::kBlockBytes)) {}

  /// Reads the bytes of element i into `raw`; returns false if it is zeros.
  bool fetch(const Accessor& a, std::uint64_t i, std::byte* raw);
  template <std::size_t N>
  std::array<double, N> vector(const Accessor& a, std::uint64_t i) {
    std::byte raw[N * 8];
    std::array<double, N> v{};
    if (!fetch(a, i, raw)) return v;
    if (a.type == ComponentType::f32) {  // nearly all
      for (std::size_t k = 0; k < N; ++k) v[k] = double(load_value<float>(raw + 4 * k));
      return v;
    }
    const std::size_t step = bytes_of(a.type);
    for (std::size_t k = 0; k < N; ++k) v[k] = decode(raw + k * step, a.type, a.normalized);
    return v;
  }
  std::uint64_t index(const Accessor& a, std::uint64_t i);
  /// Reads the indices [first, first + n). Many packed ones are read from the file at once, not through the cache.
  void indices(const Accessor& a, std::uint64_t first, std::size_t n, std::vector<std::uint64_t>& out);

  [[nodiscard]] static double decode(const std::byte* from, ComponentType type, bool normalized);

 private:
  /// Returns the position of element i among the replaced ones, or replaced_count.
  std::uint64_t replacement(const Accessor& a, std::uint64_t i);
  std::uint64_t replaced_number(const Accessor& a, std::uint64_t k);

  SceneFilePtr file_;
  BlockCache cache_;
  std::vector<std::byte> block_;  // packed indices
};

}  // namespace bp
