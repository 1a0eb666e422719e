#pragma once
#include <bit>
#include <unordered_map>

#include "lib/pass/leaf/leaf_part.h"

namespace bp {

/// A part while it grows.
struct GrowingPart {
  LeafPart part;
  struct Hash {
    std::size_t operator()(const LeafVertex& v) const {
      std::uint64_t h = 0;
      const auto mix = [&h](std::uint64_t x) { h = (h ^ x) * 0x9E3779B97F4A7C15, h ^= h >> 29; };
      for (const std::int32_t x : v.at) mix(std::uint32_t(x));
      for (const float x : v.normal) mix(std::bit_cast<std::uint32_t>(x));
      for (const auto* uv : {&v.uv, &v.second_uv})
        for (const float x : *uv) mix(std::bit_cast<std::uint32_t>(x));
      mix(std::uint64_t(v.color.r) << 32 | std::uint64_t(v.color.g) << 16 | v.color.b);
      return std::size_t(h);
    }
  };
  std::unordered_map<LeafVertex, std::uint32_t, Hash> numbers;

  std::uint32_t number_of(const LeafVertex& v) {
    const auto [found, is_new] = numbers.try_emplace(v, std::uint32_t(part.vertices.size()));
    if (is_new) part.vertices.push_back(v);
    return found->second;
  }
};

}  // namespace bp
