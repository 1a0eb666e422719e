#pragma once
#include "io/scene/scene_file.h"

namespace bp {

/// JSON text without the megabytes that "data:...;base64," strings carry.
struct LeanJson {
  std::string text;                ///< each such string has become "data:lifted,K", or "data:dropped" for images
                                   ///< that are not asked for
  std::vector<SceneFilePtr> data;  ///< what string K held, decoded, in a scratch file
};

/// Bytes that a parsed copy of such a text takes beside it, at most.
[[nodiscard]] std::uint64_t bytes_to_parse(const std::string& text);

/// Reads `size` bytes of JSON at `offset` of `file`. Memory: the text that stays. Throws bad_input on broken base64,
/// on more than 512 MiB of other text, or if the file ends too early.
[[nodiscard]] LeanJson read_lean_json(const SceneFilePtr& file, std::uint64_t offset, std::uint64_t size,
                                      const std::string& temp_dir, bool images);

}  // namespace bp
