#include "lib/mesh/guard.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/exact/triangle_intersection.h"

namespace bp {

namespace {

/// The corners that two faces have in common (equal ids), as bits of their places in both faces.
struct Shared {
  unsigned a = 0, b = 0;
};

Shared shared_corners(const std::array<VertexId, 3>& a, const std::array<VertexId, 3>& b) {
  Shared s;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) {
      const unsigned same = a[i] == b[j];
      s.a |= same << i;
      s.b |= same << j;
    }
  }
  return s;
}

/// Returns whether two faces meet beyond the corners that they share. Exact.
bool meet(const NewFace& a, const NewFace& b, Shared s) {
  const LatticeCoord *ta = a.corners.data(), *tb = b.corners.data();
  // The lowest bit that is set; below, the lowest bit that is not set.
  constexpr int kFirst[8] = {0, 0, 1, 0, 2, 0, 1, 0};
  if (s.a == 0) return triangles_intersect(ta, tb);
  if (s.a == 1 || s.a == 2 || s.a == 4) return triangles_meet_beyond_shared_vertex(ta, kFirst[s.a], tb, kFirst[s.b]);
  if (s.a == 7) return true;
  const int apex_a = kFirst[7 - s.a], apex_b = kFirst[7 - s.b];
  return triangles_meet_beyond_shared_edge(ta[(apex_a + 1) % 3], ta[(apex_a + 2) % 3], ta[apex_a], tb[apex_b]);
}

bool disjoint_pairs(std::span<const NewFace> faces) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      if (meet(faces[i], faces[j], shared_corners(faces[i].ids, faces[j].ids))) return false;
    }
  }
  return true;
}

double sum_of_sizes(const Vec3d& v) {
  return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}

/// Sums normals without regard to their lengths, as small integers.
class MeanDirection {
 public:
  void add(const LatticeCoord& normal) {
    const Vec3d n = to_double(normal);
    const double size = sum_of_sizes(n);
    for (std::size_t i = 0; i < 3; ++i) sum_[i] += n[i] / size;
  }
  void add(std::span<const LatticeCoord> normals) {
    for (const LatticeCoord& n : normals) add(n);
  }
  [[nodiscard]] LatticeCoord rounded() const {
    return {nearest_integer(256 * sum_[0]), nearest_integer(256 * sum_[1]), nearest_integer(256 * sum_[2])};
  }

 private:
  Vec3d sum_{};
};

/// Returns true if all faces, seen along a direction, turn the same way around the apex, and once in all. Then the fan
/// is a graph over its shadow, so its faces meet only where they should. Exact. False says nothing.
bool is_graph(std::span<const NewFace> star, std::span<const LatticeCoord> normals, const LatticeCoord& along) {
  for (const LatticeCoord& n : normals) {
    if (side_along(n, along) <= 0) return false;
  }
  // The fan crosses a half-plane that holds the apex and the direction, in the same sense, once per turn.
  const LatticeCoord across = along.x != 0 || along.y != 0 ? LatticeCoord{along.y, -along.x, 0} : LatticeCoord{1, 0, 0};
  int turns = 0;
  for (const NewFace& f : star) {
    turns +=
        side_along(across, f.corners[1] - f.corners[0]) < 0 && side_along(across, f.corners[2] - f.corners[0]) >= 0;
  }
  return turns == 1;
}

/// Tries the mean normal. It works for nearly every star; the others are compared pair by pair.
bool is_graph(std::span<const NewFace> star, std::span<const LatticeCoord> normals) {
  MeanDirection mean;
  mean.add(normals);
  return is_graph(star, normals, mean.rounded());
}

}  // namespace

/// Tells a new face from other faces by four separating planes: its own plane and, upright on it, one along each edge.
/// Doubles with a bound of their rounding decide nearly all faces nearby; the exact test is for the rest. All four
/// planes are asked at once, because nobody knows which one will separate, and branches would cost more than they save.
class FaceProbe {
 public:
  /// The corners of another face, relative to the origin, and for each the sum of its coordinates' sizes.
  struct Corners {
    std::array<Vec3d, 3> at;
    std::array<double, 3> size;
  };

  FaceProbe(const NewFace& face, const LatticeCoord& normal, const LatticeCoord& origin) {
    const Vec3d n = to_double(normal);
    std::array<Vec3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = to_double(face.corners[k] - origin);
      reach_ = std::max(reach_, sum_of_sizes(p[k]));
    }
    set_plane(kOwn, n, p[0], sum_of_sizes(n));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& q = p[(k + 1) % 3];
      const Vec3d edge{q[0] - p[k][0], q[1] - p[k][1], q[2] - p[k][2]};
      set_plane(k, cross(edge, n), p[k], sum_of_sizes(edge) * sum_of_sizes(n));
    }
  }

  /// Returns true only if the faces have no point in common except the shared corners.
  [[nodiscard]] bool apart(const Corners& corners, Shared shared) const {
    // The planes that can separate, by the shared corners: the own plane, and planes along an edge that holds all of
    // these corners.
    constexpr std::array<std::uint32_t, 8> kUseful = {0b1111, 0b1101, 0b1011, 0b1001, 0b1110, 0b1100, 0b1010, 0b1000};
    if (shared.b == 7) return false;
    std::uint32_t beyond = kUseful[shared.a], below = 1u << kOwn;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::uint32_t is_shared = (shared.b >> j & 1) != 0 ? ~0u : 0;
      const Sides sides = sides_of(corners.at[j], corners.size[j] + reach_);
      beyond &= sides.above | is_shared;
      below &= sides.below | is_shared;
    }
    return (beyond | below) != 0;
  }

 private:
  static constexpr std::size_t kOwn = 3;  // place of the face's own plane; the others are along its edges
  /// For one point: bits of the planes that it is surely above, and of those that it is surely below.
  struct Sides {
    std::uint32_t above, below;
  };
  [[nodiscard]] Sides sides_of(const Vec3d& p, double reach) const {
    const auto height = [&](std::size_t half) {
      return normal_[0][half] * p[0] + normal_[1][half] * p[1] + normal_[2][half] * p[2] - offset_[half];
    };
    const TwoDoubles low = height(0), high = height(1), error_low = slack_[0] * reach, error_high = slack_[1] * reach;
    return {bits_of(low > error_low, high > error_high), bits_of(low < -error_low, high < -error_high)};
  }

  /// `size` bounds the sum of the sizes of the products that made `normal`. Coordinates are integers below 2^31, exact
  /// in doubles. A component of `normal` carries at most 4 roundings of products below `size`, and the two sums of
  /// products with points 4 more each: together below 16 roundings of size * (|p| + |point|).
  void set_plane(std::size_t k, const Vec3d& normal, const Vec3d& point, double size) {
    for (std::size_t i = 0; i < 3; ++i) normal_[i][k / 2][k % 2] = normal[i];
    offset_[k / 2][k % 2] = dot(normal, point);
    slack_[k / 2][k % 2] = 0x1p-49 * size;
  }

  std::array<std::array<TwoDoubles, 2>, 3> normal_;  // four planes side by side; outside is positive
  std::array<TwoDoubles, 2> offset_, slack_;
  double reach_ = 0;
};

Guard::Guard(const HalfEdgeMesh& mesh, const FaceTree& tree)
    : mesh_(mesh), tree_(tree), removed_(mesh.face_capacity(), 0) {}
Guard::~Guard() = default;

bool Guard::star_is_free(std::span<const NewFace> star, std::span<const FaceId> replaced) {
  prepare(star);
  return (is_graph(star, normals_) || disjoint_pairs(star)) && clear_of_mesh(star, replaced);
}

bool Guard::faces_are_free(std::span<const NewFace> faces, std::span<const FaceId> replaced) {
  prepare(faces);
  return disjoint_pairs(faces) && clear_of_mesh(faces, replaced);
}

bool Guard::grown_star_is_free(std::span<const NewFace> star, std::span<const FaceId> replaced, const Before& before) {
  prepare(star);
  both_ = before.box;
  both_.add(box_.min);
  both_.add(box_.max);
  gather_near(both_, replaced);
  if (!look_one_way(star, before.normals)) {
    near_count_ = near_.size();
    if (!is_graph(star, normals_) && !disjoint_pairs(star)) return false;
  }
  if (near_count_ == 0) return true;
  prepare_probes(star);
  return std::all_of(near_.begin(), near_.begin() + std::ptrdiff_t(near_count_),
                     [&](FaceId other) { return clear_of_face(star, other); });
}

bool Guard::rest_is_free(std::span<const NewFace> star) {
  if (near_count_ == 0) prepare_probes(star);  // the first test of a face prepares the probes
  return std::all_of(near_.begin() + std::ptrdiff_t(near_count_), near_.end(),
                     [&](FaceId other) { return clear_of_face(star, other); });
}

/// If all old and all new faces look up along some direction, and the new ones are a graph over their shadow, then the
/// old ones are a graph over the same shadow. A point that moves straight up from an old face begins outside the solid,
/// and meets a face from below only after one from above. So if no face that looks down lies between old and new faces,
/// no other face does (docs/bounding.md, "The guard"). The function then puts the faces that look down first in near_.
bool Guard::look_one_way(std::span<const NewFace> star, std::span<const LatticeCoord> normals_before) {
  MeanDirection mean;
  mean.add(normals_);
  mean.add(normals_before);
  const LatticeCoord up = mean.rounded();
  const bool above = std::all_of(normals_before.begin(), normals_before.end(),
                                 [&](const LatticeCoord& n) { return side_along(n, up) > 0; });
  if (!above || !is_graph(star, normals_, up)) return false;
  const auto looks_down = [&](FaceId f) {
    return side_along(normal_of(mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2)), up) < 0;
  };
  near_count_ = std::size_t(std::partition(near_.begin(), near_.end(), looks_down) - near_.begin());
  return true;
}

void Guard::prepare(std::span<const NewFace> faces) {
  normals_.clear();
  box_ = {faces[0].corners[0], faces[0].corners[0]};
  for (const NewFace& f : faces) {
    normals_.push_back(normal_of(f.corners[0], f.corners[1], f.corners[2]));
    for (const LatticeCoord& p : f.corners) box_.add(p);
  }
}

void Guard::prepare_probes(std::span<const NewFace> faces) {
  origin_ = faces[0].corners[0];
  probes_.clear();
  groups_.assign((faces.size() + BoxGroup::kWidth - 1) / BoxGroup::kWidth, {});
  for (std::size_t i = 0; i < faces.size(); ++i) {
    probes_.emplace_back(faces[i], normals_[i], origin_);
    const auto& c = faces[i].corners;
    groups_[i / BoxGroup::kWidth].set(std::uint32_t(i % BoxGroup::kWidth),
                                      relative_to(origin_, box_of(c[0], c[1], c[2])));
  }
}

void Guard::gather_near(const LatticeBox& box, std::span<const FaceId> replaced) {
  ++stamp_;
  for (const FaceId f : replaced) removed_[f] = stamp_;
  near_.clear();
  tree_.query(box, [&](FaceId other) {
    if (removed_[other] != stamp_) near_.push_back(other);
    return true;
  });
}

bool Guard::clear_of_mesh(std::span<const NewFace> faces, std::span<const FaceId> replaced) {
  prepare_probes(faces);
  gather_near(box_, replaced);
  return std::all_of(near_.begin(), near_.end(), [&](FaceId other) { return clear_of_face(faces, other); });
}

bool Guard::clear_of_face(std::span<const NewFace> faces, FaceId other) const {
  NewFace o;
  FaceProbe::Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    o.ids[k] = mesh_.from(3 * other + HalfEdgeId(k));
    o.corners[k] = mesh_.position(o.ids[k]);
    corners.at[k] = to_double(o.corners[k] - origin_);
    corners.size[k] = sum_of_sizes(corners.at[k]);
  }
  const BoxQuery box(relative_to(origin_, box_of(o.corners[0], o.corners[1], o.corners[2])));
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (std::uint32_t hits = groups_[g].meeting(box); hits != 0; hits &= hits - 1) {
      const std::size_t i = BoxGroup::kWidth * g + std::size_t(std::countr_zero(hits));
      const Shared shared = shared_corners(faces[i].ids, o.ids);
      if (!probes_[i].apart(corners, shared) && meet(faces[i], o, shared)) return false;
    }
  }
  return true;
}

}  // namespace bp
