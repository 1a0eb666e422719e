#include "lib/meshing/regions.h"

#include <algorithm>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::array<double, 3> kShares = {0.5, 0.35, 0.65};  // of the faces on the lower side, by turn

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
    LatticeBox box = {thrice_middle(faces_[begin]), thrice_middle(faces_[begin])};
    for (std::size_t i = begin; i < end; ++i) box.add(thrice_middle(faces_[i]));
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (box.max[i] - box.min[i] > box.max[axis] - box.min[axis]) axis = i;
    }
    const std::size_t middle = begin + std::size_t(share_ * double(end - begin));
    std::int64_t plane = 0;
    if (end - begin > most_) {
      std::nth_element(faces_.begin() + std::ptrdiff_t(begin), faces_.begin() + std::ptrdiff_t(middle),
                       faces_.begin() + std::ptrdiff_t(end), [&](FaceId f, FaceId g) {
                         const std::int64_t at_f = thrice_middle(f)[axis], at_g = thrice_middle(g)[axis];
                         return at_f != at_g ? at_f < at_g : f < g;
                       });
      plane = floor_div(thrice_middle(faces_[middle])[axis], std::int64_t(3));
    }
    if (end - begin <= most_ || plane <= cell.min[axis] || plane >= cell.max[axis]) {
      nodes_[number].below[0] = leaves_.size();
      leaves_.push_back({cell, {}, {}, {}, 0});
      return number;
    }
    LatticeBox low = cell, high = cell;
    low.max[axis] = high.min[axis] = plane;
    const std::size_t first = split(begin, middle, low), second = split(middle, end, high);
    nodes_[number] = {axis, plane, {first, second}};
    return number;
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
  for (auto f = FaceId(region.fixed); f < region.faces.size(); ++f) {
    Triangle& t = whole.triangles[region.faces[f]];
    t.fill(kNoId);
    for (HalfEdgeId h = 3 * f; h < 3 * f + 3 && mesh.alive(f); ++h) t[h % 3] = region.vertices[mesh.from(h)];
  }
}

void drop_removed(Piece& whole) {
  std::erase_if(whole.triangles, [](const Triangle& t) { return t[0] == kNoId; });
  std::vector<VertexId> number(whole.vertices.size(), kNoId);
  for (const Triangle& t : whole.triangles) {
    for (const VertexId v : t) number[v] = 0;
  }
  VertexId n = 0;
  for (VertexId v = 0; v < number.size(); ++v) {
    if (number[v] == kNoId) continue;
    whole.vertices[n] = whole.vertices[v];
    if (!whole.quadrics.empty()) whole.quadrics[n] = whole.quadrics[v];
    number[v] = n++;
  }
  whole.vertices.resize(n);
  if (!whole.quadrics.empty()) whole.quadrics.resize(n);
  for (Triangle& t : whole.triangles) {
    for (VertexId& v : t) v = number[v];
  }
}

int128 volume6(const Piece& whole) {
  int128 sum = 0;
  for (const auto& [a, b, c] : whole.triangles)
    sum += orient3d_value(whole.vertices[0], whole.vertices[a], whole.vertices[b], whole.vertices[c]);
  return sum;
}

}  // namespace bp
