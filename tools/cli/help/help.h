#pragma once
#include <string>

#include "tools/cli/help/declaration.h"

namespace bp {

/// Returns the options that most people need, by group; about 25 lines of at most 80 columns.
[[nodiscard]] std::string short_help(const ToolDeclaration& tool);
/// Returns all options, by group.
[[nodiscard]] std::string full_help(const ToolDeclaration& tool);
/// Returns the section "Options" of the tool's manual: Markdown, without its heading.
[[nodiscard]] std::string markdown_help(const ToolDeclaration& tool);

}  // namespace bp
