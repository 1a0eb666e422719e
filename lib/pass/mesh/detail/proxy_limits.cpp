#include "lib/pass/mesh/detail/proxy_limits.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/geometry/triangle_parts.h"
#include "lib/quads/quads.h"

namespace bp {

namespace {

// Edge of a place of NearSurface, as a share of the error bound, which is a voxel at least.
constexpr double kPlace = 0.5;

double place_edge(const ProxyBounds& bounds, const GridFrame& frame) {
  return kPlace * std::max(bounds.error_world, frame.voxel);
}

/// Returns six times the cubed lattice units in a cubed scene unit.
double volume6_per_world(const GridFrame& frame) {
  return 6 * std::pow(kLatticePerVoxel / frame.voxel, 3);
}

/// Six times the volume that the change adds, in lattice units cubed; exact.
int128 growth_of(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after) {
  int128 sum = 0;
  const LatticeCoord& o = after[0][0];
  for (const LatticeTriangle& t : after) sum += orient3d_value(o, t[0], t[1], t[2]);
  for (const LatticeTriangle& t : before) sum -= orient3d_value(o, t[0], t[1], t[2]);
  return sum;
}

}  // namespace

void keep_pairs_within(StepLimits& limits, LatticeMesh& mesh) {
  if (mesh.quads.empty()) return;
  struct Pair {
    std::array<std::uint32_t, 2> faces;
    std::array<LatticeTriangle, 2> before, after;
    int128 growth;
  };
  const auto corners = [&mesh](const std::array<std::uint32_t, 3>& t) {
    return LatticeTriangle{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  };
  std::vector<Pair> pairs;
  for (const auto& faces : mesh.quads) {
    const auto& one = mesh.triangles[faces[0]];
    const auto& other = mesh.triangles[faces[1]];
    const auto turned = across(quad_of(one, other));
    Pair pair{faces, {corners(one), corners(other)}, {corners(turned[0]), corners(turned[1])}, 0};
    pair.growth = growth_of(pair.before, pair.after);
    pairs.push_back(pair);
  }
  // Pairs that add volume are asked first, those that add least before others. A pair that would lower the volume gives
  // no room to others, since it may also be drawn with its first diagonal.
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
    return std::pair(p.growth <= 0, p.growth) < std::pair(q.growth <= 0, q.growth);
  });
  mesh.quads.clear();
  limits.begin(volume6_of(mesh));
  for (const Pair& p : pairs) {
    if (limits.take(p.before, p.after)) mesh.quads.push_back(p.faces);
  }
  std::sort(mesh.quads.begin(), mesh.quads.end());
}

double volume_world(const LatticeMesh& mesh) {
  return double(volume6_of(mesh)) / volume6_per_world(mesh.frame);
}

ProxyLimits::ProxyLimits(const ProxyBounds& bounds, const GridFrame& frame, const TriangleBvh* enclosed,
                         std::size_t places)
    : bounds_(bounds), frame_(frame), tree_(enclosed) {
  if (bounds.error_world > 0) enclosed_.emplace(*enclosed, place_edge(bounds, frame), places);
  constexpr double kMost = 0x1p120;  // int128 holds it, and no grid has such a volume
  limit6_ = int128(std::clamp(bounds.volume_world * volume6_per_world(frame_), -kMost, kMost));
}

/// Returns how many places NearSurface keeps. Simplification jumps from place to place: if fewer places are kept than
/// the surface has, each is searched for again and again.
std::size_t ProxyLimits::places_near(const ProxyBounds& bounds, const GridFrame& frame, const TriangleBvh* enclosed) {
  if (bounds.error_world <= 0) return 0;
  constexpr double kLayers = 8;  // kept places for each place on the surface, since some share an entry
  double area = 0;
  for (std::size_t i = 0; i < enclosed->size(); ++i) area += area_of(enclosed->item(i).corners);
  const double wanted = std::min(kLayers * area / std::pow(place_edge(bounds, frame), 2), double(kMostPlaces));
  return std::clamp(std::bit_ceil(std::size_t(wanted)), kPlacesOfPart, kMostPlaces);
}

std::uint64_t ProxyLimits::bytes_needed(const ProxyBounds& bounds, const GridFrame& frame,
                                        const TriangleBvh* enclosed) {
  return places_near(bounds, frame, enclosed) * NearSurface::kBytesPerPlace;
}

std::uint64_t ProxyLimits::bytes_of_part() const {
  return bounds_.error_world > 0 ? kPlacesOfPart * NearSurface::kBytesPerPlace : 0;
}

std::unique_ptr<StepLimits> ProxyLimits::for_part() const {
  if (!has_parts()) return nullptr;
  std::unique_ptr<ProxyLimits> part(new ProxyLimits(bounds_, frame_, tree_, kPlacesOfPart));
  part->relaxed_ = relaxed_;
  part->beyond_ = beyond_;
  return part;
}

void ProxyLimits::add_part(const StepLimits& part) {
  beyond_ = beyond_ || static_cast<const ProxyLimits&>(part).beyond_;
}

bool ProxyLimits::take(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after) {
  const int128 growth = growth_of(before, after);
  if (!relaxed_ && bounds_.volume_world != 0 && growth > 0 && volume6_ + growth > limit6_) {
    last_refusal_ = "volume";
    return false;
  }
  if (bounds_.error_world > 0 && !near_enough(before, after)) {
    last_refusal_ = "error";
    return false;
  }
  volume6_ += growth;
  return true;
}

bool ProxyLimits::near_enough(std::span<const LatticeTriangle> before, std::span<const LatticeTriangle> after) {
  if (relaxed_ && beyond_) return true;
  double limit = bounds_.error_world;
  bool widened = false;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (enclosed_->holds(world(after[i]), limit)) continue;
    if (widened) return false;
    widened = true;
    double was = 0;
    for (const LatticeTriangle& t : before) {
      for (const LatticeCoord& p : t) was = std::max(was, enclosed_->distance(frame_.world(p)));
    }
    if (was <= limit) return false;
    limit = was;
    --i;  // tests the same triangle with the wider limit
  }
  beyond_ = beyond_ || widened;
  return true;
}

TriangleD ProxyLimits::world(const LatticeTriangle& t) const {
  return {frame_.world(t[0]), frame_.world(t[1]), frame_.world(t[2])};
}

}  // namespace bp
