#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/check/face_counts.h"
#include "lib/check/hiding_recipe.h"
#include "lib/core/box.h"
#include "lib/core/coords.h"
#include "lib/core/triangle_source.h"

/// The verdict of check_proxy(): what was counted, and the first few places of each kind.
namespace bp {

/// One place where something is wrong. What the numbers name depends on the finding: triangles or vertices of the
/// proxy, triangles of the scene.
struct Example {
  std::uint64_t index = 0;  ///< counted from 0, in the order of the input
  std::uint64_t other = 0;  ///< second triangle of a pair, or other end of an edge
  Vec3d position{};         ///< a point of it, scene units
};

struct Finding {
  std::uint64_t count = 0;
  std::vector<Example> examples;  ///< the first ones by number; at most CheckOptions::max_examples

  void add(const Example& e, std::size_t max_examples) {
    ++count;
    if (examples.size() < max_examples) examples.push_back(e);
  }
  /// Appends what was found behind this.
  void append(const Finding& f, std::size_t max_examples) {
    count += f.count;
    for (const Example& e : f.examples)
      if (examples.size() < max_examples) examples.push_back(e);
  }
};

/// From all points of one surface to the nearest of another: the one-sided Hausdorff distance, and the mean of samples.
struct SampledDistance {
  std::uint64_t samples = 0;
  double max = 0, mean = 0;       ///< scene units; max: of the points looked at, a lower bound
  Vec3d where{};                  ///< the point that is farthest
  std::optional<double> at_most;  ///< no point is farther, but for rounding; none: only samples were looked at
};

/// Of a question: yes and no are exact.
enum class Answer { proven, refuted, undecided };
[[nodiscard]] constexpr const char* to_string(Answer a) {
  return a == Answer::proven ? "proven" : a == Answer::refuted ? "refuted" : "not decided";
}
/// All of several: one that is refuted refutes all of them.
[[nodiscard]] constexpr Answer all_of(Answer a, Answer b) {
  if (a == Answer::refuted || b == Answer::refuted) return Answer::refuted;
  return a == Answer::undecided ? a : b;
}

struct CheckReport {
  // The proxy as a mesh. Vertices of equal position count as one, whatever the file's indices say.
  std::uint64_t vertices = 0;         ///< distinct, used by a triangle
  std::uint64_t triangles = 0;        ///< as given
  FaceCounts faces;                   ///< that the triangles were cut from
  std::uint64_t merged_vertices = 0;  ///< repeated positions in the input
  std::uint64_t components = 0;       ///< triangles connected by edges
  std::int64_t euler = 0;             ///< vertices - edges + triangles
  std::optional<std::int64_t> genus;  ///< sum over components; of a closed, oriented 2-manifold only

  std::uint64_t differing = 0;  ///< IndexedMesh::differing
  Unfollowed unfollowed;        ///< IndexedMesh::unfollowed
  Finding bad_faces;  ///< index: triangle that names a vertex that does not exist. Those that a reader left out
                      ///< (IndexedMesh::bad_faces) are counted, and no examples
  Finding non_finite_vertices;   ///< index: vertex with a NaN or infinite coordinate
  Finding undecidable_vertices;  ///< index: vertex outside the domain of exact predicates (1e-90 to 1e90, or 0)
  Finding degenerate_triangles;  ///< index: triangle of exactly zero area
  Finding duplicate_triangles;   ///< index: triangle, other: earlier one with the same three corners
  Finding boundary_edges;        ///< index, other: vertices of an edge with one triangle
  Finding misoriented_edges;     ///< index, other: vertices of an edge not used equally often in both directions
  Finding nonmanifold_edges;     ///< index, other: vertices of an edge with more than two triangles
  Finding nonmanifold_vertices;  ///< index: vertex whose triangles form more than one fan
  Finding self_intersections;    ///< index < other: triangles that meet beyond the corner or edge they share
  Finding inverted_components;   ///< index: first triangle of a closed component that no other surrounds and whose
                                 ///< signed volume is not positive

  // The scene against the proxy.
  bool has_scene = false;
  bool sides_decided = false;  ///< false: the proxy is not closed, so "outside" has no meaning and was not counted
  std::string place_unknown;   ///< why it is not known where scene and proxy lie to each other; empty: it is
  std::string scene_name;
  SceneCounts scene_counts;
  std::uint64_t scene_triangles = 0;  ///< tested: those with an area
  Bounds3d scene_bounds;              ///< of all triangles of the scene; empty if the proxy is to lie inside
  Finding touching;                   ///< index: scene triangle, other: proxy triangle that it touches or crosses
  Finding outside;                    ///< index: scene triangle that touches nothing and has winding number < 1
  Finding undecidable_scene;          ///< index: scene triangle outside the domain of exact predicates
  std::uint64_t bent = 0;       ///< polygons of the scene that are not flat, tested as the triangles that were read
  std::uint64_t bent_open = 0;  ///< those that are not proven to be enclosed over other diagonals, too

  // What was rounded as it was read (lib/core/triangle_source.h, detail/gap.h).
  double proxy_off = 0;     ///< a point of the proxy may be off by so much, scene units
  Finding within_rounding;  ///< index: scene triangle that is no farther from the proxy than both may be off; other:
                            ///< such a triangle of the proxy

  bool misplaced = false;  ///< where anything was rounded: a corner of the scene is on the wrong side of the proxy, and
                           ///< farther from it than both may be off
  // The least distance between both (gap.h).
  double margin = 0;                ///< asked for, scene units; 0: not asked
  std::optional<double> least_gap;  ///< between scene and proxy, if a margin is asked for; in doubles
  Finding too_near;                 ///< index: scene triangle, other: proxy triangle that is nearer to it
  Finding perhaps_near;             ///< the same, where doubles do not decide

  // The proxy inside the scene (inside.h).
  bool wants_inside = false;  ///< asked for, instead of enclosure
  bool scene_closed = false;
  Finding swallowed;        ///< index: scene triangle that lies inside the proxy
  Finding outside_parts;    ///< index: first triangle of a component that is seen from outside along an axis
  Finding unsettled_parts;  ///< index: first triangle of a component neither seen nor known to be enclosed

  // The proxy hidden by the scene, once openings are closed (hidden.h).
  bool asks_hidden = false;        ///< its file says how; asked if the proxy is not proven to be strictly inside
  HidingRecipe recipe;             ///< that its file names
  double hidden_off = 0;           ///< what points of the scene that hides it may be off by, scene units
  std::string hidden_unknown;      ///< why the question is not decided; empty if it is decided
  std::uint64_t hidden_bytes = 0;  ///< of memory that deciding it takes, where memory is why it is not decided
  Finding exposed;                 ///< index: proxy triangle; position: middle of a voxel there that is not hidden

  // The proxy as convex parts that may overlap (convex.h).
  bool wants_convex = false;  ///< asked for: then self-intersections are those within parts
  Finding nonconvex_parts;    ///< index: first triangle of a part, other: a vertex of it beyond one of its triangles
  Finding not_held;           ///< index: scene triangle with a point in no open part
  Finding perhaps_not_held;   ///< index: scene triangle of which that is not decided: parts overlap too little there

  // Measures, in doubles.
  std::optional<double> volume, scene_volume;  ///< cubed scene units; none if open, or not asked (SignedVolume)
  double edge_min = 0, edge_mean = 0, edge_max = 0;
  double angle_min_degrees = 0;
  std::optional<SampledDistance> scene_to_proxy, proxy_to_scene;
  std::string distance_note;  ///< why a distance is missing

  [[nodiscard]] bool empty() const { return triangles == 0; }
  [[nodiscard]] bool readable() const {
    return !empty() && bad_faces.count == 0 && non_finite_vertices.count == 0 && undecidable_vertices.count == 0;
  }
  [[nodiscard]] bool sound() const { return degenerate_triangles.count == 0 && duplicate_triangles.count == 0; }
  [[nodiscard]] bool closed() const { return readable() && boundary_edges.count == 0; }
  [[nodiscard]] bool oriented() const { return misoriented_edges.count == 0; }
  [[nodiscard]] bool manifold() const { return nonmanifold_edges.count == 0 && nonmanifold_vertices.count == 0; }
  [[nodiscard]] bool embedded() const { return self_intersections.count == 0; }
  [[nodiscard]] bool outward() const { return inverted_components.count == 0; }
  /// Strict: every scene triangle, boundary included, lies in the open interior of the proxy.
  [[nodiscard]] Answer enclosure() const {
    if (!has_scene || !sides_decided || !place_unknown.empty()) return Answer::undecided;
    if (touching.count + outside.count + not_held.count > 0) return surely(Answer::refuted);
    return undecidable_scene.count + perhaps_not_held.count + within_rounding.count > 0 || is_partial()
               ? Answer::undecided
               : Answer::proven;
  }
  /// No point of the scene is nearer to the proxy's surface than `margin`.
  [[nodiscard]] Answer keeps_margin() const {
    if (!place_unknown.empty()) return Answer::undecided;
    if (too_near.count > 0) return surely(Answer::refuted);
    return perhaps_near.count + undecidable_scene.count > 0 || is_partial() ? Answer::undecided : Answer::proven;
  }
  /// Whether the files hold more than was compared, or hold it elsewhere.
  [[nodiscard]] bool is_partial() const { return scene_counts.is_partial() || unfollowed.any(); }
  /// A part of the proxy that is missing may enclose what seems to be outside.
  [[nodiscard]] bool may_lie_elsewhere() const { return scene_counts.unfollowed.moves() || unfollowed.any(); }
  /// A NO about places is not sure where programs may draw the scene or the proxy elsewhere. Where reading has rounded
  /// coordinates, it is sure only if a corner shows it from farther away.
  [[nodiscard]] Answer surely(Answer as_read) const {
    if (may_lie_elsewhere()) return Answer::undecided;
    return scene_counts.rounding.most + proxy_off > 0 && !misplaced ? Answer::undecided : as_read;
  }
  [[nodiscard]] bool encloses() const { return enclosure() == Answer::proven; }
  [[nodiscard]] bool convex() const { return sides_decided && nonconvex_parts.count == 0; }
  /// Strict: the solid of the proxy meets no scene triangle, and every path to it from far away crosses the scene.
  [[nodiscard]] Answer insideness() const {
    if (!has_scene || !sides_decided || !place_unknown.empty()) return Answer::undecided;
    if (touching.count + swallowed.count > 0) return surely(Answer::refuted);
    if (undecidable_scene.count > 0 || is_partial())
      return Answer::undecided;  // what is left out may be what hides a part
    if (outside_parts.count > 0) return surely(Answer::refuted);
    return unsettled_parts.count + within_rounding.count > 0 ? Answer::undecided : Answer::proven;
  }
  /// Part of insideness(): the solid of the proxy meets no scene triangle.
  [[nodiscard]] Answer free_of_scene() const {
    if (!place_unknown.empty()) return Answer::undecided;
    if (touching.count + swallowed.count > 0) return surely(Answer::refuted);
    return within_rounding.count > 0 || unfollowed.any() ? Answer::undecided : Answer::proven;
  }
  [[nodiscard]] bool inside() const { return insideness() == Answer::proven; }
  /// Only if asks_hidden.
  [[nodiscard]] Answer hiddenness() const {
    if (!hidden_unknown.empty() || !place_unknown.empty()) return Answer::undecided;
    if (exposed.count > 0) return may_lie_elsewhere() ? Answer::undecided : Answer::refuted;
    return is_partial() ? Answer::undecided : Answer::proven;
  }
  /// As a mesh, without the scene.
  [[nodiscard]] Answer soundness() const {
    if (empty() || bad_faces.count + non_finite_vertices.count > 0) return Answer::refuted;
    if (!sound() || !embedded() || !outward() || nonconvex_parts.count > 0) return Answer::refuted;
    const Answer edges =
        all_of(all_of(on_edges(boundary_edges.count == 0), on_edges(oriented())), on_edges(manifold()));
    return undecidable_vertices.count + differing > 0 || unfollowed.any() ? all_of(edges, Answer::undecided) : edges;
  }
  /// Triangles at undecidable vertices are left out of all counts of edges: what is missing there is no failure then.
  [[nodiscard]] Answer on_edges(bool fine) const {
    if (fine) return Answer::proven;
    return undecidable_vertices.count > 0 ? Answer::undecided : Answer::refuted;
  }
  /// Of all that was asked.
  [[nodiscard]] Answer answer() const {
    if (!has_scene) return soundness();
    const Answer place = all_of(soundness(), asks_hidden ? hiddenness() : wants_inside ? insideness() : enclosure());
    return margin > 0 ? all_of(place, keeps_margin()) : place;
  }
  [[nodiscard]] bool holds() const { return answer() == Answer::proven; }
};

}  // namespace bp
