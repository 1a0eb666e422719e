#include "tools/deform/least_limit.h"

#include <algorithm>

#include "io/scene/points/scene_points.h"
#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns the limit at which the scene's description and a block of weights fit.
std::uint64_t limit_of_points(std::uint64_t bytes, const SceneOptions& options, const CageCoordinates* coordinates) {
  const std::uint64_t description = options.document.limit_for(bytes);
  return coordinates == nullptr ? description : std::max(description, limit_for_blocks(bytes, *coordinates));
}

/// Returns the limit at which the whole cage fits: its reader counts the cage and refuses it, with the limit in the
/// error. If the description of the file does not fit, the reader names the limit for that first.
std::uint64_t limit_of_cage(const std::string& path, SceneOptions options) {
  options.mesh.memory.bytes = 1;
  // Nothing is left of this limit: so the limit that is named is that of the mesh alone.
  options.mesh.memory.limit.bytes = 8;
  try {
    (void)read_mesh(path, options);
  } catch (const Error& e) {
    return e.memory_bytes();
  }
  return 0;
}

/// Returns the limit at which the description of a cage's file fits.
std::uint64_t limit_of_document(const std::string& path, const SceneOptions& options) {
  return options.document.limit_for(bytes_of_points(path, options, {}));
}

/// Returns null if the cage cannot be read.
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
  const IndexedMesh& cage = weights.header().cage;  // a moved cage has as many faces as the cage of the weights
  const CageCoordinates coordinates(make_cage(cage, request.weights), weights.header().kind);
  std::uint64_t least = limit_of_points(bytes_of_points(request.scene, options, {true, frames}), options, &coordinates);
  least =
      std::max(least, options.mesh.memory.limit_for(options.mesh.needed(cage.triangles.size(), cage.vertices.size())));
  for (const std::string& path : cages) least = std::max(least, limit_of_document(path, options));
  return least;
}

}  // namespace bp
