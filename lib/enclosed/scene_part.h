#pragma once
#include "lib/core/box.h"
#include "lib/grid/stream.h"

namespace bp {

/// The part of a scene in a closed box (scene units), and voxels that stay inside in addition.
struct ScenePart {
  Bounds3d box;
  const BrickShelf* voxels = nullptr;  ///< may be null
};

}  // namespace bp
