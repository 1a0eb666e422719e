#include "tools/view/geometry/distances.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr std::size_t kMostRefined = 500'000;  ///< triangles: 20 MB for the page, a second on two cores
constexpr double kUsualRefined = 150'000;      ///< triangles, if all were equilateral

Vec3d position_of(const ShownMesh& mesh, std::uint32_t i) {
  const auto& p = mesh.positions[i];
  return {p[0], p[1], p[2]};
}

double area_of(const ShownMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d a = position_of(mesh, t[0]);
    area += length(cross(position_of(mesh, t[1]) - a, position_of(mesh, t[2]) - a)) / 2;
  }
  return area;
}

/// The middles of edges that were halved, each once.
class Middles {
 public:
  Middles(ShownMesh& mesh, double longest) : mesh_(mesh), longest_(longest) {}
  /// Returns the position in the middle of an edge that is too long; none of another one.
  [[nodiscard]] std::optional<std::uint32_t> of(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const Vec3d p = position_of(mesh_, a), q = position_of(mesh_, b);
    if (!(length(q - p) > longest_)) return {};
    const auto [found, is_new] = known_.try_emplace(std::uint64_t(a) << 32 | b, std::uint32_t(mesh_.positions.size()));
    if (is_new) {
      const Vec3d m = 0.5 * (p + q);
      mesh_.positions.push_back({float(m[0]), float(m[1]), float(m[2])});
    }
    return found->second;
  }

 private:
  ShownMesh& mesh_;
  const double longest_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

/// Appends what halving the edges of a triangle makes of it: one to four triangles.
void append_halves(std::vector<std::array<std::uint32_t, 3>>& out, const std::array<std::uint32_t, 3>& t,
                   const std::array<std::optional<std::uint32_t>, 3>& middle) {
  const auto count = std::count_if(middle.begin(), middle.end(), [](const auto& m) { return m.has_value(); });
  if (count == 0) return out.push_back(t);
  if (count == 3) {
    for (std::size_t k = 0; k < 3; ++k) out.push_back({t[k], *middle[k], *middle[(k + 2) % 3]});
    return out.push_back({*middle[0], *middle[1], *middle[2]});
  }
  // Turned so that the first edge is halved; of two, the first and the second.
  std::size_t k = 0;
  while (!middle[k] || (count == 2 && !middle[(k + 1) % 3])) ++k;
  const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = *middle[k];
  if (count == 1) {
    out.push_back({a, ab, c});
    return out.push_back({ab, b, c});
  }
  const std::uint32_t bc = *middle[(k + 1) % 3];
  out.push_back({ab, b, bc});
  out.push_back({a, ab, bc});
  out.push_back({a, bc, c});
}

}  // namespace

void refine(ShownMesh& mesh, double longest, std::size_t most) {
  if (!(longest > 0)) return;
  for (bool changed = true; changed && mesh.triangles.size() <= most;) {
    Middles middles(mesh, longest);
    std::vector<std::array<std::uint32_t, 3>> next;
    next.reserve(mesh.triangles.size() * 2);
    for (const auto& t : mesh.triangles)
      append_halves(next, t, {middles.of(t[0], t[1]), middles.of(t[1], t[2]), middles.of(t[2], t[0])});
    changed = next.size() > mesh.triangles.size();
    mesh.triangles = std::move(next);
  }
}

SceneDistances::SceneDistances(std::function<std::unique_ptr<TriangleSource>()> open, const Vec3d& middle,
                               std::uint64_t bytes)
    : open_(std::move(open)), middle_(middle), bytes_(bytes) {}

const TriangleBvh& SceneDistances::tree() {
  const std::lock_guard lock(mutex_);
  if (tree_ != nullptr) return *tree_;
  std::vector<TriangleD> all;
  const auto source = open_();
  for (std::vector<TriangleD> some; source->read(some);) {
    if (TriangleBvh::bytes_with_triangles(all.size() + some.size()) > bytes_)
      fail(ErrorCode::out_of_resource, "distances from {} triangles and more need a larger --memory", all.size());
    for (TriangleD& t : some) {
      for (Vec3d& p : t) p = p - middle_;
    }
    all.insert(all.end(), some.begin(), some.end());
  }
  if (all.empty()) fail(ErrorCode::bad_input, "the scene has no triangle to measure from");
  tree_ = std::make_unique<const TriangleBvh>(all);
  return *tree_;
}

void SceneDistances::add_to(ShownMesh& mesh, double step) {
  const TriangleBvh& scene = tree();
  if (mesh.normals.empty()) {
    const double usual = std::sqrt(area_of(mesh) / (std::sqrt(3.0) / 4 * kUsualRefined));
    refine(mesh, std::max(step, usual), kMostRefined);
  }
  mesh.distances.resize(mesh.positions.size());
  parallel_ranges(std::int64_t(mesh.positions.size()), 256, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t guess = 0;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      const TriangleBvh::Nearest nearest = scene.nearest(position_of(mesh, std::uint32_t(i)), guess);
      guess = nearest.item;
      mesh.distances[i] = float(std::sqrt(nearest.distance_squared));
    }
  });
}

}  // namespace bp
