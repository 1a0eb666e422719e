#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "lib/pass/leaf/scene_tiles.h"
#include "lib/store/result_store.h"

namespace bp {

/// The store of visual tiles that earlier runs made. Kept tiles name materials by what they look like, since their
/// numbers change with the scene.
class KeptTiles {
 public:
  /// Reads the looks of all triangles in `box`.
  KeptTiles(ResultStore& results, const SceneLooks& looks, const Bounds3d& box);
  /// Gets a tile and the bytes of its file; returns false if it is not there.
  bool get(const ResultKey& key, SceneTile& tile, std::string& content) const;
  void put(const ResultKey& key, SceneTile tile, const std::string& content) const;

 private:
  ResultStore& results_;
  const SceneLooks& looks_;
  std::map<ResultKey, std::uint32_t> materials_;  // their numbers
};

}  // namespace bp
