#pragma once
#include "tools/lod/build.h"

/// bplod --profile occluder.
namespace bp {

void build_occluder(const BuildOptions& options);

}  // namespace bp
