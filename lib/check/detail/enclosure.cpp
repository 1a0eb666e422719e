#include "lib/check/detail/enclosure.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "lib/check/detail/gap.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/geometry/signed_volume.h"

namespace bp {

namespace {

constexpr std::size_t kBatch = 8192;  // triangles per work item

struct EnclosureBatch {
  std::uint64_t first = 0;
  std::vector<TriangleD> triangles;
  std::vector<std::uint8_t> inner_edges;  // TriangleSource::read_faces()
  EnclosureReport result;
  SignedVolume volume;
};

/// Pulls from a source whose reads are of any size, hands out batches of about one size and of whole polygons.
class Batcher {
 public:
  explicit Batcher(TriangleSource& source) : source_(source) {}
  bool next(EnclosureBatch& batch) {
    batch.first = count_;
    while ((batch.triangles.size() < kBatch || (batch.inner_edges.back() & kSamePolygonAfter) != 0) && refill()) {
      const std::size_t room = batch.triangles.size() < kBatch ? kBatch - batch.triangles.size() : 1;
      const std::size_t n = std::min(room, read_.size() - used_);
      const auto begin = std::ptrdiff_t(used_), end = begin + std::ptrdiff_t(n);
      batch.triangles.insert(batch.triangles.end(), read_.begin() + begin, read_.begin() + end);
      batch.inner_edges.insert(batch.inner_edges.end(), inner_edges_.begin() + begin, inner_edges_.begin() + end);
      used_ += n, count_ += n;
    }
    return !batch.triangles.empty();
  }

 private:
  bool refill() {
    while (used_ == read_.size() && !ended_) {
      used_ = 0;
      ended_ = !source_.read_faces(read_, colors_, inner_edges_);
      if (ended_) read_.clear();
    }
    return !ended_;
  }
  TriangleSource& source_;
  std::vector<TriangleD> read_;
  std::vector<TriangleColors> colors_;  // not looked at
  std::vector<std::uint8_t> inner_edges_;
  std::size_t used_ = 0;
  std::uint64_t count_ = 0;
  bool ended_ = false;
};

/// Sides of corners met lately. A triangle that touches nothing lies on one side, so all its corners share the answer,
/// and so do all triangles at these corners that touch nothing. Forgetting costs time, never the result.
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

bool all_finite(const TriangleD& t) {
  return std::all_of(t.begin(), t.end(), [](const Vec3d& p) { return is_finite(p); });
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

/// Whether all triangles of a polygon lie in one plane. What is not finite lies in none.
bool is_flat(std::span<const TriangleD> polygon) {
  if (!std::all_of(polygon.begin(), polygon.end(), all_finite)) return false;
  const auto plane =
      std::find_if(polygon.begin(), polygon.end(), [](const TriangleD& t) { return !collinear(t[0], t[1], t[2]); });
  if (plane == polygon.end()) return true;
  const TriangleD& a = *plane;
  const auto is_in_plane = [&](const Vec3d& p) {
    return p == a[0] || p == a[1] || p == a[2] || orient3d(a[0], a[1], a[2], p) == 0;
  };
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const TriangleD& t) { return std::all_of(t.begin(), t.end(), is_in_plane); });
}

/// Polygons that are not flat. A quad is read as the fan from its first or its second corner. A program may draw a quad
/// over its other diagonal; of larger ones nothing is looked for.
void check_polygons(const Surface& surface, const EnclosureQuestion& question, const EnclosureBatch& batch,
                    EnclosureReport& e) {
  SideCache cache;
  const auto is_enclosed = [&](const TriangleD& t) {
    return surface.touched_by(t) == Surface::kNone && question.decide_sides && winding_of(t, surface, cache) >= 1;
  };
  for (std::size_t begin = 0, end = 0; begin < batch.triangles.size(); begin = end) {
    end = begin + 1;
    while (end < batch.triangles.size() && (batch.inner_edges[end - 1] & kSamePolygonAfter) != 0 &&
           (batch.inner_edges[end] & kSamePolygonBefore) != 0)
      ++end;
    const auto polygon = std::span(batch.triangles).subspan(begin, end - begin);
    if (polygon.size() == 1 || is_flat(polygon)) continue;
    ++e.bent;
    const TriangleD &t = polygon.front(), &last = polygon.back();
    const bool both = polygon.size() == 2 && all_finite(t) && all_finite(last) && is_enclosed({t[0], t[1], last[2]}) &&
                      is_enclosed({t[1], t[2], last[2]});
    if (!both) ++e.bent_open;
  }
}

void check_batch(const WeldedMesh& mesh, const Surface& surface, const EnclosureQuestion& question, const Vec3d& origin,
                 EnclosureBatch& batch) {
  const std::size_t max_examples = question.max_examples;
  SideCache cache;
  EnclosureReport& e = batch.result;
  batch.volume = SignedVolume(origin);
  for (std::size_t i = 0; i < batch.triangles.size(); ++i) {
    const TriangleD& t = batch.triangles[i];
    const std::uint64_t number = batch.first + i;
    if (!all_finite(t)) {
      e.undecidable.add({number, 0, t[0]}, max_examples);
      continue;
    }
    batch.volume.add(t);
    const std::int64_t touched = surface.touched_by(t);
    if (touched != Surface::kNone) {
      e.touching.add({number, mesh.number[std::size_t(touched)], centre(t)}, max_examples);
      e.least_gap = 0;
    } else if (question.decide_sides && winding_of(t, surface, cache) < 1) {
      e.outside.add({number, 0, centre(t)}, max_examples);
    }
    check_gap(mesh, surface, question, number, t, e);
  }
  e.triangles = batch.triangles.size();
  check_polygons(surface, question, batch, e);
}

}  // namespace

EnclosureReport check_enclosure(const WeldedMesh& mesh, const Surface& surface, TriangleSource& scene,
                                const EnclosureQuestion& question,
                                const std::function<void(std::uint64_t, const std::vector<TriangleD>&)>& see) {
  EnclosureReport all;
  Vec3d origin{};
  if (!surface.bounds().empty()) origin = surface.bounds().min;
  SignedVolume volume(origin);
  scene.rewind();
  Batcher batcher(scene);
  pipeline<EnclosureBatch>(
      4 * thread_count(), [&](EnclosureBatch& batch) { return batcher.next(batch); },
      [&](EnclosureBatch& batch) { check_batch(mesh, surface, question, origin, batch); },
      [&](EnclosureBatch& batch) {
        see(batch.first, batch.triangles);
        const std::size_t max_examples = question.max_examples;
        all.triangles += batch.result.triangles;
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
