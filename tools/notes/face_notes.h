#pragma once
#include <cstdint>
#include <string>

#include "lib/pass/mesh/mesh_params.h"

/// Notes on a mesh that does not have the wanted number of faces.
namespace bp {

/// The volume of a mesh over that of the voxels from which the mesh is loose.
constexpr double kLoose = 2;

/// Facts that the advice of a note depends on.
struct FaceAdvice {
  MeshMode mode = MeshMode::bounding;
  std::string scale = "--scale";  ///< name of the scale for the reader: bpmesh has no such option; empty: there is none
  bool exact = false;             ///< the mesh equals the scene, apart from rounding: more faces would show no more
};

/// Returns a note for a mesh with clearly fewer faces than were asked for: merging edges never had as many. Empty if
/// there are about as many, or more. One line.
[[nodiscard]] std::string too_few_note(std::uint64_t faces, std::uint64_t asked, const FaceAdvice& advice = {});

/// Returns a note for a mesh with clearly fewer faces than were asked for, because meshes with more faces had more
/// volume. Empty as in too_few_note().
[[nodiscard]] std::string least_volume_note(std::uint64_t faces, std::uint64_t asked, const FaceAdvice& advice = {});

/// Returns why merging ended by itself, and what to do. Merging keeps parts (shells) and handles; the note names them
/// if there are several. With --mode inside the advice is another: there a larger scale takes narrow parts away, while
/// in a closing it joins parts.
[[nodiscard]] std::string merged_note(std::uint64_t faces, std::uint64_t shells, std::uint64_t handles,
                                      const FaceAdvice& advice);

/// Returns a note for a mesh whose volume is far too large because it has few faces. `ratio`: its volume over that of
/// the voxels that are meshed. Empty if the ratio is near 1, or for a fit. One line.
[[nodiscard]] std::string loose_note(std::uint64_t faces, double ratio, std::uint64_t shells, std::uint64_t handles,
                                     const FaceAdvice& advice);

}  // namespace bp
