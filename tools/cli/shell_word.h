#pragma once
#include <string>

namespace bp {

/// Returns a file's name as one word of a command line to copy: a shell reads it as one word, and a tool does not read
/// it as an option.
[[nodiscard]] std::string shell_word(const std::string& name);

}  // namespace bp
