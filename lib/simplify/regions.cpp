#include "lib/simplify/regions.h"

#include <algorithm>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::array<double, 3> kShares = {0.5, 0.35, 0.65};  // of the faces on the lower side, by turn
constexpr std::size_t kSample = 1024;                         // faces that tell along which axis to cut

class Splitter {
 public:
  Splitter(const Piece& whole, std::uint64_t most, double share)
      : whole_(whole), most_(most), share_(share), faces_(whole.triangles.size()) {
    for (FaceId f = 0; f < faces_.size(); ++f) faces_[f] = f;
    split(0, faces_.size(), kEverywhere);
  }

  std::vector<Region> gather() {
    for (FaceId f = 0; f < whole_.triangles.size(); ++f) {
      const auto& [a, b, c] = whole_.triangles[f];
      reach_into(0, f, box_of(whole_.vertices[a], whole_.vertices[b], whole_.vertices[c]));
    }
    return std::move(leaves_);
  }

 private:
  /// Inner: `axis` and `plane` divide its cell; below[0] has what is not beyond the plane. Leaf: axis is -1.
  struct Node {
    int axis = -1;
    std::int64_t plane = 0;
    std::array<std::size_t, 2> below{};  // nodes; of a leaf the first one is its number
  };

  [[nodiscard]] LatticeCoord thrice_middle(FaceId f) const {
    const auto& [a, b, c] = whole_.triangles[f];
    return whole_.vertices[a] + whole_.vertices[b] + whole_.vertices[c];
  }

  /// The node of faces_[begin, end).
  std::size_t split(std::size_t begin, std::size_t end, const LatticeBox& cell) {
    const std::size_t number = nodes_.size();
    nodes_.emplace_back();
    for (const int axis : end - begin > most_ ? axes(begin, end) : std::vector<int>{}) {
      const std::int64_t plane = plane_across(axis, begin, end);
      if (plane <= cell.min[axis] || plane >= cell.max[axis]) continue;
      const auto first = faces_.begin() + std::ptrdiff_t(begin), last = faces_.begin() + std::ptrdiff_t(end);
      const std::size_t middle = std::size_t(
          std::stable_partition(first, last, [&](FaceId f) { return thrice_middle(f)[axis] <= 3 * plane; }) -
          faces_.begin());
      if (middle == begin || middle == end) continue;
      LatticeBox low = cell, high = cell;
      low.max[axis] = high.min[axis] = plane;
      const std::size_t lower = split(begin, middle, low), upper = split(middle, end, high);
      nodes_[number] = {axis, plane, {lower, upper}};
      return number;
    }
    nodes_[number].below[0] = leaves_.size();
    leaves_.push_back({cell, {}, {}, {}, 0});
    return number;
  }

  /// Those along which the middle half of a sample spreads most first: a rod on a wall is no reason to cut the wall's
  /// sides apart.
  [[nodiscard]] std::vector<int> axes(std::size_t begin, std::size_t end) const {
    const std::size_t step = std::max<std::size_t>((end - begin) / kSample, 1);
    std::array<std::int64_t, 3> spread{};
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::int64_t> at;
      for (std::size_t i = begin; i < end; i += step) at.push_back(thrice_middle(faces_[i])[axis]);
      std::sort(at.begin(), at.end());
      spread[std::size_t(axis)] = at[at.size() * 3 / 4] - at[at.size() / 4];
    }
    std::vector<int> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return spread[std::size_t(a)] > spread[std::size_t(b)]; });
    return order;
  }

  /// With the wanted share of the faces on its lower side, or beside: voxels have vertices without number in planes
  /// between them, and these would be locked.
  [[nodiscard]] std::int64_t plane_across(int axis, std::size_t begin, std::size_t end) const {
    std::vector<std::int64_t> at;
    for (std::size_t i = begin; i < end; ++i) at.push_back(thrice_middle(faces_[i])[axis]);
    const auto middle = at.begin() + std::ptrdiff_t(share_ * double(at.size()));
    std::nth_element(at.begin(), middle, at.end());
    const std::int64_t plane = floor_div(*middle, std::int64_t(3));
    return plane % kLatticePerVoxel == 0 ? plane + kLatticePerVoxel / 2 : plane;
  }

  /// The face is noted wherever its box meets a closed cell.
  void reach_into(std::size_t number, FaceId f, const LatticeBox& box) {
    const Node& node = nodes_[number];
    if (node.axis < 0) {
      leaves_[node.below[0]].faces.push_back(f);
      return;
    }
    if (box.min[node.axis] <= node.plane) reach_into(node.below[0], f, box);
    if (box.max[node.axis] >= node.plane) reach_into(node.below[1], f, box);
  }

  const Piece& whole_;
  const std::uint64_t most_;  // faces of a leaf
  const double share_;
  std::vector<FaceId> faces_;
  std::vector<Node> nodes_;
  std::vector<Region> leaves_;
};

std::size_t number_of(const Region& region, VertexId v) {
  return std::size_t(std::lower_bound(region.vertices.begin(), region.vertices.end(), v) - region.vertices.begin());
}

/// Given its cell and faces: its vertices, which of them are free, and so which faces stay.
void settle(const Piece& whole, Region& region) {
  for (const FaceId f : region.faces) {
    for (const VertexId v : whole.triangles[f]) region.vertices.push_back(v);
  }
  std::sort(region.vertices.begin(), region.vertices.end());
  region.vertices.erase(std::unique(region.vertices.begin(), region.vertices.end()), region.vertices.end());
  for (const VertexId v : region.vertices) region.free.push_back(region.cell.holds_inside(whole.vertices[v]));
  for (const FaceId f : region.faces) {
    const auto& [a, b, c] = whole.triangles[f];
    if (region.cell.holds(box_of(whole.vertices[a], whole.vertices[b], whole.vertices[c]))) continue;
    for (const VertexId v : {a, b, c}) region.free[number_of(region, v)] = 0;
  }
  const auto stays = [&](FaceId f) {
    const Triangle& t = whole.triangles[f];
    return std::none_of(t.begin(), t.end(), [&](VertexId v) { return region.free[number_of(region, v)] != 0; });
  };
  const auto first = std::stable_partition(region.faces.begin(), region.faces.end(), stays);
  region.fixed = std::size_t(first - region.faces.begin());
}

}  // namespace

std::vector<Region> regions_of(const Piece& whole, std::uint64_t faces_per_region, int turn) {
  if (whole.triangles.empty()) return {};
  std::vector<Region> regions = Splitter(whole, faces_per_region, kShares[std::size_t(turn) % kShares.size()]).gather();
  parallel_for(std::int64_t(regions.size()), [&](std::int64_t i) { settle(whole, regions[std::size_t(i)]); });
  return regions;
}

HalfEdgeMesh mesh_of(const Piece& whole, const Region& region) {
  std::vector<LatticeCoord> vertices;
  for (const VertexId v : region.vertices) vertices.push_back(whole.vertices[v]);
  std::vector<Triangle> triangles;
  for (const FaceId f : region.faces) {
    Triangle& t = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) t[k] = VertexId(number_of(region, whole.triangles[f][k]));
  }
  HalfEdgeMesh mesh(std::move(vertices), triangles, region.cell);
  for (VertexId v = 0; v < region.free.size(); ++v) {
    if (!region.free[v]) mesh.lock(v);
  }
  return mesh;
}

void put_back(const HalfEdgeMesh& mesh, const Region& region, Piece& whole) {
  for (VertexId v = 0; v < region.free.size(); ++v) {
    if (region.free[v]) whole.vertices[region.vertices[v]] = mesh.position(v);
  }
  for (FaceId f = 0; f < region.faces.size(); ++f) {
    if (f < region.fixed && mesh.alive(f)) continue;  // others may know it, too
    Triangle& t = whole.triangles[region.faces[f]];
    t.fill(kNoId);
    for (HalfEdgeId h = 3 * f; h < 3 * f + 3 && mesh.alive(f); ++h) t[h % 3] = region.vertices[mesh.from(h)];
  }
}

void drop_removed(Piece& whole) {
  std::erase_if(whole.triangles, [](const Triangle& t) { return t[0] == kNoId; });
  const std::vector<VertexId> kept = drop_unused_vertices(whole.vertices, whole.triangles);
  if (whole.quadrics.empty()) return;
  for (std::size_t v = 0; v < kept.size(); ++v) whole.quadrics[v] = whole.quadrics[kept[v]];
  whole.quadrics.resize(kept.size());
}

}  // namespace bp
