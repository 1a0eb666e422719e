#include "lib/simplify/regions.h"

#include <algorithm>
#include <array>
#include <bit>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::array<double, 3> kShares = {0.5, 0.35, 0.65};  // share of the faces on the lower side of a cut, by turn
constexpr std::size_t kSample = 1024;                         // faces that are sampled to choose the axis of a cut
constexpr std::int64_t kFacesAtOnce = 1 << 14;

class Splitter {
 public:
  Splitter(const Piece& whole, std::uint64_t most, double share)
      : whole_(whole), most_(most), share_(share), faces_(whole.triangles.size()), middles_(faces_.size()) {
    const LatticeBox box = box_of(whole.vertices);
    for (int axis = 0; axis < 3; ++axis) base_[axis] = box.min[axis] + (box.max[axis] - box.min[axis]) / 2;
    parallel_ranges(std::int64_t(faces_.size()), kFacesAtOnce, [&](std::int64_t begin, std::int64_t end) {
      for (auto f = FaceId(begin); f < FaceId(end); ++f) {
        faces_[f] = f;
        set_middle(f);
      }
    });
    nodes_.push_back({0, faces_.size(), kEverywhere});
    for (std::size_t done = 0; done < nodes_.size();) {  // one level of the tree at a time
      const std::size_t level = done;
      done = nodes_.size();
      parallel_for(std::int64_t(done - level), [&](std::int64_t i) { cut(nodes_[level + std::size_t(i)]); });
      for (std::size_t i = level; i < done; ++i) add_halves(i);
    }
    add_leaves(0);
  }

  std::vector<Region> gather() {
    std::vector<std::vector<std::pair<std::size_t, FaceId>>> found(whole_.triangles.size() / kFacesAtOnce + 1);
    parallel_ranges(std::int64_t(whole_.triangles.size()), kFacesAtOnce, [&](std::int64_t begin, std::int64_t end) {
      for (auto f = FaceId(begin); f < FaceId(end); ++f) {
        const auto& [a, b, c] = whole_.triangles[f];
        const LatticeBox box = box_of(whole_.vertices[a], whole_.vertices[b], whole_.vertices[c]);
        reach_into(0, f, box, found[std::size_t(begin / kFacesAtOnce)]);
      }
    });
    for (const auto& some : found) {
      for (const auto& [leaf, f] : some) leaves_[leaf].faces.push_back(f);
    }
    return std::move(leaves_);
  }

 private:
  /// A node for faces_[begin, end). Inner node: `axis` and `plane` divide its cell; below[0] has the faces that are not
  /// beyond the plane, up to `middle`. Leaf: axis is -1.
  struct Node {
    std::size_t begin, end;
    LatticeBox cell;
    int axis = -1;
    std::int64_t plane = 0;
    std::size_t middle = 0;
    std::array<std::size_t, 2> below{};  // the two nodes below; for a leaf the first is its number
  };

  /// A mesh spans at most twice kMaxSpan (HalfEdgeMesh::room()), so three times the distance from its centre fits.
  void set_middle(FaceId f) {
    static_assert(HalfEdgeMesh::kMaxSpan <= std::int64_t(1) << 29);
    const auto& [a, b, c] = whole_.triangles[f];
    const LatticeCoord sum = whole_.vertices[a] + whole_.vertices[b] + whole_.vertices[c] - base_ * 3;
    middles_[f] = {std::int32_t(sum.x), std::int32_t(sum.y), std::int32_t(sum.z)};
  }
  [[nodiscard]] std::int64_t thrice_middle(FaceId f, int axis) const {
    return 3 * base_[axis] + middles_[f][std::size_t(axis)];
  }

  /// Decides where to cut the node, and sorts its faces.
  void cut(Node& node) {
    if (node.end - node.begin <= most_) return;
    for (const int axis : axes(node.begin, node.end)) {
      const std::int64_t plane = plane_across(axis, node.begin, node.end);
      if (plane <= node.cell.min[axis] || plane >= node.cell.max[axis]) continue;
      const auto first = faces_.begin() + std::ptrdiff_t(node.begin), last = faces_.begin() + std::ptrdiff_t(node.end);
      node.middle = std::size_t(
          std::stable_partition(first, last, [&](FaceId f) { return thrice_middle(f, axis) <= 3 * plane; }) -
          faces_.begin());
      if (node.middle == node.begin || node.middle == node.end) continue;
      node.axis = axis;
      node.plane = plane;
      return;
    }
  }

  void add_halves(std::size_t number) {
    const Node node = nodes_[number];
    if (node.axis < 0) return;
    LatticeBox low = node.cell, high = node.cell;
    low.max[node.axis] = high.min[node.axis] = node.plane;
    nodes_[number].below = {nodes_.size(), nodes_.size() + 1};
    nodes_.push_back({node.begin, node.middle, low});
    nodes_.push_back({node.middle, node.end, high});
  }

  /// Adds the leaves below a node, the lower one first.
  void add_leaves(std::size_t number) {
    if (nodes_[number].axis >= 0) {
      for (const std::size_t below : nodes_[number].below) add_leaves(below);
      return;
    }
    nodes_[number].below[0] = leaves_.size();
    leaves_.push_back({nodes_[number].cell, {}, {}, {}, 0, {}});
  }

  /// Returns the axes, the one along which the middle half of a sample spreads most first. The middle half decides, so
  /// that a rod on a wall does not cause a cut between the wall's two sides.
  [[nodiscard]] std::vector<int> axes(std::size_t begin, std::size_t end) const {
    const std::size_t step = std::max<std::size_t>((end - begin) / kSample, 1);
    std::array<std::int64_t, 3> spread{};
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::int64_t> at;
      for (std::size_t i = begin; i < end; i += step) at.push_back(thrice_middle(faces_[i], axis));
      std::sort(at.begin(), at.end());
      spread[std::size_t(axis)] = at[at.size() * 3 / 4] - at[at.size() / 4];
    }
    std::vector<int> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return spread[std::size_t(a)] > spread[std::size_t(b)]; });
    return order;
  }

  /// Returns a plane with about the wanted share of the faces on its lower side. It avoids planes between voxels, where
  /// very many vertices lie that would be locked.
  [[nodiscard]] std::int64_t plane_across(int axis, std::size_t begin, std::size_t end) const {
    std::vector<std::int64_t> at;
    for (std::size_t i = begin; i < end; ++i) at.push_back(thrice_middle(faces_[i], axis));
    const auto middle = at.begin() + std::ptrdiff_t(share_ * double(at.size()));
    std::nth_element(at.begin(), middle, at.end());
    const std::int64_t plane = floor_div(*middle, std::int64_t(3));
    return plane % kLatticePerVoxel == 0 ? plane + kLatticePerVoxel / 2 : plane;
  }

  /// Notes the face for each closed cell that its box meets.
  void reach_into(std::size_t number, FaceId f, const LatticeBox& box,
                  std::vector<std::pair<std::size_t, FaceId>>& found) const {
    const Node& node = nodes_[number];
    if (node.axis < 0) {
      found.emplace_back(node.below[0], f);
      return;
    }
    if (box.min[node.axis] <= node.plane) reach_into(node.below[0], f, box, found);
    if (box.max[node.axis] >= node.plane) reach_into(node.below[1], f, box, found);
  }

  const Piece& whole_;
  const std::uint64_t most_;  // faces of a leaf
  const double share_;
  std::vector<FaceId> faces_;
  LatticeCoord base_;                                 // the centre
  std::vector<std::array<std::int32_t, 3>> middles_;  // per face: three times its middle, relative to three times base_
  std::vector<Node> nodes_;
  std::vector<Region> leaves_;
};

/// Numbers some vertices of the whole: a hash table.
class Numbers {
 public:
  explicit Numbers(std::size_t most) : slots_(std::bit_ceil(most + 1), {kNoId, 0}) {}
  /// Returns the number of v, which is `fresh` if v is new.
  std::uint32_t& of(VertexId v, std::uint32_t fresh) {
    std::size_t i = v * std::size_t(0x9e3779b1u);
    for (;; ++i) {
      auto& [key, number] = slots_[i & (slots_.size() - 1)];
      if (key == v) return number;
      if (key != kNoId) continue;
      key = v;
      return number = fresh;
    }
  }

 private:
  std::vector<std::pair<VertexId, std::uint32_t>> slots_;
};

/// Completes a region whose cell and faces are known: its vertices, which of them are free, and so which faces stay.
void settle(const Piece& whole, Region& region) {
  Numbers numbers(3 * region.faces.size());
  for (const FaceId f : region.faces) {
    for (const VertexId v : whole.triangles[f]) {
      if (numbers.of(v, std::uint32_t(region.vertices.size())) == region.vertices.size()) region.vertices.push_back(v);
    }
  }
  std::sort(region.vertices.begin(), region.vertices.end());
  for (std::uint32_t i = 0; i < region.vertices.size(); ++i) numbers.of(region.vertices[i], i) = i;
  const auto local = [&](FaceId f) {
    Triangle t = whole.triangles[f];
    for (VertexId& v : t) v = numbers.of(v, 0);
    return t;
  };
  for (const VertexId v : region.vertices) region.free.push_back(region.cell.holds_inside(whole.vertices[v]));
  for (const FaceId f : region.faces) {
    const auto& [a, b, c] = whole.triangles[f];
    if (region.cell.holds(box_of(whole.vertices[a], whole.vertices[b], whole.vertices[c]))) continue;
    for (const VertexId v : local(f)) region.free[v] = 0;
  }
  const auto stays = [&](FaceId f) {
    const Triangle t = local(f);
    return std::none_of(t.begin(), t.end(), [&](VertexId v) { return region.free[v] != 0; });
  };
  const auto first = std::stable_partition(region.faces.begin(), region.faces.end(), stays);
  region.fixed = std::size_t(first - region.faces.begin());
  for (const FaceId f : region.faces) region.triangles.push_back(local(f));
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
  HalfEdgeMesh mesh(std::move(vertices), region.triangles, region.cell);
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
    if (f < region.fixed && mesh.alive(f)) continue;  // other regions may know the face, too
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
