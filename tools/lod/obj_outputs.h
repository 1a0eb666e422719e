#pragma once
#include "tools/lod/lod_outputs.h"

/// Levels as OBJ, each with a material and images beside it: BuildOptions::obj.
namespace bp {

/// Files that there may be: an image is JPEG, or PNG where it has holes.
[[nodiscard]] std::vector<std::string> obj_files(const BuildOptions& options, std::size_t levels);
/// As write_profile(); what is not needed of obj_files() is left out.
std::vector<WrittenFile> write_obj_levels(const BuildOptions& options, const std::vector<LodLevel>& levels,
                                          const Vec3d& origin, OutputFolder& out);

}  // namespace bp
