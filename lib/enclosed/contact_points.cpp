#include "lib/enclosed/contact_points.h"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/enclosed/detail/nearest_faces.h"

namespace bp {

namespace {

constexpr std::int64_t kFacesAtOnce = 64;
constexpr std::size_t kPointsPerFace = 64;  // points of a face that are kept in any case
constexpr std::size_t kBinsPerEdge = 12;    // bins along an edge of a face with more points
constexpr double kTilt = 1;                 // largest turn of a face that is considered, as a slope

/// The points that a face meets first, wherever on it they lie and however it turns. Points under them guide nothing,
/// and are dropped.
class Outermost {
 public:
  explicit Outermost(const std::array<Vec3d, 3>& face) : corner_(face[0]) {
    const Vec3d ab = face[1] - face[0], ac = face[2] - face[0], normal = cross(ab, ac);
    const double area = std::max(length(normal), 1e-9);
    const Vec3d up = (1 / area) * normal, along = (kTilt / std::max(length(ab), 1e-9)) * ab, across = cross(up, along);
    directions_ = {up, up + along, up - along, up + across, up - across};
    to_c_ = (1 / area) * cross(up, ab);
    to_b_ = (1 / area) * cross(ac, up);
    best_.fill({-1e300, 0});
  }

  void add(const Vec3d& point, std::uint32_t number) {
    const Vec3d p = point - corner_;
    Best* const bin = &best_[(bin_of(dot(to_b_, p)) * kBinsPerEdge + bin_of(dot(to_c_, p))) * directions_.size()];
    for (std::size_t k = 0; k < directions_.size(); ++k) {
      const double height = dot(directions_[k], p);
      if (height > bin[k].height) bin[k] = {height, number};
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> take() const {
    std::vector<std::uint32_t> numbers;
    for (const Best& b : best_) {
      if (b.height > -1e300) numbers.push_back(b.number);
    }
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
  }

 private:
  struct Best {
    double height;
    std::uint32_t number;
  };
  static std::size_t bin_of(double share) {
    return std::size_t(std::clamp(share * double(kBinsPerEdge), 0.0, double(kBinsPerEdge) - 1));
  }
  Vec3d corner_, to_b_{}, to_c_{};  // times to_b_ (to_c_), a point gives its share of the way to corner b (c)
  std::array<Vec3d, 5> directions_{};
  std::array<Best, kBinsPerEdge * kBinsPerEdge * 5> best_{};
};

/// Returns the nearest of n targets to p. `first` is asked first: the nearer it is, the fewer others are asked.
template <class TargetAt>
std::size_t nearest_of(std::size_t n, const TargetAt& target_at, const Vec3d& p, std::size_t first) {
  std::size_t best = first;
  double least = target_at(first).squared_distance(p);
  for (std::size_t k = 0; k < n; ++k) {
    const FaceTarget& target = target_at(k);
    if (k == first || target.is_farther(p, least)) continue;
    const double d = target.squared_distance(p);
    if (d >= least) continue;
    least = d;
    best = k;
  }
  return best;
}

std::size_t nearest_of(std::span<const FaceTarget> targets, const Vec3d& p, std::size_t first) {
  return nearest_of(
      targets.size(), [&](std::size_t k) -> const FaceTarget& { return targets[k]; }, p, first);
}

/// Gathers the face and all faces that share a corner with it, each once.
void gather_around(const HalfEdgeMesh& mesh, FaceId f, std::vector<FaceId>& around) {
  around.assign(1, f);
  for (HalfEdgeId h = 3 * f; h < 3 * f + 3; ++h) {
    if (mesh.locked(mesh.from(h))) continue;  // its faces may be of other parts
    mesh.for_each_outgoing(mesh.from(h), [&](HalfEdgeId g) {
      const FaceId other = HalfEdgeMesh::face(g);
      if (std::find(around.begin(), around.end(), other) == around.end()) around.push_back(other);
    });
  }
}

}  // namespace

ContactPoints::ContactPoints(const Enclosed& enclosed, const HalfEdgeMesh& mesh, const FaceTree& tree)
    : mesh_(mesh), of_face_(mesh.face_capacity()) {
  VertexId first = 0;
  while (!mesh.vertex_alive(first)) ++first;
  origin_ = mesh.position(first);
  double edges = 0;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    if (mesh.alive(f)) edges += length(to_double(mesh.corner(f, 1) - mesh.corner(f, 0)));
  }
  const double reach = edges / double(mesh.face_count());
  // Points under faces along a cell's side may lie beyond that side.
  points_ = enclosed.contact_points(origin_, mesh.cell().grown(std::int64_t(2 * reach) + 1));
  const std::vector<FaceId> nearest_to = nearest_faces(points_, origin_, mesh, tree, reach);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (nearest_to[i] != kNoId) of_face_[nearest_to[i]].push_back(std::uint32_t(i));  // else the point lies deep inside
  }
  parallel_ranges(std::int64_t(of_face_.size()), kFacesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t f = begin; f < end; ++f) keep_outermost(FaceId(f));
  });
  drop_unlisted();
}

void ContactPoints::keep_outermost(FaceId f) {
  std::vector<std::uint32_t>& list = of_face_[f];
  if (list.size() <= kPointsPerFace) return;
  Outermost outermost(corners(f));
  for (const std::uint32_t i : list) outermost.add(points_[i], i);
  list = outermost.take();
}

void ContactPoints::drop_unlisted() {
  std::vector<std::uint32_t> place(points_.size(), 0);
  for (const auto& list : of_face_) {
    for (const std::uint32_t i : list) place[i] = 1;
  }
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (place[i] == 0) continue;
    place[i] = kept;
    points_[kept++] = points_[i];
  }
  points_.resize(kept);
  points_.shrink_to_fit();
  for (auto& list : of_face_) {
    for (std::uint32_t& i : list) i = place[i];
  }
}

std::array<Vec3d, 3> ContactPoints::corners(FaceId f) const {
  return {to_double(mesh_.corner(f, 0) - origin_), to_double(mesh_.corner(f, 1) - origin_),
          to_double(mesh_.corner(f, 2) - origin_)};
}

void ContactPoints::hand_over(std::span<const FaceId> from, std::span<const FaceId> to, Scratch& scratch) {
  scratch.moving.clear();
  for (const FaceId f : from) {
    const auto same = std::find(to.begin(), to.end(), f);
    const auto first = same == to.end() ? 0 : std::size_t(same - to.begin());
    for (const std::uint32_t i : of_face_[f]) scratch.moving.emplace_back(i, first);
    of_face_[f].clear();
  }
  scratch.targets.clear();
  for (const FaceId f : to) scratch.targets.emplace_back(corners(f));
  for (const auto& [i, first] : scratch.moving)
    of_face_[to[nearest_of(scratch.targets, points_[i], first)]].push_back(i);
}

void ContactPoints::set_targets() {
  targets_.resize(mesh_.face_capacity());
  parallel_ranges(std::int64_t(targets_.size()), kFacesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (auto f = FaceId(begin); f < FaceId(end); ++f) {
      if (mesh_.alive(f)) targets_[f] = FaceTarget(corners(f));
    }
  });
}

/// Lists the points of the face `from` with the nearest faces around it. A point that is nearer to `from` than to the
/// planes along its edges stays, even if a face that folds back over it is nearer.
void ContactPoints::give_away(FaceId from, std::vector<FaceId>& around, std::vector<Move>& moves) {
  gather_around(mesh_, from, around);
  const FaceTarget& own = targets_[from];
  std::erase_if(of_face_[from], [&](std::uint32_t i) {
    if (own.is_inner(points_[i], own.squared_distance(points_[i]))) return false;
    const FaceId to = around[nearest_of(
        around.size(), [&](std::size_t k) -> const FaceTarget& { return targets_[around[k]]; }, points_[i], 0)];
    if (to != from) moves.push_back({i, to});
    return to != from;
  });
}

void ContactPoints::hand_over_around(std::span<const FaceId> faces) {
  if (faces.empty()) return;
  set_targets();
  std::vector<std::vector<Move>> moves(faces.size() / kFacesAtOnce + 1);
  parallel_ranges(std::int64_t(faces.size()), kFacesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    std::vector<FaceId> around;
    for (std::int64_t k = begin; k < end; ++k) {
      const FaceId f = faces[std::size_t(k)];
      if (!of_face_[f].empty()) give_away(f, around, moves[std::size_t(begin / kFacesAtOnce)]);
    }
  });
  for (const std::vector<Move>& some : moves) {
    for (const auto& [point, to] : some) of_face_[to].push_back(point);
  }
}

void ContactPoints::add(std::span<const Vec3d> points, const Vec3d& shift, std::span<const FaceId> near) {
  scratch_.targets.clear();
  for (const FaceId f : near) scratch_.targets.emplace_back(corners(f));
  for (const Vec3d& point : points) {
    const Vec3d p = point + shift;
    if (!added_.insert(rounded(p)).second) continue;
    of_face_[near[nearest_of(scratch_.targets, p, 0)]].push_back(std::uint32_t(points_.size()));
    points_.push_back(p);
  }
}

}  // namespace bp
