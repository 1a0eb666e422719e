#include "lib/check/detail/inside.h"

#include <optional>

#include "lib/check/detail/edge_sum.h"
#include "lib/check/detail/hiding.h"
#include "lib/core/parallel.h"
#include "lib/exact/predicates.h"
#include "lib/geometry/crossing.h"

namespace bp {

namespace {

/// A point of a component of the proxy, and the winding number of the scene around it.
struct Probe {
  Vec3d point;
  std::uint64_t triangle;  // the component's first triangle
  std::int64_t winding = 0;
};

std::vector<Probe> probes_of(const WeldedMesh& mesh) {
  std::vector<Probe> probes;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.component[t] == probes.size()) probes.push_back({mesh.corners(t)[0], mesh.number[t]});
  }
  return probes;
}

/// The sums of the edges of triangles with an area, and of the others.
struct SceneEdges {
  explicit SceneEdges(const EdgeKey& key) : plain(key), degenerate(key) {}
  EdgeSum plain, degenerate;
  void add(const SceneEdges& e) { plain.add(e.plain), degenerate.add(e.degenerate); }
  /// Returns whether either sum shows that the surface is closed as a set of points.
  [[nodiscard]] bool closed() const {
    EdgeSum all = plain;
    all.add(degenerate);
    return plain.zero() || all.zero();
  }
};

struct InsideBatch {
  std::vector<TriangleD> triangles;
  InsideReport result;
  std::vector<std::int64_t> windings;
  std::optional<SceneEdges> edges;
};

/// Checks a batch, in which triangles are numbered from 0.
void check_batch(const WeldedMesh& mesh, const Surface& surface, const std::vector<Probe>& probes, const EdgeKey& key,
                 std::size_t max_examples, InsideBatch& batch) {
  batch.edges.emplace(key);
  batch.windings.assign(probes.size(), 0);
  for (const TriangleD& t : batch.triangles) {
    const std::uint64_t number = batch.result.triangles;
    if (!in_predicate_domain(t[0]) || !in_predicate_domain(t[1]) || !in_predicate_domain(t[2])) {
      batch.result.undecidable.add({number, 0, t[0]}, max_examples);
      ++batch.result.triangles;
      continue;
    }
    if (collinear(t[0], t[1], t[2])) {
      batch.edges->degenerate.add(t);
    } else {
      batch.edges->plain.add(t);
      for (std::size_t p = 0; p < probes.size(); ++p) batch.windings[p] += crossing_above(t, probes[p].point);
    }
    ++batch.result.triangles;
    const std::int64_t touched = surface.touched_by(t);
    if (touched != Surface::kNone)
      batch.result.touching.add({number, mesh.number[std::size_t(touched)], t[0]}, max_examples);
    else if (surface.winding(t[0]) != 0)
      batch.result.swallowed.add({number, 0, t[0]}, max_examples);
  }
}

/// Tests the parts that the scene as a whole does not wind around: they may lie in a hollow of the scene, or between
/// parts that overlap.
void look_at(const std::vector<Probe>& probes, TriangleSource& scene, std::size_t max_examples,
             std::uint64_t memory_bytes, InsideReport& report) {
  std::vector<Vec3d> points;
  std::vector<std::uint64_t> triangles;
  for (const Probe& probe : probes) {
    if (report.scene_closed && probe.winding != 0) continue;
    points.push_back(probe.point);
    triangles.push_back(probe.triangle);
  }
  if (points.empty()) return;
  const std::vector<Hiding> found = hiding_of(points, scene, memory_bytes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (found[i] == Hiding::seen) report.outside.add({triangles[i], 0, points[i]}, max_examples);
    if (found[i] == Hiding::unknown) report.unsettled.add({triangles[i], 0, points[i]}, max_examples);
  }
}

}  // namespace

InsideReport check_inside(const WeldedMesh& mesh, const Surface& surface, TriangleSource& scene,
                          std::size_t max_examples, std::uint64_t memory_bytes) {
  InsideReport report;
  std::vector<Probe> probes = probes_of(mesh);
  const EdgeKey key = EdgeKey::drawn();
  SceneEdges edges(key);
  const auto append = [&](Finding& all, Finding& found) {
    for (Example& e : found.examples) e.index += report.triangles;
    all.append(found, max_examples);
  };
  scene.rewind();
  pipeline<InsideBatch>(
      4 * thread_count(), [&](InsideBatch& batch) { return scene.read(batch.triangles); },
      [&](InsideBatch& batch) { check_batch(mesh, surface, probes, key, max_examples, batch); },
      [&](InsideBatch& batch) {
        append(report.touching, batch.result.touching);
        append(report.swallowed, batch.result.swallowed);
        append(report.undecidable, batch.result.undecidable);
        report.triangles += batch.result.triangles;
        edges.add(*batch.edges);
        for (std::size_t p = 0; p < probes.size(); ++p) probes[p].winding += batch.windings[p];
      });
  report.scene_closed = edges.closed();
  look_at(probes, scene, max_examples, memory_bytes, report);
  return report;
}

}  // namespace bp
