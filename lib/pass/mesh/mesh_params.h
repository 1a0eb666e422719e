#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/triangle_source.h"
#include "lib/enclosed/scene_part.h"
#include "lib/grid/mirror_plane.h"
#include "lib/grid/stream.h"
#include "lib/pass/mesh/mesh_measures.h"
#include "lib/simplify/simplify_params.h"
#include "lib/tighten/tighten_params.h"

/// The parameters of the last pass of the pipe (mesh_pass.h), and its counts.
namespace bp {

class Enclosed;

/// The side of the proxy. bounding: around everything that is meshed. inside: within it, for occluders; needs a stream
/// of bpvox --fill inside. fit: near the surface, neither around it nor within (fit.h).
enum class MeshMode { bounding, inside, fit };

/// The thing that the proxy must enclose while it is tightened: the layer that is meshed, the stream's solid layer
/// (which is the scene up to a voxel), or the scene's own triangles. In mode fit, the surface that vertices move to:
/// that of the closing, or the scene where it is near.
enum class Enclose { closing, input, scene };
[[nodiscard]] constexpr const char* name_of(Enclose what) {
  return std::array{"closing", "input", "scene"}[std::size_t(what)];
}

class Limbs;
struct CageParams {
  std::optional<MirrorPlane> plane;    ///< the voxels and the cage are their own mirror images about it
  std::shared_ptr<const Limbs> limbs;  ///< of the model within its margin (lib/quads/limbs.h); null: of what is meshed
};

struct MeshParams {
  MeshMode mode = MeshMode::bounding;
  /// Number of triangles of each level, falling; each level strictly encloses the one before. Empty: one level, whose
  /// number of faces follows from the other targets.
  std::vector<std::uint64_t> faces;
  /// Largest distance of the proxy to what it encloses (proxy_limits.h), scene units; 0: none. If n levels enclose each
  /// other, the first may use 1/n of it, the second 2/n, and so on.
  double error_world = 0;
  /// In bounding mode with no other target than `faces`: no step moves a face farther from what is enclosed than this
  /// length plus a voxel, scene units, as far as so few faces allow it. Without it, steps that add little volume may
  /// move a face far out. None: there is no such limit.
  std::optional<double> near_world;
  /// The most triangles of a scene that are used to test which faces are near. With more triangles, the test by voxels
  /// is faster.
  static constexpr std::size_t kSimpleScene = 4096;
  /// In bounding mode with no other target than `faces` and without near_world: a hull or a box replaces a proxy that
  /// holds more, or has spikes (convex_proxy.h).
  bool convex = true;
  /// Largest volume, as a multiple of the meshed voxels' volume, at least 1; inside: the least volume, at most 1.
  double volume_ratio = 0;
  /// Edges are at most edge_factor times S long, where S is the scale field at the edge; 0: no limit.
  double edge_factor = 0;
  bool edges_yield = false;  ///< the factor grows if the number of faces cannot be reached otherwise
  /// In bounding mode an edge may be longer than edge_factor allows where it stays near the meshed voxels
  /// (scaled_edges.h): what is smooth and fine takes few faces. False: edge_factor is a promise for every edge.
  bool edges_by_shape = false;
  Enclose enclose = Enclose::closing;
  std::vector<TriangleD> scene;  ///< for Enclose::scene; scene units, as read
  Rounding rounding;             ///< of `scene`
  /// Replaces `scene`: made by enclosed_scene() in the frame of the stream, and its triangles lie in the stream's
  /// voxels. Not owned; null: `scene` is used.
  const Enclosed* enclosed = nullptr;
  /// A bounding proxy of the same scene with more faces, in the frame of the stream. The first level begins from it
  /// instead of the voxels' surface. Not owned; null: none.
  const LatticeMesh* start = nullptr;
  /// Receives the first level's proxy at the moment when collapses by volume replaced collapses by error: it can be the
  /// `start` of coarser levels. It stays empty if the proxy is made otherwise. Not owned; null: not needed.
  LatticeMesh* halfway = nullptr;
  /// For a bounding proxy of a part of the scene, with `near_world`: the rest of the scene may lie outside the voxels.
  std::optional<ScenePart> part;
  /// The surface that distances are measured from, if it is not that of what is enclosed; closing: the surface of the
  /// meshed layer.
  std::optional<Enclose> distances_to;
  bool tighten = true;  ///< afterwards, lower the volume without uncovering what is enclosed
  /// inside: at each level, parts whose volume is below this share of the largest part's are left out; 0: none.
  double least_part = 0;
  /// The usual share. Such a part is a tenth as wide as the largest one: it hides a hundredth of what that one hides,
  /// and costs as many triangles.
  static constexpr double kLeastPart = 1e-3;
  bool quads = false;              ///< join pairs of triangles to quads (quads.h)
  std::optional<CageParams> cage;  ///< makes one level of quads only (quad_cage.h) around what is enclosed
  bool distances = false;          ///< measure the distances between the proxies and what they enclose
  /// The quadric error at which [CB17] §3.4 stops, as a share of the scene's diagonal; used if there is no target at
  /// all.
  static constexpr double kErrorShareBall = 1e-3, kErrorShareCube = 1e-2;
};

/// The limbs of what a cage encloses (lib/quads/limbs.h).
struct LimbCounts {
  std::uint64_t count = 0;
  std::vector<Vec3d> joined;  ///< tips of those that grow together in the cage, scene units
};

struct LevelCounts {
  SimplifyCounts simplify;
  TightenCounts tighten;
  double error_world = 0;  ///< bound on the distance to what level 0 encloses, scene units; 0: none
  double edge_factor = 0;  ///< the factor that limited the edges; 0: no limit
  std::string stopped_by;  ///< the target that was reached first (faces, error, volume, edge-length), or another reason
  MeshMeasures measures;
  LimbCounts limbs;  ///< of a cage
};

struct MeshCounts {
  std::uint64_t voxels = 0;  ///< of the layer that is meshed
  /// Voxels added (inside: removed) where others touched only along an edge or at a corner.
  std::uint64_t repaired = 0;
  std::uint64_t dropped_parts = 0, dropped_voxels = 0;  ///< parts below least_part, and their volume in voxels
  /// Volume of the meshed voxels, repaired and without dropped parts; scene units cubed.
  double solid_volume_world = 0;
  std::vector<LevelCounts> levels;
};

/// Makes MeshParams::enclosed from the triangles of a scene. `solid`: their voxels, as bricks of `header`. Many proxies
/// may share the result.
[[nodiscard]] std::unique_ptr<Enclosed> enclosed_scene(std::vector<TriangleD> triangles, const Rounding& rounding,
                                                       const StreamHeader& header, const BrickShelf& solid);

}  // namespace bp
