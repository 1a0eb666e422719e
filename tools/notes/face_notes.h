#pragma once
#include <cstdint>
#include <string>

#include "lib/pass/mesh/mesh_pass.h"

/// What a user should know of a mesh that has not the faces wanted.
namespace bp {

/// What the advice of a note depends on.
struct FaceAdvice {
  MeshMode mode = MeshMode::bounding;
  std::string scale = "--scale";  ///< how the reader names the scale: bpmesh has no such option; empty: there is none
  bool exact = false;             ///< the mesh is the scene, but for rounding: nothing shows more of it
};

/// Of a mesh with clearly fewer faces than were asked for: merging edges ends there, so there never were as many.
/// Empty if there are about as many, or more. One line.
[[nodiscard]] std::string too_few_note(std::uint64_t faces, std::uint64_t asked, const FaceAdvice& advice = {});

/// Of a mesh with clearly fewer faces than were asked for, because those tried with more leave more volume. Empty as
/// above.
[[nodiscard]] std::string least_volume_note(std::uint64_t faces, std::uint64_t asked, const FaceAdvice& advice = {});

/// Why merging ended by itself, and what there is to be done: parts (shells) and handles are kept, if there are any to
/// speak of, and a larger scale does to an opening what is the opposite of what it does to a closing.
[[nodiscard]] std::string merged_note(std::uint64_t faces, std::uint64_t shells, std::uint64_t handles,
                                      const FaceAdvice& advice);

/// Of a mesh whose faces are so few for what they stand for that its volume is far from it. `ratio`: of its volume to
/// that of the voxels that are meshed. Empty if that is near 1, or for a fit. One line.
[[nodiscard]] std::string loose_note(std::uint64_t faces, double ratio, std::uint64_t shells, std::uint64_t handles,
                                     const FaceAdvice& advice);

}  // namespace bp
