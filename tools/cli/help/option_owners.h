#pragma once
#include <string>

namespace bp {

/// "; --faces is an option of bpmesh and bplod", if another tool of the pipe has this option and `tool` belongs to the
/// pipe, too; else nothing. `similar`: also finds misspelt names.
[[nodiscard]] std::string owner_of(const std::string& tool, const std::string& name, bool similar);

/// False if `tool` belongs to the pipe and has no such option.
[[nodiscard]] bool may_have_option(const std::string& tool, const std::string& name);

}  // namespace bp
