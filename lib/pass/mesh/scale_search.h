#pragma once
#include <optional>

#include "lib/device/backend.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/pass/pass_progress.h"

/// For a proxy that has more faces than were asked for, because its closing has many parts and holes: which scale would
/// leave few enough.
namespace bp {

struct ScaleSearch {
  std::uint64_t faces = 0;     ///< asked for
  bool keep_cavities = false;  ///< as bpclose was told
  PassContext context;         ///< progress: passes of each closing, and "mesh" with the number of scales done
};

/// How many times the scale of `header`, a closing by one scale, is enough: 2, 4, 8, ... Each is tried, closed and
/// meshed without tightening, until one has the faces; what cannot have them, since each part and each handle takes
/// four, is not meshed. Empty if none has up to half the scene's diagonal. `solid`: the solid layer of the stream.
/// Cost: of a closing and a simplification for each scale. Throws as close_stream() and mesh_stream().
[[nodiscard]] std::optional<int> enough_scales(const StreamHeader& header, BrickShelf& solid, Backends& backends,
                                               const ScaleSearch& search);

}  // namespace bp
