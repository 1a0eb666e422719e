#include "lib/check/check_proxy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/check/detail/cells/inside_cells.h"
#include "lib/check/detail/convex.h"
#include "lib/check/detail/distance.h"
#include "lib/check/detail/enclosure.h"
#include "lib/check/detail/faces/other_diagonals.h"
#include "lib/check/detail/gap.h"
#include "lib/check/detail/hidden.h"
#include "lib/check/detail/inside.h"
#include "lib/check/detail/surface.h"
#include "lib/core/vec3.h"
#include "lib/geometry/signed_volume.h"

namespace bp {

namespace {

/// Measures the volume, the lengths of sides (three for each triangle) and the least angle.
void measure(const WeldedMesh& mesh, CheckReport& report) {
  report.volume = 0;
  if (mesh.triangles.empty()) return;
  const Vec3d origin = mesh.corners(0)[0];
  double shortest = HUGE_VAL, longest = 0, sum = 0, least_angle = M_PI;
  SignedVolume volume(origin);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const TriangleD c = mesh.corners(t);
    volume.add(c);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d u = c[(k + 1) % 3] - c[k], v = c[(k + 2) % 3] - c[k];
      const double length = std::sqrt(dot(u, u)), area = std::sqrt(dot(cross(u, v), cross(u, v)));
      shortest = std::min(shortest, length), longest = std::max(longest, length);
      sum += length;
      if (mesh.degenerate[t] == 0) least_angle = std::min(least_angle, std::atan2(area, dot(u, v)));
    }
  }
  report.volume = volume.value();
  report.edge_min = shortest, report.edge_max = longest;
  report.edge_mean = sum / (3 * double(mesh.triangles.size()));
  report.angle_min_degrees = least_angle * 180 / M_PI;
}

/// Returns how many triangles of the scene fit into the memory: two copies while they are gathered, and their
/// hierarchy.
std::uint64_t most_kept(const CheckOptions& options) {
  return options.scene_memory_bytes / (TriangleBvh::bytes_needed(1) + 2 * sizeof(TriangleD));
}

void measure_distances(const Surface& surface, SceneMemory& scene, const CheckOptions& options, CheckReport& report) {
  if (!options.distances || surface.bvh().empty() || report.scene_triangles == 0) return;
  constexpr const char* kTooLarge = "no distances: the scene has coordinates that are too large or too small";
  if (report.undecidable_scene.count != 0) {
    report.distance_note = kTooLarge;
    return;
  }
  const SampledDistance there = distances(scene.sample().points(), surface.bvh());
  if (!std::isfinite(there.mean)) {
    report.distance_note = kTooLarge;
    return;
  }
  report.scene_to_proxy = there;
  if (!scene.has_all()) {
    report.distance_note =
        fmt::format("no distance from the proxy to the scene: {} triangles do not fit the {} MiB set aside for them",
                    report.scene_triangles, options.scene_memory_bytes >> 20);
    return;
  }
  const std::vector<TriangleD> all_of_scene = scene.take_all();
  if (all_of_scene.size() <= kMostBounded) bound_largest(all_of_scene, surface.bvh(), *report.scene_to_proxy);
  TriangleSample proxy(options.distance_samples);
  std::vector<TriangleD> all;
  for (std::size_t i = 0; i < surface.bvh().size(); ++i) {  // neighbours follow each other
    const TriangleBvh::Item& item = surface.bvh().item(i);
    proxy.see(item.id, item.corners);
    if (surface.bvh().size() <= kMostBounded) all.push_back(item.corners);
  }
  const TriangleBvh tree(all_of_scene);
  report.proxy_to_scene = distances(proxy.points(), tree);
  if (!all.empty()) bound_largest(all, tree, *report.proxy_to_scene);
}

/// Repeats the questions about what was read, once it is known by how much coordinates may be off. `cells`: cells of
/// the surface, or null.
void check_rounding(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells, TriangleSource& scene,
                    const CheckOptions& options, CheckReport& report) {
  const ClearanceQuestion question{report.scene_counts.rounding, report.proxy_off, options.margin_world,
                                   options.max_examples};
  if (!question.any()) return;
  if (report.touching.count + report.outside.count + report.swallowed.count + report.outside_parts.count > 0) {
    report.misplaced = any_misplaced(surface, scene, question, report.wants_inside);
    return;
  }
  ClearanceReport found = check_clearance(mesh, surface, cells, scene, question);
  report.within_rounding = std::move(found.within);
  if (report.too_near.count == 0) report.perhaps_near = std::move(found.within_margin);
}

void check_scene(const WeldedMesh& mesh, const Surface& surface, TriangleSource& scene, const CheckOptions& options,
                 CheckReport& report) {
  SceneMemory memory(options.distances ? options.distance_samples : 0, options.distances ? most_kept(options) : 0);
  const EnclosureQuestion question{report.sides_decided, options.margin_world, options.max_examples};
  // The triangles that are kept take a third of their share until their hierarchy is built.
  std::optional<InsideCells> cells;
  if (report.sides_decided) cells.emplace(surface, options.scene_memory_bytes / 2);
  const InsideCells* const known = cells ? &*cells : nullptr;
  const EnclosureReport e = check_enclosure(mesh, surface, known, scene, question, memory);
  report.has_scene = true;
  report.scene_name = scene.name();
  report.scene_counts = scene.counts().of_enclosed();
  report.scene_triangles = e.triangles;
  report.scene_bounds = e.bounds;
  report.touching = e.touching, report.outside = e.outside, report.undecidable_scene = e.undecidable;
  report.margin = options.margin_world;
  if (report.margin > 0 && std::isfinite(e.least_gap)) report.least_gap = e.least_gap;
  report.too_near = e.too_near, report.perhaps_near = e.perhaps_near;
  report.scene_volume = e.volume;
  report.bent = e.bent, report.bent_open = e.bent_open;
  check_rounding(mesh, surface, known, scene, options, report);
  cells.reset();
  measure_distances(surface, memory, options, report);
}

/// The largest error of a coordinate in voxels for which hiding is decided. The voxels that a triangle touches are
/// found with vertices that are rounded to 2^-16 (lib/voxel).
constexpr double kMostHiddenOff = 0x1p-20;

void check_scene_around(const WeldedMesh& mesh, const Surface& surface, TriangleSource& scene,
                        const CheckOptions& options, CheckReport& report) {
  report.has_scene = report.wants_inside = true;
  if (!report.sides_decided) return;
  const InsideReport inside = check_inside(mesh, surface, scene, options.max_examples, options.scene_memory_bytes);
  report.scene_name = scene.name();
  report.scene_counts = scene.counts();
  report.scene_triangles = inside.triangles;
  report.scene_closed = inside.scene_closed;
  report.touching = inside.touching, report.swallowed = inside.swallowed, report.outside_parts = inside.outside;
  report.unsettled_parts = inside.unsettled;
  report.undecidable_scene = inside.undecidable;
  check_rounding(mesh, surface, nullptr, scene, options, report);
  if (report.inside() || !options.hidden) return;
  const auto& [recipe, walls] = *options.hidden;
  if (!recipe.opaque_only && (report.free_of_scene() != Answer::proven || report.undecidable_scene.count > 0)) return;
  const HiddenReport hidden =
      check_hidden(mesh, surface, *walls, recipe, options.max_examples, options.scene_memory_bytes);
  report.asks_hidden = true;
  report.recipe = recipe;
  report.hidden_off = hidden.off;
  report.hidden_unknown = hidden.undecided, report.hidden_bytes = hidden.memory_bytes;
  report.exposed = hidden.exposed;
  if (report.proxy_off > kMostHiddenOff * recipe.frame.voxel && report.hidden_unknown.empty())
    report.hidden_unknown =
        fmt::format("the proxy is read to within {:.2g}, too much for these voxels", report.proxy_off);
}

void check_scene_in_parts(const WeldedMesh& mesh, const Surface& surface, TriangleSource& scene,
                          const CheckOptions& options, CheckReport& report) {
  report.has_scene = true;
  if (!report.sides_decided) return;
  const ConvexReport convex = check_convex(mesh, scene, options.max_examples, report.proxy_off);
  report.scene_name = scene.name();
  report.scene_counts = scene.counts().of_enclosed();
  report.scene_triangles = convex.triangles;
  report.scene_bounds = convex.bounds;
  report.not_held = convex.not_held, report.perhaps_not_held = convex.perhaps_not_held;
  report.undecidable_scene = convex.undecidable;
  report.within_rounding = convex.within_rounding;
  const ClearanceQuestion question{report.scene_counts.rounding, report.proxy_off, 0, options.max_examples};
  if (question.any() && report.not_held.count > 0) report.misplaced = any_misplaced(surface, scene, question, false);
}

CheckReport check_as_read(const IndexedMesh& proxy, TriangleSource* scene, const CheckOptions& options) {
  CheckReport report;
  WeldedMesh mesh = weld(proxy, options.max_examples, report);
  report.wants_convex = options.convex;
  check_topology(mesh, options.max_examples, report);
  measure(mesh, report);
  report.proxy_off = most_off(mesh.points, proxy.rounding);
  const Surface surface(mesh);
  report.self_intersections = surface.self_intersections(options.max_examples, options.convex);
  report.sides_decided = report.closed() && report.oriented();
  if (report.sides_decided) report.inverted_components = inverted_components(mesh, surface, options.max_examples);
  if (options.convex && report.sides_decided) report.nonconvex_parts = nonconvex_parts(mesh, options.max_examples);
  if (scene == nullptr) return report;
  if (options.convex) {
    check_scene_in_parts(mesh, surface, *scene, options, report);
  } else {
    (options.inside ? check_scene_around : check_scene)(mesh, surface, *scene, options, report);
  }
  return report;
}

}  // namespace

CheckReport check_proxy(const IndexedMesh& proxy, TriangleSource* scene, const CheckOptions& options) {
  CheckReport report = check_as_read(proxy, scene, options);
  if (report.bad_faces.count > 0) return report;
  const OtherDiagonals others = other_diagonals(proxy);
  report.bent_faces = others.faces();
  if (report.bent_faces == 0 || !report.holds()) return report;
  CheckOptions question = options;
  question.distances = false;
  report.bent_faces_open =
      others.larger > 0 || !may_be_mixed(proxy, others) || !check_as_read(others.mesh, scene, question).holds();
  return report;
}

}  // namespace bp
