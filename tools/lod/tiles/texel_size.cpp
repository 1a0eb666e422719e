#include "tools/lod/tiles/texel_size.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

void add_texels(const SceneLeaf& leaf, const LeafPart& part, std::array<float, 2> LeafVertex::*places,
                const std::array<int, 2>& size, Texels& texels) {
  const double count = double(size[0]) * size[1];
  for (const auto& t : part.triangles) {
    const LeafVertex &a = part.vertices[t[0]], &b = part.vertices[t[1]], &c = part.vertices[t[2]];
    const auto turn = [&](std::size_t i, const auto& at) { return double(at[i]); };
    const std::array<float, 2>&pa = a.*places, &pb = b.*places, &pc = c.*places;
    const double in_image =
        std::abs((turn(0, pb) - pa[0]) * (turn(1, pc) - pa[1]) - (turn(0, pc) - pa[0]) * (turn(1, pb) - pa[1])) / 2;
    Vec3d u, v;
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = leaf.unit * (double(b.at[i]) - a.at[i]);
      v[i] = leaf.unit * (double(c.at[i]) - a.at[i]);
    }
    const double area = length(cross(u, v)) / 2;
    if (in_image > 0 && area > 0) texels.emplace_back(std::sqrt(area / (in_image * count)), area);
  }
}

std::array<float, 2> LeafVertex::*places_of(const TextureMaterial& m, std::uint32_t image) {
  for (const TextureMap& map : {m.surface.normal, m.surface.roughness, m.surface.emission, m.details.occlusion}) {
    if (map.image == image && map.in_second_places) return &LeafVertex::second_uv;
  }
  return &LeafVertex::uv;
}

double finest_of(Texels& texels) {
  std::sort(texels.begin(), texels.end());
  double all = 0, sum = 0;
  for (const auto& [size, area] : texels) all += area;
  for (const auto& [size, area] : texels) {
    sum += area;
    if (sum >= all / 10) return size;
  }
  return 0;
}

}  // namespace bp
