#include "lib/check/detail/convex.h"

#include <algorithm>

#include "lib/check/detail/convex_cover.h"
#include "lib/core/box.h"
#include "lib/core/parallel.h"
#include "lib/exact/predicates.h"

namespace bp {

namespace {

struct Part {
  std::vector<std::uint32_t> triangles;  // of the mesh
  std::vector<std::uint32_t> points;     // distinct corners
  Bounds3d bounds;
};

std::vector<Part> parts_of(const WeldedMesh& mesh) {
  std::vector<Part> parts;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.degenerate[t] != 0) continue;  // it bounds nothing, and is a finding of its own
    if (mesh.component[t] >= parts.size()) parts.resize(mesh.component[t] + 1);
    Part& part = parts[mesh.component[t]];
    part.triangles.push_back(std::uint32_t(t));
    for (const std::uint32_t p : mesh.triangles[t]) {
      part.points.push_back(p);
      part.bounds.add(mesh.points[p]);
    }
  }
  for (Part& part : parts) {
    std::sort(part.points.begin(), part.points.end());
    part.points.erase(std::unique(part.points.begin(), part.points.end()), part.points.end());
  }
  return parts;
}

int side(const WeldedMesh& mesh, std::uint32_t triangle, const Vec3d& p) {
  const TriangleD t = mesh.corners(triangle);
  return orient3d(t[0], t[1], t[2], p);
}

constexpr std::uint32_t kNone = ~std::uint32_t(0);

/// Returns a vertex beyond triangle i of the part, or kNone.
std::uint32_t vertex_beyond(const WeldedMesh& mesh, const Part& part, std::size_t i) {
  for (const std::uint32_t p : part.points) {
    if (side(mesh, part.triangles[i], mesh.points[p]) > 0) return p;
  }
  return kNone;
}

bool holds(const WeldedMesh& mesh, const Part& part, const TriangleD& t) {
  for (const Vec3d& p : t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(p[i] > part.bounds.min[i] && p[i] < part.bounds.max[i])) return false;
    }
  }
  return std::all_of(part.triangles.begin(), part.triangles.end(), [&](std::uint32_t face) {
    return side(mesh, face, t[0]) < 0 && side(mesh, face, t[1]) < 0 && side(mesh, face, t[2]) < 0;
  });
}

/// Returns whether a corner of the triangle lies strictly inside no part. The answer is exact, so `true` refutes that
/// the parts hold the triangle.
bool has_bare_corner(const WeldedMesh& mesh, const std::vector<Part>& parts, const ConvexCover& cover,
                     const TriangleD& t) {
  return std::any_of(t.begin(), t.end(), [&](const Vec3d& p) {
    const TriangleD point{p, p, p};
    return !cover.visit(bounds_of(point), [&](std::uint32_t part) { return holds(mesh, parts[part], point); });
  });
}

struct ConvexBatch {
  std::uint64_t first = 0;
  std::vector<TriangleD> triangles;
  ConvexReport result;
};

std::vector<std::vector<TriangleD>> corners_of(const WeldedMesh& mesh, const std::vector<Part>& parts) {
  std::vector<std::vector<TriangleD>> corners;
  for (const Part& part : parts) {
    corners.emplace_back();
    for (const std::uint32_t t : part.triangles) corners.back().push_back(mesh.corners(t));
  }
  return corners;
}

/// Checks all triangles of a scene, in parallel. `check` finds the faults of a batch.
template <class Check>
void for_each_batch(TriangleSource& scene, std::size_t max_examples, ConvexReport& report, const Check& check) {
  scene.rewind();
  std::uint64_t read = 0;
  pipeline<ConvexBatch>(
      4 * thread_count(),
      [&](ConvexBatch& batch) {
        batch.first = read;
        if (!scene.read(batch.triangles)) return false;
        read += batch.triangles.size();
        return true;
      },
      check,
      [&](ConvexBatch& batch) {
        report.triangles += batch.triangles.size();
        report.bounds.merge(batch.result.bounds);
        report.not_held.append(batch.result.not_held, max_examples);
        report.perhaps_not_held.append(batch.result.perhaps_not_held, max_examples);
        report.within_rounding.append(batch.result.within_rounding, max_examples);
        report.undecidable.append(batch.result.undecidable, max_examples);
      });
}

void check_batch(const WeldedMesh& mesh, const std::vector<Part>& parts, const ConvexCover& cover,
                 std::size_t max_examples, ConvexBatch& batch) {
  std::uint32_t last = 0;  // neighbours in the scene mostly lie in the same part
  for (std::size_t i = 0; i < batch.triangles.size(); ++i) {
    const TriangleD& t = batch.triangles[i];
    batch.result.bounds.merge(bounds_of(t));
    if (!in_predicate_domain(t[0]) || !in_predicate_domain(t[1]) || !in_predicate_domain(t[2])) {
      batch.result.undecidable.add({batch.first + i, 0, t[0]}, max_examples);
      continue;
    }
    if (last < parts.size() && holds(mesh, parts[last], t)) continue;
    const auto holds_it = [&](std::uint32_t part) {
      if (part == last || !holds(mesh, parts[part], t)) return false;
      last = part;
      return true;
    };
    if (cover.visit(bounds_of(t), holds_it)) continue;
    const Answer answer = has_bare_corner(mesh, parts, cover, t) ? Answer::refuted : cover.covers(t);
    if (answer == Answer::proven) continue;
    (answer == Answer::refuted ? batch.result.not_held : batch.result.perhaps_not_held)
        .add({batch.first + i, 0, t[0]}, max_examples);
  }
}

}  // namespace

Finding nonconvex_parts(const WeldedMesh& mesh, std::size_t max_examples) {
  Finding found;
  for (const Part& part : parts_of(mesh)) {
    std::vector<std::uint32_t> beyond(part.triangles.size(), kNone);
    parallel_for(std::int64_t(part.triangles.size()),
                 [&](std::int64_t i) { beyond[std::size_t(i)] = vertex_beyond(mesh, part, std::size_t(i)); });
    const auto first = std::find_if(beyond.begin(), beyond.end(), [](std::uint32_t p) { return p != kNone; });
    if (first == beyond.end()) continue;
    found.add({mesh.number[part.triangles[0]], mesh.vertex[*first], mesh.points[*first]}, max_examples);
  }
  return found;
}

ConvexReport check_convex(const WeldedMesh& mesh, TriangleSource& scene, std::size_t max_examples, double proxy_off) {
  const std::vector<Part> parts = parts_of(mesh);
  const ConvexCover cover(corners_of(mesh, parts));
  ConvexReport report;
  for_each_batch(scene, max_examples, report,
                 [&](ConvexBatch& batch) { check_batch(mesh, parts, cover, max_examples, batch); });
  const Rounding rounding = scene.counts().rounding;
  if ((!rounding.any() && proxy_off == 0) || report.not_held.count + report.perhaps_not_held.count > 0) return report;
  ConvexReport again;
  for_each_batch(scene, max_examples, again, [&](ConvexBatch& batch) {
    for (std::size_t i = 0; i < batch.triangles.size(); ++i) {
      const TriangleD& t = batch.triangles[i];
      if (std::all_of(t.begin(), t.end(), [](const Vec3d& p) { return in_predicate_domain(p); }) &&
          cover.covers(t, rounding.of(t) + proxy_off) != Answer::proven)
        batch.result.within_rounding.add({batch.first + i, 0, t[0]}, max_examples);
    }
  });
  report.within_rounding = std::move(again.within_rounding);
  return report;
}

}  // namespace bp
