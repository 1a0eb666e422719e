#pragma once
#include <string>

#include "tools/cli/report.h"
#include "tools/lod/build_options.h"

/// The command line of bplod.
namespace bp {

/// Parses "A..B". Throws bad_argument.
[[nodiscard]] JobRange parse_job_range(const std::string& text);

/// Throws bad_argument if options contradict each other.
[[nodiscard]] BuildOptions parse_build_options(Args& args);

/// Sets what the profile and the mode decide, and checks the levels. Throws bad_argument.
void settle(BuildOptions& options);
/// Checks the name; without one, it becomes that of the first scene. Throws bad_argument.
void check_name(BuildOptions& options);

/// Returns all options for the report, except folders and files: as they were given, or null.
[[nodiscard]] Json options_json(const BuildOptions& options);

}  // namespace bp
