#include "tools/deform/least_limit.h"

#include <algorithm>

#include "io/scene/points/scene_points.h"
#include "lib/core/error.h"

namespace bp {

namespace {

/// The limit at which the scene's description fits, and a block of weights beside it.
std::uint64_t limit_of_points(std::uint64_t bytes, const SceneOptions& options, const CageCoordinates* coordinates) {
  const std::uint64_t description = options.document.limit_for(bytes);
  return coordinates == nullptr ? description : std::max(description, limit_for_blocks(bytes, *coordinates));
}

/// The limit at which the whole cage fits: its reader counts it and refuses. The description that is named first, if
/// that is what does not fit.
std::uint64_t limit_of_cage(const std::string& path, SceneOptions options) {
  options.mesh.memory.bytes = 1;
  options.mesh.memory.limit.bytes = 8;  // of which nothing is left: the limit that is named is for the mesh alone
  try {
    (void)read_mesh(path, options);
  } catch (const Error& e) {
    return e.memory_bytes();
  }
  return 0;
}

/// The limit at which the description of a cage's file fits.
std::uint64_t limit_of_document(const std::string& path, const SceneOptions& options) {
  return options.document.limit_for(bytes_of_points(path, options, {}));
}

/// Null if the cage cannot be read.
std::unique_ptr<const CageCoordinates> coordinates_of(const BindRequest& request) {
  try {
    return std::make_unique<const CageCoordinates>(
        make_cage(read_mesh(request.cage, request.scene_options), request.cage), request.kind);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

std::uint64_t least_limit(const BindRequest& request) {
  const SceneOptions& options = request.scene_options;
  const auto coordinates = coordinates_of(request);
  return std::max({limit_of_points(bytes_of_points(request.scene, options, {}), options, coordinates.get()),
                   limit_of_cage(request.cage, options), limit_of_document(request.cage, options)});
}

std::uint64_t least_limit(const ApplyRequest& request, std::span<const std::string> cages, std::size_t frames) {
  const SceneOptions& options = request.scene_options;
  const WeightReader weights(request.weights);
  const IndexedMesh& cage = weights.header().cage;  // a moved cage has as many faces
  const CageCoordinates coordinates(make_cage(cage, request.weights), weights.header().kind);
  std::uint64_t least = limit_of_points(bytes_of_points(request.scene, options, {true, frames}), options, &coordinates);
  least =
      std::max(least, options.mesh.memory.limit_for(options.mesh.needed(cage.triangles.size(), cage.vertices.size())));
  for (const std::string& path : cages) least = std::max(least, limit_of_document(path, options));
  return least;
}

}  // namespace bp
