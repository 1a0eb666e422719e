#pragma once
#include "lib/hulls/convex_parts.h"
#include "tools/lod/lod_outputs.h"

/// The files of --profile collision: the body for Godot and Unity, its hulls for Unreal, and for robots.
namespace bp {

/// In the order of their commit; of the files for each hull only the first, since their number is not known before.
[[nodiscard]] std::vector<std::string> collision_files(const BuildOptions& options);

/// Faces that all hulls of a body share: those asked for; else as many as the body has, but no fewer than 64.
[[nodiscard]] std::uint64_t faces_of_hulls(const BuildOptions& options, const LatticeMesh& body);

/// Writes them; returns the files that are listed. `hulls`: around the same scene as the body. Files of hulls that an
/// earlier run wrote, and this one does not, go with --overwrite.
std::vector<WrittenFile> write_collision_files(const BuildOptions& options, const LatticeMesh& body,
                                               const ConvexParts& hulls, const Vec3d& origin, OutputFolder& out);

}  // namespace bp
