#pragma once
#include "io/scene/scene_file.h"

namespace bp {

/// JSON text without the megabytes that "data:...;base64," strings carry.
struct LeanJson {
  std::string text;  ///< each such string is replaced by "data:lifted,K", or by "data:dropped" for unwanted images
  std::vector<SceneFilePtr> data;  ///< the decoded content of string K, in a scratch file
};

/// Returns the most bytes that a parsed copy of such a text takes, without the text.
[[nodiscard]] std::uint64_t bytes_to_parse(const std::string& text);

/// Reads `size` bytes of JSON at `offset` of `file`. Memory: the text that remains. Throws bad_input on broken base64,
/// on more than 512 MiB of other text, or if the file ends too early.
[[nodiscard]] LeanJson read_lean_json(const SceneFilePtr& file, std::uint64_t offset, std::uint64_t size,
                                      const std::string& temp_dir, bool images);

}  // namespace bp
