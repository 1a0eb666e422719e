#include "io/scene/detail/instanced/element_reader.h"

#include <algorithm>
#include <limits>

#include "lib/core/error.h"

namespace bp {

namespace {

template <class T>
double decode_as(const std::byte* from, bool normalized) {
  const auto value = double(load_value<T>(from));
  return normalized ? std::max(value / double(std::numeric_limits<T>::max()), -1.0) : value;
}

std::uint64_t decode_index(const std::byte* from, ComponentType type) {
  switch (type) {
    case ComponentType::u8:
      return load_value<std::uint8_t>(from);
    case ComponentType::u16:
      return load_value<std::uint16_t>(from);
    case ComponentType::u32:
      return load_value<std::uint32_t>(from);
    default:
      return ~std::uint64_t(0);
  }
}

/// Sets `out` to the integers of type T that lie in `from`.
template <class T>
void widen(const std::vector<std::byte>& from, std::vector<std::uint64_t>& out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = load_value<T>(from.data() + i * sizeof(T));
}

}  // namespace

double ElementReader::decode(const std::byte* from, ComponentType type, bool normalized) {
  switch (type) {
    case ComponentType::i8:
      return decode_as<std::int8_t>(from, normalized);
    case ComponentType::u8:
      return decode_as<std::uint8_t>(from, normalized);
    case ComponentType::i16:
      return decode_as<std::int16_t>(from, normalized);
    case ComponentType::u16:
      return decode_as<std::uint16_t>(from, normalized);
    case ComponentType::u32:
      return decode_as<std::uint32_t>(from, normalized);
    case ComponentType::f32:
      return double(load_value<float>(from));
    case ComponentType::f64:
      return load_value<double>(from);
  }
  return 0;
}

bool ElementReader::fetch(const Accessor& a, std::uint64_t i, std::byte* raw) {
  const std::size_t size = bytes_of(a.type) * a.components;
  const std::uint64_t at = replacement(a, i);
  if (at == a.replaced_count && a.address == Accessor::kZeros) return false;
  cache_.read(at < a.replaced_count ? a.replaced_values + at * size : a.address + i * a.stride, raw, size);
  return true;
}

std::uint64_t ElementReader::index(const Accessor& a, std::uint64_t i) {
  std::byte raw[8];
  return fetch(a, i, raw) ? decode_index(raw, a.type) : 0;
}

void ElementReader::indices(const Accessor& a, std::uint64_t first, std::size_t n, std::vector<std::uint64_t>& out) {
  out.resize(n);
  const std::size_t size = bytes_of(a.type);
  if (a.replaced_count > 0 || a.stride != size || a.address == Accessor::kZeros) {
    for (std::size_t i = 0; i < n; ++i) out[i] = index(a, first + i);
    return;
  }
  block_.resize(n * size);
  const std::uint64_t at = a.address + first * size;
  if (block_.size() <= BlockCache::kBlockBytes) {
    cache_.read(at, block_.data(), block_.size());
  } else if (file_->read_at(at, block_) < block_.size()) {
    fail(ErrorCode::bad_input, "{}: ends before byte {}, up to which data is needed; the file is truncated",
         file_->name(), at + block_.size());
  }
  if (a.type == ComponentType::u32) return widen<std::uint32_t>(block_, out);
  if (a.type == ComponentType::u16) return widen<std::uint16_t>(block_, out);
  widen<std::uint8_t>(block_, out);
}

std::uint64_t ElementReader::replacement(const Accessor& a, std::uint64_t i) {
  std::uint64_t lo = 0, hi = a.replaced_count;
  while (lo < hi) {
    const std::uint64_t mid = lo + (hi - lo) / 2, number = replaced_number(a, mid);
    if (number == i) return mid;
    (number < i ? lo : hi) = number < i ? mid + 1 : mid;
  }
  return a.replaced_count;
}

std::uint64_t ElementReader::replaced_number(const Accessor& a, std::uint64_t k) {
  std::byte raw[8];
  const std::size_t size = bytes_of(a.number_type);
  cache_.read(a.replaced_numbers + k * size, raw, size);
  return decode_index(raw, a.number_type);
}

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
      out.push_back(there ? ElementReader::decode(raw + k * step, accessor.type, accessor.normalized) : 0);
  }
  return out;
}

}  // namespace bp
