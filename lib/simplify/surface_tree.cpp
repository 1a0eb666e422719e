#include "lib/simplify/surface_tree.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <tuple>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/mesh/step_limits.h"
#include "lib/simplify/collapse_regions.h"
#include "lib/simplify/detail/bulk_order.h"
#include "lib/simplify/flatten.h"

namespace bp {

namespace {

// Cells stop where the next round might pass the wanted number of faces: at kMargin times as many, or at kMarginOfMany
// for surfaces that are better not held at once. At kFew faces they stop for regions (collapse_regions.h): the last
// rounds have fewer cells than there are threads, whereas regions have equal sizes.
constexpr std::uint64_t kMargin = 3, kMarginOfMany = 2, kManyFaces = std::uint64_t(1) << 20, kFew = 100000;
constexpr std::uint64_t kFewCells = 32, kMarginOfFew = 5;  // with so few cells threads would be idle: they stop earlier
constexpr double kNearlyAll = 0.95;  // cells are joined only after a round that left this share of the faces
// Factor of the last bound for each level: a round leaves about 40 % of the faces.
constexpr double kBoundPerLevel = 16;
constexpr std::int64_t kBrickLattice = std::int64_t(kBrickEdge) * kLatticePerVoxel;
constexpr std::uint64_t kLargeCell = std::uint64_t(1) << 17;  // faces: few cells grow beyond that

/// Calls body(i) for i in [0, n), with at most `in_flight` calls begun and not ended.
template <class Body>
void parallel_few(std::size_t n, std::size_t in_flight, const Body& body) {
  std::atomic<std::size_t> next = 0;
  parallel_for(std::int64_t(std::min(n, in_flight)), [&](std::int64_t) {
    for (std::size_t i = next++; i < n; i = next++) body(i);
  });
}

struct Node {
  BrickCoord coord;                 // coordinates of the cell, in cells of its level, from the lowest brick on
  std::vector<WaitingPiece> parts;  // one piece, or those of the cells below it, not yet welded
  SimplifyCounts counts;

  [[nodiscard]] std::uint64_t face_count() const {
    std::uint64_t n = 0;
    for (const WaitingPiece& part : parts) n += part.face_count();
    return n;
  }
};

/// Foresees what is to come from the flat faces: few cells grow beyond kLargeCell, and rounds leave some times the
/// faces that are wanted.
SurfaceWork foreseen_work(std::uint64_t flat, const BulkEnd& end) {
  const std::uint64_t left = std::max(kMarginOfFew * end.faces, kFew);
  const bool has_rounds = end.cost > 0 && flat > kMargin * end.faces;
  return {kWorkPerFace * (end.cost > 0 ? std::min(flat, left) : flat),
          has_rounds ? kWorkPerFace * std::min(flat, kLargeCell) : 0, flat};
}

/// Returns the box of a cell. `origin`: the lowest brick; `edge`: of the cell, lattice units.
LatticeBox cell_box(BrickCoord origin, BrickCoord coord, std::int64_t edge) {
  LatticeBox box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = origin[i] * kBrickLattice + coord[i] * edge;
    box.max[i] = box.min[i] + edge;
  }
  return box;
}

class SurfaceTree {
 public:
  SurfaceTree(const SurfaceSource& surface, const SimplifyParams& params, const BulkEnd& end)
      : surface_(surface), params_(params), end_(end), store_(params.memory) {}

  /// Makes the cells of the first level: bricks, with their flat regions merged. Returns the number of faces before
  /// merging.
  std::uint64_t begin() {
    const std::vector<BrickCoord> bricks = surface_.bricks();
    for (const BrickCoord& b : bricks) {
      for (int i = 0; i < 3; ++i) origin_[i] = std::min(origin_[i], b[i]);
    }
    nodes_.resize(bricks.size());
    std::atomic<std::uint64_t> faces = 0;
    parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
      Piece piece = surface_.piece(bricks[std::size_t(i)]);
      if (piece.triangles.empty()) return;
      faces += piece.triangles.size();
      merge_flat_regions(piece, params_.edge_limit);
      Node& node = nodes_[std::size_t(i)];
      node.coord = bricks[std::size_t(i)] - origin_;
      node.parts.push_back(store_.put(std::move(piece)));
    });
    std::erase_if(nodes_, [](const Node& node) { return node.parts.empty(); });
    work_ = foreseen_work(this->faces(), end_);
    if (params_.memory.count) params_.memory.count(work_);
    return faces;
  }

  /// Collapses edges in all cells, the largest cell first: else it might begin when all others are done.
  void collapse(BulkRange range) {
    const std::size_t in_flight = nodes_in_hand();
    std::vector<std::pair<std::uint64_t, Node*>> order;
    for (Node& node : nodes_) order.emplace_back(node.face_count(), &node);
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    parallel_few(nodes_.size(), in_flight, [&](std::size_t i) {
      Node& node = *order[i].second;
      Piece piece = welded(node);
      HalfEdgeMesh mesh(std::move(piece.vertices), piece.triangles, piece.cell);
      SimplifyParams own = params_;
      const std::unique_ptr<StepLimits> limits = limits_of_part();
      own.limits = limits.get();
      Collapser collapser(mesh, std::move(piece.quadrics), own, node.counts);
      collapse_bulk(collapser, range, 0);
      if (collapser.sense() != nullptr) erase_turned_shells(mesh, *collapser.sense());
      if (limits != nullptr) add_part(*limits);
      piece.vertices = {};
      piece.quadrics = {};
      piece.triangles = mesh.live_faces([&](VertexId v, VertexId) {
        piece.vertices.push_back(mesh.position(v));
        piece.quadrics.push_back(collapser.quadric(v));
      });
      node.parts.push_back(store_.put(std::move(piece)));
    });
  }

  /// Goes one level up, to cells of twice the edge. Their parts are welded when they are needed.
  void join_cells() {
    edge_ *= 2;
    const auto parent = [](BrickCoord c) { return BrickCoord{c.x / 2, c.y / 2, c.z / 2}; };
    const auto key = [&](const Node& n) {
      const BrickCoord p = parent(n.coord);
      return std::tuple(p.z, p.y, p.x);
    };
    std::stable_sort(nodes_.begin(), nodes_.end(), [&](const Node& a, const Node& b) { return key(a) < key(b); });
    std::vector<Node> parents;
    for (Node& node : nodes_) {
      const BrickCoord coord = parent(node.coord);
      if (parents.empty() || parents.back().coord != coord) parents.emplace_back().coord = coord;
      Node& to = parents.back();
      for (WaitingPiece& part : node.parts) to.parts.push_back(std::move(part));
      to.counts.collapses += node.counts.collapses;
      to.counts.solved += node.counts.solved;
    }
    nodes_ = std::move(parents);
  }

  [[nodiscard]] Piece weld_all(SimplifyCounts& counts) {
    check_work(faces(), params_.memory.bytes());
    std::vector<Piece> pieces;
    for (Node& node : nodes_) {
      pieces.push_back(welded(node));
      counts.collapses += node.counts.collapses;
      counts.solved += node.counts.solved;
    }
    return weld(pieces);
  }

  [[nodiscard]] std::size_t cells() const { return nodes_.size(); }
  [[nodiscard]] bool whole() const { return nodes_.size() < 2; }
  [[nodiscard]] std::uint64_t faces() const {
    std::uint64_t n = 0;
    for (const Node& node : nodes_) n += node.face_count();
    return n;
  }

 private:
  /// Throws if `left` bytes do not suffice for so many triangles at once.
  void check_work(std::uint64_t faces, std::uint64_t left) const {
    const std::uint64_t needed = faces * kWorkPerFace;
    if (needed <= left) return;
    const std::uint64_t in_hand = left < params_.memory.bytes() ? std::max(needed, work_.cell_bytes) : work_.cell_bytes;
    throw NeedsMemory(fmt::format("simplifying {} triangles at once", faces), needed, left,
                      params_.memory.limit_for(std::max(needed, work_.whole_bytes), in_hand),
                      {Remedy::larger_voxels, Remedy::fewer_faces});
  }

  /// Returns how many nodes may be at work, if each is as large as the largest.
  [[nodiscard]] std::size_t nodes_in_hand() const {
    std::uint64_t largest = 1;
    for (const Node& node : nodes_) largest = std::max(largest, node.face_count());
    const std::uint64_t bytes = params_.memory.work_bytes;
    const std::uint64_t limits = params_.limits != nullptr ? params_.limits->bytes_of_part() : 0;
    check_work(largest, bytes);
    return std::size_t(std::clamp<std::uint64_t>(bytes / (largest * kWorkPerFace + limits), 1, thread_count()));
  }

  [[nodiscard]] std::unique_ptr<StepLimits> limits_of_part() {
    if (params_.limits == nullptr) return nullptr;
    const std::lock_guard lock(mutex_);
    std::unique_ptr<StepLimits> part = params_.limits->for_part();
    if (part == nullptr) fail(ErrorCode::bad_argument, "limits of the surface as a whole cannot be kept by cells");
    return part;
  }
  void add_part(const StepLimits& part) {
    const std::lock_guard lock(mutex_);
    params_.limits->add_part(part);
  }

  /// Returns the piece of a node, and empties the node.
  [[nodiscard]] Piece welded(Node& node) {
    std::vector<Piece> pieces;
    for (WaitingPiece& part : node.parts) pieces.push_back(store_.take(std::move(part)));
    node.parts.clear();
    Piece piece = pieces.size() == 1 ? std::move(pieces.front()) : weld(pieces);
    piece.cell = cell_box(origin_, node.coord, edge_);
    return piece;
  }

  const SurfaceSource& surface_;
  const SimplifyParams& params_;
  const BulkEnd end_;
  PieceStore store_;
  SurfaceWork work_;                                    // the work that is foreseen
  BrickCoord origin_{INT32_MAX, INT32_MAX, INT32_MAX};  // lowest brick in each coordinate: all weld into one cell
  std::int64_t edge_ = kBrickLattice;                   // edge of a cell, lattice units
  std::vector<Node> nodes_;                             // sorted by cell: z, y, x
  std::mutex mutex_;                                    // for params_.limits
};

}  // namespace

void check_dense(std::uint64_t faces, const PieceMemory& memory) {
  const std::uint64_t needed = faces * kBytesPerMeshedFace, left = memory.bytes();
  if (needed > left)
    throw NeedsMemory(fmt::format("a surface of {} triangles in one mesh", faces), needed, left,
                      memory.limit_for(needed), {Remedy::larger_voxels});
}

namespace {

bool needs_round(const SurfaceTree& tree, const BulkEnd& end, const SimplifyParams& params) {
  const std::uint64_t faces = tree.faces();
  if (end.cost <= 0 || (faces <= kFew && has_bulk_regions(faces, end, params))) return false;
  const std::uint64_t margin = tree.cells() < kFewCells ? kMarginOfFew : kMargin;
  return faces > margin * end.faces || (faces > kManyFaces && faces > kMarginOfMany * end.faces);
}

}  // namespace

Piece simplified_surface(const SurfaceSource& surface, const SimplifyParams& params, const BulkEnd& end,
                         SimplifyCounts& counts) {
  SurfaceTree tree(surface, params, end);
  counts.faces_in = tree.begin();
  counts.faces_flat = tree.faces();
  for (double last = 4 * kFirstBound; needs_round(tree, end, params); last *= kBoundPerLevel) {
    const std::uint64_t before = tree.faces();
    tree.collapse({kFirstBound, std::min(last, end.cost)});
    if (tree.whole() || last >= end.cost) break;
    if (tree.cells() >= kFewCells || double(tree.faces()) > kNearlyAll * double(before)) tree.join_cells();
  }
  Piece root = tree.weld_all(counts);
  root.cell = kEverywhere;
  return root;
}

}  // namespace bp
