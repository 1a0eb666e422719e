#pragma once
#include "tools/lod/build_options.h"

namespace bp {

/// Makes a tileset whose tiles are the scene's own triangles, or fewer of them (bplod --profile 3dtiles --mode visual):
/// nothing is voxelized, and nothing is enclosed. The scene and what is made wait in the scratch; only tiles at work
/// are in memory. Throws as build_tileset().
void build_visual_tileset(const BuildOptions& options);
/// Prints what that would make, and makes nothing.
void explain_visual_tileset(const BuildOptions& options);

}  // namespace bp
