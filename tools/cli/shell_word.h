#pragma once
#include <string>

namespace bp {

/// The name of a file as one word of a command line to copy: a shell takes it for one word, and a tool for no option.
[[nodiscard]] std::string shell_word(const std::string& name);

}  // namespace bp
