#pragma once
#include "lib/hulls/convex_parts.h"
#include "tools/lod/lod_outputs.h"

/// Writes the files of --profile collision: the body for Godot and Unity, its hulls for Unreal and for robot
/// simulators.
namespace bp {

/// Returns the files in the order of their commit. Only the first of the hulls' own files is among them, since their
/// number is not known yet.
[[nodiscard]] std::vector<std::string> collision_files(const BuildOptions& options);

/// Returns the faces that all hulls of a body share: the number that is asked for, else the body's, but at least 64.
[[nodiscard]] std::uint64_t faces_of_hulls(const BuildOptions& options, const LatticeMesh& body);

/// Writes the files, and returns those that are listed. `hulls`: hulls around the same scene as the body. With
/// --overwrite it removes hull files of an earlier run that this run does not write.
std::vector<WrittenFile> write_collision_files(const BuildOptions& options, const LatticeMesh& body,
                                               const ConvexParts& hulls, const Vec3d& origin, OutputFolder& out);

}  // namespace bp
