#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/box.h"

namespace bp {

/// A tile as the checks of a tileset see it (tile_cover.h).
struct CoverTile {
  std::string place, uri;                  ///< for findings
  std::optional<std::uint64_t> triangles;  ///< triangles of its content; none: nothing is drawn
  std::optional<Bounds3d> cell;            ///< scene units
  std::vector<std::size_t> children;       ///< numbers of the children, which follow their parents
  std::optional<double> leaf_error = {};   ///< set for a leaf: its largest distance from the scene
  double error = 0;                        ///< geometricError, scene units
  bool adds = false;                       ///< refined by adding: its content is drawn in addition to the tiles below
  bool is_joint = false;                   ///< no tile of the file: an octant between two tiles of different depths
};

}  // namespace bp
