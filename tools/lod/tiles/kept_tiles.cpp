#include "tools/lod/tiles/kept_tiles.h"

#include <algorithm>
#include <vector>

#include "lib/pass/bake/textured_triangle.h"
#include "lib/store/packing.h"

namespace bp {

KeptTiles::KeptTiles(ResultStore& results, const SceneLooks& looks, const Bounds3d& box)
    : results_(results), looks_(looks) {
  looks.visit(box, [&](const TexturedTriangle& t) {
    const std::uint32_t material = t.texture.material;
    const auto [found, is_new] = materials_.try_emplace(looks.key_of(material), material);
    if (!is_new) found->second = std::min(found->second, material);
  });
}

bool KeptTiles::get(const ResultKey& key, SceneTile& tile, std::string& content) const {
  std::string bytes;
  if (!results_.get(key, bytes)) return false;
  std::string_view text = bytes;
  std::vector<ResultKey> looks;
  if (!unpack(text, tile) || !unpack(text, looks) || looks.size() != tile.leaf.parts.size()) return false;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const auto found = materials_.find(looks[i]);
    if (found == materials_.end()) return false;
    tile.leaf.parts[i].material = found->second;
  }
  content = text;
  return true;
}

void KeptTiles::put(const ResultKey& key, SceneTile tile, const std::string& content) const {
  std::vector<ResultKey> looks;
  for (LeafPart& part : tile.leaf.parts) {
    looks.push_back(looks_.key_of(part.material));
    part.material = 0;
  }
  std::string bytes;
  pack(bytes, tile);
  pack(bytes, looks);
  results_.put(key, bytes + content);
}

}  // namespace bp
