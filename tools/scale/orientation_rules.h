#pragma once
#include <string>

#include "lib/grid/stream.h"

namespace bp {

/// What a file of rules says of the orientation, as JSON: "auto", for which the scene is read again, or frames at
/// places. Throws bad_input with the key at fault, or with what is wrong with the scene's files. `file`: for messages.
[[nodiscard]] OrientationField make_orientation(const std::string& json, const std::string& file,
                                                const StreamHeader& header, const ScaleField& scale);

/// "turned by 30 degrees about 0,0,1"; "not turned".
[[nodiscard]] std::string orientation_text(const FixedQuaternion& q);

}  // namespace bp
