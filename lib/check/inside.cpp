#include "lib/check/inside.h"

#include <bit>

#include "lib/core/parallel.h"
#include "lib/core/predicates.h"
#include "lib/geometry/crossing.h"

namespace bp {

namespace {

/// A point of each component of the proxy, and how often the scene winds around it.
struct Probe {
  Vec3d point;
  std::uint64_t triangle;  // its first one
  std::int64_t winding = 0;
};

std::vector<Probe> probes_of(const WeldedMesh& mesh) {
  std::vector<Probe> probes;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.component[t] == probes.size()) probes.push_back({mesh.corners(t)[0], mesh.number[t]});
  }
  return probes;
}

std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

std::uint64_t hash(const Vec3d& p, std::uint64_t seed) {
  for (const double x : p) seed = mix(seed + 0x9E3779B97F4A7C15u + std::bit_cast<std::uint64_t>(x + 0.0));
  return seed;
}

/// The sum over all directed edges ab of h(a, b) - h(b, a): zero if each is used as often as its reverse, and for any
/// other set of edges zero with a probability of 2^-128.
struct EdgeSum {
  std::uint64_t low = 0, high = 0;
  void add(const TriangleD& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &a = t[k], &b = t[(k + 1) % 3];
      low += hash(b, hash(a, 1)) - hash(a, hash(b, 1));
      high += hash(b, hash(a, 2)) - hash(a, hash(b, 2));
    }
  }
  void add(const EdgeSum& s) { low += s.low, high += s.high; }
  [[nodiscard]] bool zero() const { return low == 0 && high == 0; }
};

struct Batch {
  std::vector<TriangleD> triangles;
  InsideReport result;
  std::vector<std::int64_t> windings;
  EdgeSum edges;             // of triangles that have an area
  EdgeSum degenerate_edges;  // of the others
};

/// Numbers of triangles count from 0 in each batch.
void check_batch(const WeldedMesh& mesh, const Surface& surface, const std::vector<Probe>& probes,
                 std::size_t max_examples, Batch& batch) {
  batch.windings.assign(probes.size(), 0);
  for (const TriangleD& t : batch.triangles) {
    const std::uint64_t number = batch.result.triangles;
    if (!in_predicate_domain(t[0]) || !in_predicate_domain(t[1]) || !in_predicate_domain(t[2])) {
      batch.result.undecidable.add({number, 0, t[0]}, max_examples);
      ++batch.result.triangles;
      continue;
    }
    if (collinear(t[0], t[1], t[2])) {
      batch.degenerate_edges.add(t);
      continue;
    }
    batch.edges.add(t);
    ++batch.result.triangles;
    for (std::size_t p = 0; p < probes.size(); ++p) batch.windings[p] += crossing_above(t, probes[p].point);
    const std::int64_t touched = surface.touched_by(t);
    if (touched != Surface::kNone)
      batch.result.touching.add({number, mesh.number[std::size_t(touched)], t[0]}, max_examples);
    else if (surface.winding(t[0]) != 0)
      batch.result.swallowed.add({number, 0, t[0]}, max_examples);
  }
}

}  // namespace

InsideReport check_inside(const WeldedMesh& mesh, const Surface& surface, TriangleSource& scene,
                          std::size_t max_examples) {
  InsideReport report;
  std::vector<Probe> probes = probes_of(mesh);
  EdgeSum edges, degenerate_edges;
  const auto append = [&](Finding& all, Finding& found) {
    for (Example& e : found.examples) e.index += report.triangles;
    all.append(found, max_examples);
  };
  scene.rewind();
  pipeline<Batch>(
      4 * thread_count(), [&](Batch& batch) { return scene.read(batch.triangles); },
      [&](Batch& batch) { check_batch(mesh, surface, probes, max_examples, batch); },
      [&](Batch& batch) {
        append(report.touching, batch.result.touching);
        append(report.swallowed, batch.result.swallowed);
        append(report.undecidable, batch.result.undecidable);
        report.triangles += batch.result.triangles;
        edges.add(batch.edges);
        degenerate_edges.add(batch.degenerate_edges);
        for (std::size_t p = 0; p < probes.size(); ++p) probes[p].winding += batch.windings[p];
      });
  EdgeSum all_edges = edges;
  all_edges.add(degenerate_edges);
  report.scene_closed = edges.zero() || all_edges.zero();  // either says so of the surface as a set of points
  for (const Probe& probe : probes) {
    if (report.scene_closed && probe.winding == 0) report.outside.add({probe.triangle, 0, probe.point}, max_examples);
  }
  return report;
}

}  // namespace bp
