#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lib/grid/stream.h"

namespace bp {

/// The orientation of cubes that a file of rules asks for (docs/bpscale.1.md, "Cubes that are turned").
struct OrientationRules {
  struct Frame {
    Vec3d at;                   ///< scene units
    std::array<Vec3d, 3> axes;  ///< at right angles, of unit length
  };
  std::vector<Frame> frames;  ///< none: cubes stand as the surfaces of the scene do ("auto")
};

/// Parses the value of the key `orientation`. Throws bad_input with the fault; `file`: for messages.
[[nodiscard]] OrientationRules parse_orientation(const std::string& json, const std::string& file);

/// Calls the function with each triangle of a scene.
using TriangleReader = std::function<void(const std::function<void(const TriangleD&)>& take)>;

/// Makes the field for a closing of the grid of `header` by cubes of about this scale. `read_scene` is called only if
/// the rules name no frame; its errors are passed on.
[[nodiscard]] OrientationField make_orientation(const OrientationRules& rules, const StreamHeader& header,
                                                double scale_world, const TriangleReader& read_scene);

}  // namespace bp
