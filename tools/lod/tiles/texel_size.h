#pragma once
#include <utility>
#include <vector>

#include "lib/pass/leaf/scene_leaf.h"

/// The sizes of texels on tiles, which decide how small their images may be.
namespace bp {

/// The sizes of the texels of an image on a tile, scene units: each with the area that has it.
using Texels = std::vector<std::pair<double, double>>;

/// Adds the texels of an image of this size that lies on a part of the tile at `places`.
void add_texels(const SceneLeaf& leaf, const LeafPart& part, std::array<float, 2> LeafVertex::*places,
                const std::array<int, 2>& size, Texels& texels);
/// Returns about the smallest texel: a tenth of the area has smaller ones. 0: there is none. Sorts them.
[[nodiscard]] double finest_of(Texels& texels);
/// Returns the places at which an image of the material lies.
[[nodiscard]] std::array<float, 2> LeafVertex::*places_of(const TextureMaterial& material, std::uint32_t image);

}  // namespace bp
