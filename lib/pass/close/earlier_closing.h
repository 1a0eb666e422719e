#pragma once
#include <memory>

#include "lib/grid/stream.h"

namespace bp {

/// A closing that close_stream() made of the same solid, with the same element and orientation, and with another scale.
struct EarlierClosing {
  ScaleField scale;
  std::shared_ptr<const BrickShelf> voxels;
  std::shared_ptr<const BrickShelf> filled;  ///< the voxels of its cavities, which were filled
};

}  // namespace bp
