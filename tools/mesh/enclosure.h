#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lib/core/triangle_source.h"
#include "lib/pass/mesh/mesh_params.h"
#include "tools/cli/options/mesh.h"

/// The set that --enclose of bpmesh asks for, read from its files.
namespace bp {

/// The facts that are known before a brick is read.
struct EnclosureInput {
  const StreamHeader& header;
  MeshMode mode = MeshMode::bounding;
  bool has_error = false;  ///< --error was given
  bool distances = false;  ///< distances to the scene will be measured
  PieceMemory memory;      ///< memory that the scene's triangles may take
  std::string temp_dir = {};
  TriangleSource* scene = nullptr;  ///< the scene that the stream was made from; null: files that the header names
  /// Returns a limit on memory at which so many triangles of the scene leave enough for what comes after them. It is
  /// asked after a refusal.
  std::function<std::uint64_t(std::uint64_t triangles)> limit{};
};

struct Enclosure {
  Enclose what = Enclose::closing;
  std::vector<TriangleD> scene;  ///< for Enclose::scene
  Rounding rounding;             ///< of its triangles
  /// Tells why `automatic` does not use the scene's triangles, or which content of named files was not read; empty:
  /// nothing to tell.
  std::string note;
};

/// Chooses the enclosed set, and reads the scene's triangles if they are it. For a bounding proxy, `automatic` chooses
/// the scene's triangles if they are known and the same as those of the stream: `scene` is given, or the stream names
/// its files and these hold them. There may be at most kMostEnclosedTriangles of them. Without such triangles it
/// chooses the scene's voxels. A fit takes the closing instead of the voxels; it takes no triangles if it has an error
/// or follows a closing by cubes. A proxy inside the scene always takes the closing. The choice does not depend on the
/// memory. Throws out_of_resource if the triangles do not fit in memory, bad_input if `scene` or files are not what the
/// stream was made from.
[[nodiscard]] Enclosure make_enclosure(const EncloseOption& option, const EnclosureInput& input);

}  // namespace bp
