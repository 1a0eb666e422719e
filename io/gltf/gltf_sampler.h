#pragma once
#include <array>
#include <cstdint>

#include "io/gltf/glb_file.h"
#include "lib/core/texture.h"

/// Numbers of samplers (glTF 2.0, section 5.26).
namespace bp {

/// Returns the wrapping that glTF's number names; repeat for an unknown number.
[[nodiscard]] inline TextureWrap wrap_of_gltf(std::uint64_t number) {
  return number == 33071 ? TextureWrap::clamp : number == 33648 ? TextureWrap::mirror : TextureWrap::repeat;
}

/// Returns `number` if glTF defines it as a filter, else 0, which stands for no filter.
[[nodiscard]] inline std::uint16_t filter_of_gltf(std::uint64_t number) {
  return number == 9728 || number == 9729 || (number >= 9984 && number <= 9987) ? std::uint16_t(number) : 0;
}

/// Returns the JSON of a sampler. Where `filters` names none, the sampler gets linear filters, with mipmaps for images
/// that are drawn smaller.
[[nodiscard]] inline GltfOutJson gltf_sampler(const std::array<TextureWrap, 2>& wrap, const TextureFilters& filters) {
  const auto number = [](TextureWrap w) {
    return w == TextureWrap::clamp ? 33071 : w == TextureWrap::mirror ? 33648 : 10497;
  };
  constexpr int kLinear = 9729, kLinearMipmapLinear = 9987;
  return {{"magFilter", filters[1] != 0 ? filters[1] : kLinear},
          {"minFilter", filters[0] != 0 ? filters[0] : kLinearMipmapLinear},
          {"wrapS", number(wrap[0])},
          {"wrapT", number(wrap[1])}};
}

}  // namespace bp
