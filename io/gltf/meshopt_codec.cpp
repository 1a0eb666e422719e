#include "io/gltf/meshopt_codec.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace bp {

namespace {

// The codecs store at least a byte for each triangle, and for vertices two bits for every 16 values of each byte of the
// stride. A view that claims more is damaged, and would take memory before that is found out.
constexpr std::uint64_t kMostPerByte = 64;
constexpr std::uint64_t kMostStride = 256;

const unsigned char* raw(const std::byte* bytes) {
  return reinterpret_cast<const unsigned char*>(bytes);
}

std::string check(const MeshoptView& view, std::size_t bytes) {
  if (view.mode == MeshoptMode::attributes) {
    if (view.stride == 0 || view.stride % 4 != 0 || view.stride > kMostStride)
      return "have a stride that is no multiple of 4 up to 256";
  } else if (view.stride != 2 && view.stride != 4) {
    return "have a stride that is neither 2 nor 4";
  }
  if (view.mode == MeshoptMode::triangles && view.count % 3 != 0)
    return "hold a number of indices that is no multiple of 3";
  const std::uint64_t most = kMostPerByte * (std::uint64_t(bytes) + kMostStride);
  if (view.count > most || view.count * view.stride > most) return "promise more than they can hold";
  return {};
}

void apply(const MeshoptView& view, std::byte* out) {
  const auto n = std::size_t(view.count), stride = std::size_t(view.stride);
  switch (view.filter) {
    case MeshoptFilter::none:
      return;
    case MeshoptFilter::octahedral:
      return meshopt_decodeFilterOct(out, n, stride);
    case MeshoptFilter::quaternion:
      return meshopt_decodeFilterQuat(out, n, stride);
    case MeshoptFilter::exponential:
      return meshopt_decodeFilterExp(out, n, stride);
  }
}

bool filter_fits(const MeshoptView& view) {
  switch (view.filter) {
    case MeshoptFilter::none:
      return true;
    case MeshoptFilter::octahedral:
      return view.mode == MeshoptMode::attributes && (view.stride == 4 || view.stride == 8);
    case MeshoptFilter::quaternion:
      return view.mode == MeshoptMode::attributes && view.stride == 8;
    case MeshoptFilter::exponential:
      return view.mode == MeshoptMode::attributes;
  }
  return false;
}

int decode(const MeshoptView& view, std::span<const std::byte> bytes, std::byte* out) {
  const auto n = std::size_t(view.count), stride = std::size_t(view.stride);
  switch (view.mode) {
    case MeshoptMode::attributes:
      return meshopt_decodeVertexBuffer(out, n, stride, raw(bytes.data()), bytes.size());
    case MeshoptMode::triangles:
      return meshopt_decodeIndexBuffer(out, n, stride, raw(bytes.data()), bytes.size());
    case MeshoptMode::indices:
      return meshopt_decodeIndexSequence(out, n, stride, raw(bytes.data()), bytes.size());
  }
  return -1;
}

}  // namespace

std::vector<std::uint32_t> optimize_order(TriangleIndices& triangles, std::size_t vertices) {
  TriangleIndices ordered(triangles.size());
  meshopt_optimizeVertexCache(ordered[0].data(), triangles[0].data(), 3 * triangles.size(), vertices);
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renamed(vertices, kUnused), old;
  for (auto& t : ordered) {
    for (std::uint32_t& v : t) {
      if (renamed[v] == kUnused) {
        renamed[v] = std::uint32_t(old.size());
        old.push_back(v);
      }
      v = renamed[v];
    }
  }
  triangles = std::move(ordered);
  return old;
}

std::string encode_attributes(const std::string& data, std::size_t stride) {
  const std::size_t count = data.size() / stride;
  std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
  meshopt_encodeVertexVersion(0);
  out.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), data.data(), count, stride));
  return out;
}

std::string octahedral(const std::vector<std::array<float, 3>>& normals) {
  std::vector<std::array<float, 4>> padded;
  padded.reserve(normals.size());
  for (const auto& n : normals) padded.push_back({n[0], n[1], n[2], 0.0F});
  return octahedral(padded);
}

std::string octahedral(const std::vector<std::array<float, 4>>& tangents) {
  std::string out(4 * tangents.size(), '\0');
  if (!tangents.empty()) meshopt_encodeFilterOct(out.data(), tangents.size(), 4, 8, tangents[0].data());
  return out;
}

std::string exponential(const std::string& numbers) {
  constexpr int kBits = 24, kMostExponent = 100;  // of the format: a signed integer, and what decoders must take
  std::vector<float> all(numbers.size() / sizeof(float));
  std::memcpy(all.data(), numbers.data(), numbers.size());
  int least = kMostExponent, most = -kMostExponent;
  for (const float x : all) {
    if (!std::isfinite(x)) return {};
    if (x == 0) continue;
    int exponent = 0;
    const auto mantissa = std::uint32_t(std::ldexp(std::abs(std::frexp(x, &exponent)), kBits));
    least = std::min(least, exponent - kBits + std::countr_zero(mantissa));
    most = std::max(most, exponent);
  }
  if (least > most) least = most = 0;  // no number but 0
  if (most - least > kBits - 1 || std::abs(least) > kMostExponent) return {};
  std::vector<std::uint32_t> words;
  words.reserve(all.size());
  for (const float x : all) {
    const auto multiple = std::int32_t(std::ldexp(x, -least));
    words.push_back(std::uint32_t(least) << kBits | (std::uint32_t(multiple) & 0xffffff));
  }
  return {reinterpret_cast<const char*>(words.data()), numbers.size()};
}

std::string encode_triangles(const TriangleIndices& triangles, std::size_t vertices) {
  std::string out(meshopt_encodeIndexBufferBound(3 * triangles.size(), vertices), '\0');
  meshopt_encodeIndexVersion(1);
  out.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), triangles[0].data(),
                                       3 * triangles.size()));
  return out;
}

std::string decode_meshopt(const MeshoptView& view, std::span<const std::byte> bytes, std::vector<std::byte>& out) {
  if (std::string wrong = check(view, bytes.size()); !wrong.empty()) return wrong;
  if (!filter_fits(view)) return "have a filter that does not fit them";
  out.resize(std::size_t(view.count * view.stride));
  if (view.count == 0) return {};
  if (decode(view, bytes, out.data()) != 0) return "are damaged";
  apply(view, out.data());
  return {};
}

}  // namespace bp
