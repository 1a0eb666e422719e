#pragma once
#include "tools/cli/args.h"
#include "tools/lod/build_options.h"

namespace bp {

/// Refuses options that --mode visual has no use for. Throws bad_argument.
void check_visual(const Args& args, const BuildOptions& options);

}  // namespace bp
