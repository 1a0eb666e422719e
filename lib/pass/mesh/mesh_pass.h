#pragma once
#include <array>
#include <memory>
#include <optional>

#include "lib/enclosed/enclosed_scene.h"
#include "lib/grid/mirror_plane.h"
#include "lib/grid/stream.h"
#include "lib/pass/context.h"
#include "lib/pass/mesh/mesh_measures.h"
#include "lib/simplify/simplify.h"
#include "lib/tighten/tighten.h"

/// The last pass of the pipe: bricks in, proxies out (bpmesh).
namespace bp {

/// bounding: around everything that is meshed. inside: within it, for occluders; of a stream of bpvox --fill inside.
/// fit: near the surface, neither around nor within (fit.h).
enum class MeshMode { bounding, inside, fit };

/// What must stay inside while the proxy is made tighter: the layer that is meshed, the stream's solid layer (the
/// scene, to a voxel), or triangles of the scene itself. Mode fit: the surface that vertices move to, which is that of
/// the closing, or the scene where it is near.
enum class Enclose { closing, input, scene };
[[nodiscard]] constexpr const char* name_of(Enclose what) {
  return std::array{"closing", "input", "scene"}[std::size_t(what)];
}

struct CageParams {
  std::optional<MirrorPlane> plane;  ///< the voxels are their own mirror image about it; so is the cage
};

struct MeshParams {
  MeshMode mode = MeshMode::bounding;
  /// Triangles wanted, one number per level, falling; each level strictly encloses the one before. Empty: one level,
  /// whose faces the other targets decide.
  std::vector<std::uint64_t> faces;
  /// Largest distance of the proxy to what it encloses (proxy_limits.h), scene units; 0: none. Of n levels that enclose
  /// each other, the first may use 1/n of it, the second 2/n, and so on.
  double error_world = 0;
  /// With nothing but `faces` wanted, in bounding mode: no step takes a face farther from what is enclosed than this
  /// and a voxel, scene units, as far as so few faces allow it. Volume alone does not mind a face far out. None: no
  /// matter how far.
  std::optional<double> near_world;
  /// Triangles of a scene, at most, that tell what is near sooner than voxels: of more, each is near a small part of a
  /// face.
  static constexpr std::size_t kSimpleScene = 4096;
  /// With nothing but `faces` wanted, in bounding mode, and not near: a hull or a box takes the place of a proxy that
  /// holds more, or has spikes (convex_proxy.h).
  bool convex = true;
  double volume_ratio = 0;   ///< largest volume, in volumes of the meshed voxels, at least 1; inside: least, at most 1
  double edge_factor = 0;    ///< edges at most edge_factor * S long, S the scale field there; 0: no limit
  bool edges_yield = false;  ///< where so few faces are not to be had otherwise, the factor grows
  Enclose enclose = Enclose::closing;
  std::vector<TriangleD> scene;  ///< for Enclose::scene; scene units, as read
  Rounding rounding;             ///< of `scene`
  /// What stays inside, in place of `scene`, as enclosed_scene() makes it in the frame of the stream: it lies in the
  /// stream's voxels. Not owned; null: `scene`.
  const Enclosed* enclosed = nullptr;
  /// A bounding proxy of more faces, in the frame of the stream, of the same scene: the first level begins from it in
  /// place of the voxels' surface. Not owned; null: none.
  const LatticeMesh* start = nullptr;
  /// Receives what the first level's proxy was when collapses by error had ended, and those by volume began: for
  /// `start` of coarser levels. It stays empty where the proxy is made otherwise. Not owned; null: nobody asks.
  LatticeMesh* halfway = nullptr;
  /// Of bounding proxies of a part of the scene, with `near`: the rest of it may lie outside the voxels.
  std::optional<ScenePart> part;
  /// What distances count from, if not from what is enclosed; closing: the surface of what is meshed.
  std::optional<Enclose> distances_to;
  bool tighten = true;  ///< afterwards, lower the volume while what is enclosed stays inside
  /// inside: parts whose volume is below this share of the largest one's are left out, at each level; 0: none.
  double least_part = 0;
  bool quads = false;              ///< join triangles in pairs (quads.h)
  std::optional<CageParams> cage;  ///< one level, of nothing but quads (quad_cage.h) around what is enclosed
  bool distances = false;          ///< measure the distances between the proxies and what they enclose
  /// With no target at all: the quadric error at which [CB17] §3.4 stops, as a share of the scene's diagonal.
  static constexpr double kErrorShareBall = 1e-3, kErrorShareCube = 1e-2;
};

struct LevelCounts {
  SimplifyCounts simplify;
  TightenCounts tighten;
  double error_world = 0;  ///< bound on the distance to what level 0 encloses, scene units; 0: none
  double edge_factor = 0;  ///< of the edges; 0: no limit
  std::string stopped_by;  ///< the target that was reached first: faces, error, volume, edge-length; or what else
  MeshMeasures measures;
};

struct MeshCounts {
  std::uint64_t voxels = 0;    ///< of the layer that is meshed
  std::uint64_t repaired = 0;  ///< voxels added (inside: taken away) where others touched only along an edge or corner
  std::uint64_t dropped_parts = 0, dropped_voxels = 0;  ///< below least_part, of the voxels
  double solid_volume_world = 0;  ///< of the meshed voxels, repaired, without those dropped; scene units cubed
  std::vector<LevelCounts> levels;
};

/// The triangles of a scene as what stays inside proxies, for MeshParams::enclosed. `solid`: their voxels, of `header`.
/// Many proxies may share it.
[[nodiscard]] std::unique_ptr<Enclosed> enclosed_scene(std::vector<TriangleD> triangles, const Rounding& rounding,
                                                       const StreamHeader& header, const BrickShelf& solid);

/// The proxies, finest first: one per number in params.faces, or one. `params` by value: the scene's triangles are
/// moved out of it. Meshes the closing layer if the stream has one, else the solid layer. Throws bad_input if that
/// layer is empty or not what the mode needs, bad_argument if the targets make no sense, out_of_resource if
/// context.pieces do not suffice for the surface, which is never whole in memory unless limits or distances need it.
[[nodiscard]] std::vector<LatticeMesh> mesh_stream(BrickSource& source, const PassContext& context, MeshParams params,
                                                   MeshCounts& counts);

/// Returns the limit on memory at which mesh_stream() has enough, if the scene has so many triangles, which need not be
/// in `params`. 0: not known. It reads the stream and takes the memory of some bricks. Asked for after a refusal: a
/// step that is refused knows what it takes itself, and the next one would be refused in the run after that.
[[nodiscard]] std::uint64_t mesh_limit(BrickSource& source, const PassContext& context, const MeshParams& params,
                                       std::uint64_t triangles);

}  // namespace bp
