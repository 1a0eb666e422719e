#include "lib/check/detail/enclosure.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "lib/check/detail/faces/other_diagonals.h"
#include "lib/check/detail/gap.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/geometry/signed_volume.h"

namespace bp {

namespace {

struct EnclosureBatch {
  SceneBatch scene;
  EnclosureReport result;
  SignedVolume volume;
  SceneMemory::Part kept;
};

/// The sides of corners that were tested recently. A triangle that touches nothing lies on one side, so all its corners
/// share the answer, and so do all such triangles at these corners. A forgotten corner costs time, but never changes
/// the result.
class SideCache {
 public:
  SideCache() : slots_(kSlots) {}
  [[nodiscard]] const int* find(const Vec3d& p) const {
    const Slot& s = slots_[hash(p)];
    return s.used && s.point == p ? &s.winding : nullptr;
  }
  void put(const Vec3d& p, int winding) { slots_[hash(p)] = {p, winding, true}; }

 private:
  static constexpr std::size_t kSlots = 4096;
  struct Slot {
    Vec3d point;
    int winding;
    bool used = false;
  };
  static std::size_t hash(const Vec3d& p) {
    std::uint64_t h = 0;
    for (const double x : p) h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
    return (h >> 40) % kSlots;
  }
  std::vector<Slot> slots_;
};

int winding_of(const TriangleD& t, const Surface& surface, SideCache& cache) {
  const int* known = nullptr;
  for (std::size_t k = 0; k < 3 && known == nullptr; ++k) known = cache.find(t[k]);
  const int winding = known != nullptr ? *known : surface.winding(t[0]);
  for (const Vec3d& p : t) cache.put(p, winding);
  return winding;
}

Vec3d centre(const TriangleD& t) {
  Vec3d c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = t[0][i] / 3 + t[1][i] / 3 + t[2][i] / 3;
  return c;
}

void check_gap(const WeldedMesh& mesh, const Surface& surface, const EnclosureQuestion& question, std::uint64_t number,
               const TriangleD& t, EnclosureReport& e) {
  if (question.margin == 0 || surface.bvh().empty()) return;
  e.least_gap = gap_within(t, surface.bvh(), e.least_gap);
  const GapAnswer gap = keeps_gap(t, surface.bvh(), question.margin);
  if (gap.answer == Answer::proven) return;
  const std::uint64_t other = mesh.number[surface.triangle(gap.item)];
  (gap.answer == Answer::refuted ? e.too_near : e.perhaps_near).add({number, other, centre(t)}, question.max_examples);
}

/// Checks the triangles of a batch.
class EnclosureCheck {
 public:
  EnclosureCheck(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells,
                 const EnclosureQuestion& question, EnclosureReport& report)
      : mesh_(mesh), surface_(surface), cells_(cells), question_(question), report_(report) {}

  /// `box`: the triangle's, which must be finite.
  void add(std::uint64_t number, const TriangleD& t, const Bounds3d& box) {
    if (!is_far_inside(box)) look_at(number, t);
    check_gap(mesh_, surface_, question_, number, t, report_);
  }
  /// Counts polygons that are not flat. A quad is read as the fan from its first or its second corner, and a program
  /// may draw it over its other diagonal, so both are tested. The other triangulations of larger polygons are not
  /// tested.
  void add_polygon(std::span<const TriangleD> polygon) {
    if (polygon.size() < 2 || is_flat(polygon)) return;
    ++report_.bent;
    const TriangleD &t = polygon.front(), &last = polygon.back();
    const bool both = polygon.size() == 2 && is_finite(t) && is_finite(last) && is_enclosed({t[0], t[1], last[2]}) &&
                      is_enclosed({t[1], t[2], last[2]});
    if (!both) ++report_.bent_open;
  }

 private:
  [[nodiscard]] bool is_far_inside(const Bounds3d& box) const { return cells_ != nullptr && cells_->hold(box); }

  void look_at(std::uint64_t number, const TriangleD& t) {
    const std::int64_t touched = surface_.touched_by(t);
    if (touched != Surface::kNone) {
      report_.touching.add({number, mesh_.number[std::size_t(touched)], centre(t)}, question_.max_examples);
      report_.least_gap = 0;
    } else if (question_.decide_sides && winding_of(t, surface_, sides_) < 1) {
      report_.outside.add({number, 0, centre(t)}, question_.max_examples);
    }
  }
  bool is_enclosed(const TriangleD& t) {
    if (is_far_inside(bounds_of(t))) return true;
    return surface_.touched_by(t) == Surface::kNone && question_.decide_sides && winding_of(t, surface_, sides_) >= 1;
  }

  const WeldedMesh& mesh_;
  const Surface& surface_;
  const InsideCells* cells_;
  const EnclosureQuestion& question_;
  EnclosureReport& report_;
  SideCache sides_;
};

void check_batch(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells,
                 const EnclosureQuestion& question, const Vec3d& origin, EnclosureBatch& batch) {
  EnclosureReport& e = batch.result;
  EnclosureCheck check(mesh, surface, cells, question, e);
  std::vector<TriangleD> polygon;  // triangles of a polygon that is not complete yet
  batch.volume = SignedVolume(origin);
  batch.scene.for_each([&](std::uint64_t number, const TriangleD& t, std::uint8_t inner_edges) {
    if (inner_edges != 0 || !polygon.empty()) {
      if ((inner_edges & kSamePolygonBefore) == 0) {
        check.add_polygon(polygon);
        polygon.clear();
      }
      polygon.push_back(t);
      if ((inner_edges & kSamePolygonAfter) == 0) {
        check.add_polygon(polygon);
        polygon.clear();
      }
    }
    const Bounds3d box = bounds_of(t);
    e.bounds.merge(box);
    if (!is_finite(t)) {
      e.undecidable.add({number, 0, t[0]}, question.max_examples);
      return;
    }
    batch.volume.add(t);
    check.add(number, t, box);
  });
  check.add_polygon(polygon);
  e.triangles = batch.scene.count;
}

}  // namespace

EnclosureReport check_enclosure(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells,
                                TriangleSource& scene, const EnclosureQuestion& question, SceneMemory& memory) {
  EnclosureReport all;
  Vec3d origin{};
  if (!surface.bounds().empty()) origin = surface.bounds().min;
  SignedVolume volume(origin);
  scene.rewind();
  SceneBatches batches(scene);
  pipeline<EnclosureBatch>(
      4 * thread_count(), [&](EnclosureBatch& batch) { return batches.next(batch.scene); },
      [&](EnclosureBatch& batch) {
        check_batch(mesh, surface, cells, question, origin, batch);
        batch.kept = memory.part_of(batch.scene);
      },
      [&](EnclosureBatch& batch) {
        memory.add(std::move(batch.kept));
        const std::size_t max_examples = question.max_examples;
        all.triangles += batch.result.triangles;
        all.bounds.merge(batch.result.bounds);
        all.touching.append(batch.result.touching, max_examples);
        all.outside.append(batch.result.outside, max_examples);
        all.undecidable.append(batch.result.undecidable, max_examples);
        all.too_near.append(batch.result.too_near, max_examples);
        all.perhaps_near.append(batch.result.perhaps_near, max_examples);
        all.least_gap = std::min(all.least_gap, batch.result.least_gap);
        all.bent += batch.result.bent, all.bent_open += batch.result.bent_open;
        volume.add(batch.volume);
      });
  all.volume = volume.value();
  return all;
}

}  // namespace bp
