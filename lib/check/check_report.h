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

/// The verdict of check_proxy(): the counts, and the first few places of each kind of fault.
namespace bp {

/// One place of a fault. Its numbers belong to triangles or vertices of the proxy, or to triangles of the scene, as the
/// finding says.
struct Example {
  std::uint64_t index = 0;  ///< counted from 0, in the order of the input
  std::uint64_t other = 0;  ///< number of the second triangle of a pair, or of the other end of an edge
  Vec3d position{};         ///< a point of the place, scene units
};

struct Finding {
  std::uint64_t count = 0;
  bool at_least = false;          ///< counting ended early: there may be more than `count`
  std::vector<Example> examples;  ///< the first ones by number; at most CheckOptions::max_examples

  void add(const Example& e, std::size_t max_examples) {
    ++count;
    if (examples.size() < max_examples) examples.push_back(e);
  }
  /// Appends the examples of a later part of the input, and adds its count.
  void append(const Finding& f, std::size_t max_examples) {
    count += f.count;
    at_least |= f.at_least;
    for (const Example& e : f.examples)
      if (examples.size() < max_examples) examples.push_back(e);
  }
};

/// The distance from all points of one surface to another: its maximum, which is the one-sided Hausdorff distance, and
/// the mean of samples.
struct SampledDistance {
  std::uint64_t samples = 0;
  double max = 0, mean = 0;       ///< scene units; max: the maximum over samples, a lower bound
  Vec3d where{};                  ///< the point that is farthest
  std::optional<double> at_most;  ///< an upper bound up to rounding; none: only samples were measured
};

/// The answer to a question. Yes and no are exact.
enum class Answer { proven, refuted, undecided };
[[nodiscard]] constexpr const char* to_string(Answer a) {
  return a == Answer::proven ? "proven" : a == Answer::refuted ? "refuted" : "not decided";
}
/// Returns whether all of several answers are yes: one that is refuted refutes all of them.
[[nodiscard]] constexpr Answer all_of(Answer a, Answer b) {
  if (a == Answer::refuted || b == Answer::refuted) return Answer::refuted;
  return a == Answer::undecided ? a : b;
}

struct CheckReport {
  // The proxy as a mesh. Vertices of equal position count as one, even if the file numbers them differently.
  std::uint64_t vertices = 0;         ///< distinct ones that a triangle uses
  std::uint64_t triangles = 0;        ///< as given
  FaceCounts faces;                   ///< the faces that the triangles were cut from
  std::uint64_t merged_vertices = 0;  ///< repeated positions in the input
  std::uint64_t components = 0;       ///< sets of triangles that edges connect
  std::int64_t euler = 0;  ///< vertices - edges + triangles; a vertex of several convex parts counts for each
  std::optional<std::int64_t> genus;  ///< sum over components; only for a closed, oriented 2-manifold

  std::uint64_t differing = 0;  ///< IndexedMesh::differing
  Unfollowed unfollowed;        ///< IndexedMesh::unfollowed
  /// index: triangle that names a vertex that does not exist. Triangles that a reader left out (IndexedMesh::bad_faces)
  /// are only counted.
  Finding bad_faces;
  Finding non_finite_vertices;   ///< index: vertex with a NaN or infinite coordinate
  Finding undecidable_vertices;  ///< index: vertex outside the domain of exact predicates (1e-90 to 1e90, or 0)
  Finding degenerate_triangles;  ///< index: triangle of exactly zero area
  Finding duplicate_triangles;   ///< index: triangle, other: earlier one with the same three corners
  Finding boundary_edges;        ///< index, other: vertices of an edge with one triangle
  Finding misoriented_edges;     ///< index, other: vertices of an edge not used equally often in both directions
  Finding nonmanifold_edges;     ///< index, other: vertices of an edge with more than two triangles
  Finding nonmanifold_vertices;  ///< index: vertex whose triangles form more than one fan, of one part if parts are
                                 ///< asked for
  Finding self_intersections;  ///< index < other: triangles that meet beyond what they share; of each, 200 are counted
                               ///< at most
  /// Index: first triangle of a closed component that no other surrounds and whose signed volume is not positive.
  Finding inverted_components;

  std::uint64_t bent_faces = 0;  ///< faces of the proxy that are not flat
  /// The proxy holds as it was read, and is not proven to if programs draw these faces over other diagonals.
  bool bent_faces_open = false;

  // The scene against the proxy.
  bool has_scene = false;
  bool sides_decided = false;  ///< false: the proxy is not closed, so "outside" has no meaning and was not counted
  std::string place_unknown;   ///< why the places of scene and proxy are not known; empty if they are
  std::string scene_name;
  SceneCounts scene_counts;
  std::uint64_t scene_triangles = 0;  ///< tested triangles, which are those with an area
  Bounds3d scene_bounds;              ///< box of all triangles of the scene; empty if the proxy must lie inside
  Finding touching;                   ///< index: scene triangle, other: proxy triangle that it touches or crosses
  Finding outside;                    ///< index: scene triangle that touches nothing and has winding number < 1
  Finding undecidable_scene;          ///< index: scene triangle outside the domain of exact predicates
  std::uint64_t bent = 0;  ///< polygons of the scene that are not flat, tested as the triangles that were read
  /// The bent polygons that are not proven to be enclosed if they are drawn over other diagonals.
  std::uint64_t bent_open = 0;

  // Findings on coordinates that were rounded when they were read (lib/core/triangle_source.h, detail/gap.h).
  double proxy_off = 0;  ///< the largest error of a point of the proxy, scene units
  /// Index: scene triangle that is no farther from the proxy than both may be off; other: such a triangle of the proxy.
  Finding within_rounding;
  /// Only if coordinates were rounded: a corner of the scene is on the wrong side of the proxy, and farther from it
  /// than both may be off.
  bool misplaced = false;

  // The least distance between scene and proxy (gap.h).
  double margin = 0;                ///< the distance asked for, scene units; 0: not asked
  std::optional<double> least_gap;  ///< between scene and proxy, if a margin is asked for; in doubles
  Finding too_near;                 ///< index: scene triangle, other: proxy triangle that is nearer to it
  Finding perhaps_near;             ///< the same, if doubles cannot decide it

  // The proxy inside the scene (inside.h).
  bool wants_inside = false;  ///< this is asked instead of enclosure
  bool scene_closed = false;
  Finding swallowed;        ///< index: scene triangle that lies inside the proxy
  Finding outside_parts;    ///< index: first triangle of a component that is seen from outside along an axis
  Finding unsettled_parts;  ///< index: first triangle of a component that is neither seen nor proven to be enclosed

  // The proxy hidden by the scene, once openings are closed (hidden.h).

  /// The proxy's file says how; asked if the proxy is not proven to be strictly inside.
  bool asks_hidden = false;
  HidingRecipe recipe;             ///< the recipe that the proxy's file names
  double hidden_off = 0;           ///< how far points of the scene that hides the proxy may be off, scene units
  std::string hidden_unknown;      ///< why the question is not decided; empty if it is decided
  std::uint64_t hidden_bytes = 0;  ///< bytes that deciding it takes, if the memory is the reason why it is not decided
  Finding exposed;                 ///< index: proxy triangle; position: middle of a voxel there that is not hidden

  // The proxy as convex parts that may overlap (convex.h).
  bool wants_convex = false;  ///< this is asked; then self-intersections are those within parts
  Finding nonconvex_parts;    ///< index: first triangle of a part, other: a vertex of it beyond one of its triangles
  Finding not_held;           ///< index: scene triangle with a point in no open part
  /// Index: scene triangle for which it is not decided, since parts overlap too little there.
  Finding perhaps_not_held;

  // Measures, in doubles.

  /// Cubed scene units; none if a mesh is open, or if it was not asked for (SignedVolume).
  std::optional<double> volume, scene_volume;
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
  [[nodiscard]] bool embedded() const { return self_intersections.count == 0 && !pairs_open(); }
  /// Returns whether the search for intersections was given up, since too many boxes of triangles overlap.
  [[nodiscard]] bool pairs_open() const { return self_intersections.count == 0 && self_intersections.at_least; }
  [[nodiscard]] bool outward() const { return inverted_components.count == 0; }
  /// Returns whether every scene triangle with its boundary lies in the open interior of the proxy.
  [[nodiscard]] Answer enclosure() const {
    if (!has_scene || !sides_decided || !place_unknown.empty()) return Answer::undecided;
    if (touching.count + outside.count + not_held.count > 0) return surely(Answer::refuted);
    return undecidable_scene.count + perhaps_not_held.count + within_rounding.count > 0 || is_partial()
               ? Answer::undecided
               : Answer::proven;
  }
  /// Returns whether no point of the scene is nearer to the proxy's surface than `margin`.
  [[nodiscard]] Answer keeps_margin() const {
    if (!place_unknown.empty()) return Answer::undecided;
    if (too_near.count > 0) return surely(Answer::refuted);
    return perhaps_near.count + undecidable_scene.count > 0 || is_partial() ? Answer::undecided : Answer::proven;
  }
  /// Returns whether the files hold more than was compared, or hold it elsewhere.
  [[nodiscard]] bool is_partial() const { return scene_counts.is_partial() || unfollowed.any(); }
  /// Returns whether scene or proxy may lie elsewhere: a part of the proxy that was not followed may enclose what seems
  /// to be outside.
  [[nodiscard]] bool may_lie_elsewhere() const {
    return scene_counts.unfollowed.moves() || unfollowed.draws_elsewhere();
  }
  /// Returns a NO about places if it is sure. It is not sure if programs may draw the scene or the proxy elsewhere, or
  /// if coordinates were rounded and no corner shows it from farther away than the rounding.
  [[nodiscard]] Answer surely(Answer as_read) const {
    if (may_lie_elsewhere()) return Answer::undecided;
    return scene_counts.rounding.most + proxy_off > 0 && !misplaced ? Answer::undecided : as_read;
  }
  [[nodiscard]] bool encloses() const { return enclosure() == Answer::proven; }
  [[nodiscard]] bool convex() const { return sides_decided && nonconvex_parts.count == 0; }
  /// Returns whether the proxy lies strictly inside: its solid meets no scene triangle, and every path to it from far
  /// away crosses the scene.
  [[nodiscard]] Answer insideness() const {
    if (!has_scene || !sides_decided || !place_unknown.empty()) return Answer::undecided;
    if (touching.count + swallowed.count > 0) return surely(Answer::refuted);
    if (undecidable_scene.count > 0 || is_partial())
      return Answer::undecided;  // the missing parts may be the ones that hide this part
    if (outside_parts.count > 0) return surely(Answer::refuted);
    return unsettled_parts.count + within_rounding.count > 0 ? Answer::undecided : Answer::proven;
  }
  /// Returns whether the solid of the proxy meets no scene triangle, which is a part of insideness().
  [[nodiscard]] Answer free_of_scene() const {
    if (!place_unknown.empty()) return Answer::undecided;
    if (touching.count + swallowed.count > 0) return surely(Answer::refuted);
    return within_rounding.count > 0 || unfollowed.any() ? Answer::undecided : Answer::proven;
  }
  [[nodiscard]] bool inside() const { return insideness() == Answer::proven; }
  /// Returns whether the scene hides the proxy. Only if asks_hidden.
  [[nodiscard]] Answer hiddenness() const {
    if (!hidden_unknown.empty() || !place_unknown.empty()) return Answer::undecided;
    if (exposed.count > 0) return may_lie_elsewhere() ? Answer::undecided : Answer::refuted;
    SceneCounts walls = scene_counts;
    walls.unfollowed.hidden = 0;  // walls leave out what is hidden
    return walls.is_partial() || unfollowed.any() ? Answer::undecided : Answer::proven;
  }
  /// Returns whether the proxy is sound as a mesh, without the scene.
  [[nodiscard]] Answer soundness() const {
    if (empty() || bad_faces.count + non_finite_vertices.count > 0) return Answer::refuted;
    if (!sound() || self_intersections.count > 0 || !outward() || nonconvex_parts.count > 0) return Answer::refuted;
    const Answer edges =
        all_of(all_of(on_edges(boundary_edges.count == 0), on_edges(oriented())), on_edges(manifold()));
    const bool open = undecidable_vertices.count + differing > 0 || unfollowed.any() || pairs_open();
    return open ? all_of(edges, Answer::undecided) : edges;
  }
  /// Returns the answer to a question about edges. Triangles at undecidable vertices are left out of all counts of
  /// edges, so a missing triangle there is no failure.
  [[nodiscard]] Answer on_edges(bool fine) const {
    if (fine) return Answer::proven;
    return undecidable_vertices.count > 0 ? Answer::undecided : Answer::refuted;
  }
  /// Returns the answer to everything that was asked.
  [[nodiscard]] Answer answer() const {
    const Answer mesh = bent_faces_open ? all_of(soundness(), Answer::undecided) : soundness();
    if (!has_scene) return mesh;
    const Answer place = all_of(mesh, asks_hidden ? hiddenness() : wants_inside ? insideness() : enclosure());
    return margin > 0 ? all_of(place, keeps_margin()) : place;
  }
  [[nodiscard]] bool holds() const { return answer() == Answer::proven; }
};

}  // namespace bp
