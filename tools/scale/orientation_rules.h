#pragma once
#include <string>

#include "io/scene/scene_options.h"
#include "lib/grid/stream.h"

namespace bp {

/// Makes the orientation that a file of rules asks for, as JSON: "auto", for which the scene is read again, or frames
/// at places. Throws bad_input with the key at fault, or with the fault of the scene's files. `file`: for messages.
/// `scene`: how to read the scene again.
[[nodiscard]] OrientationField make_orientation(const std::string& json, const std::string& file,
                                                const StreamHeader& header, const ScaleField& scale,
                                                const SceneOptions& scene);

/// Returns a text such as "turned by 30 degrees about 0,0,1" or "not turned".
[[nodiscard]] std::string orientation_text(const FixedQuaternion& q);

}  // namespace bp
