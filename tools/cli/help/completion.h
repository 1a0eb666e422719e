#pragma once
#include <string>

#include "tools/cli/help/declaration.h"

namespace bp {

/// Returns a script that completes the tool's options, their words and the names of files. shell: bash, zsh or fish.
[[nodiscard]] std::string completion(const ToolDeclaration& tool, const std::string& shell);

}  // namespace bp
