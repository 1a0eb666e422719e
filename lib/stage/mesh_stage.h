#pragma once
#include "lib/grid/stream.h"
#include "lib/meshing/simplify.h"
#include "lib/meshing/tighten.h"

/// The last stage of the pipe: bricks in, proxy out (bpmesh).
namespace bp {

/// What must stay inside while the proxy is made tighter: the layer that is meshed, the stream's solid layer (the
/// scene, to a voxel), or triangles of the scene itself.
enum class Enclose { closing, input, scene };

struct MeshParams {
  std::uint64_t faces = 0;  ///< triangles wanted; 0: none
  double error_world =
      0;  ///< largest root mean square distance of a collapse to the planes it merges, scene units; 0: none
  double edge_factor = 0;  ///< edges at most edge_factor * S long, S the scale field there; 0: no limit
  Enclose enclose = Enclose::closing;
  std::vector<TriangleD> scene;  ///< for Enclose::scene; scene units, as read
  bool tighten = true;           ///< afterwards, lower the volume while the meshed voxels stay inside
  /// With neither faces nor error: the error at which [CB17] §3.4 stops, as a share of the scene's diagonal.
  static constexpr double kErrorShareBall = 1e-3, kErrorShareCube = 1e-2;
};

struct MeshCounts {
  std::uint64_t voxels = 0;    ///< of the layer that is meshed
  std::uint64_t repaired = 0;  ///< voxels added where others touched only along an edge or at a corner
  SimplifyCounts simplify;
  TightenCounts tighten;
  double volume_world = 0;        ///< of the proxy, scene units cubed
  double solid_volume_world = 0;  ///< of the meshed voxels
};

/// `params` by value: the scene's triangles are moved out of it.
/// Meshes the closing layer if the stream has one, else the solid layer. Throws bad_input if that layer is empty.
[[nodiscard]] LatticeMesh mesh_stream(BrickSource& source, const ShelfFactory& make_shelf, MeshParams params,
                                      MeshCounts& counts);

}  // namespace bp
