#pragma once
#include <string>

namespace bp {

/// Returns "; --faces is an option of bpmesh and bplod" if `tool` belongs to the pipe and other tools of the pipe have
/// this option; else nothing. `similar`: also finds misspelt names.
[[nodiscard]] std::string owner_of(const std::string& tool, const std::string& name, bool similar);

/// Returns false if `tool` belongs to the pipe and has no such option.
[[nodiscard]] bool may_have_option(const std::string& tool, const std::string& name);

}  // namespace bp
