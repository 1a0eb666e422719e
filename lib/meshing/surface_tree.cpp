#include "lib/meshing/surface_tree.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "lib/core/parallel.h"
#include "lib/meshing/collapse_order.h"
#include "lib/meshing/flatten.h"

namespace bp {

namespace {

constexpr std::uint64_t kMargin = 3;   // cells stop where the next round might pass the wanted number of faces
constexpr double kBoundPerLevel = 16;  // of the last bound: a round leaves about 40 % of the faces
constexpr std::int64_t kBrickLattice = std::int64_t(kBrickEdge) * kLatticePerVoxel;

struct Node {
  BrickCoord coord;  // of the cell, in cells of its level, from the lowest brick on
  Piece piece;
  SimplifyCounts counts;
};

/// The faces of a dense surface by brick: each lies in the one that its least corner lies in.
class Splitter {
 public:
  explicit Splitter(const LatticeMesh& dense) : dense_(dense), id_(dense.vertices.size()), owner_(id_.size(), 0) {}

  [[nodiscard]] BrickCoord brick(std::uint32_t face) const {
    BrickCoord brick;
    const auto& t = dense_.triangles[face];
    for (int i = 0; i < 3; ++i) {
      const std::int64_t least =
          std::min({dense_.vertices[t[0]][i], dense_.vertices[t[1]][i], dense_.vertices[t[2]][i]});
      brick[i] = std::int32_t(floor_div(least, kBrickLattice));
    }
    return brick;
  }

  /// Appends a node for each brick, with its coordinates from `origin` on.
  void split(BrickCoord origin, std::vector<Node>& nodes) {
    std::map<std::array<std::int32_t, 3>, std::vector<std::uint32_t>> faces;  // by z, y, x
    for (std::uint32_t f = 0; f < dense_.triangles.size(); ++f) {
      const BrickCoord b = brick(f) - origin;
      faces[{b.z, b.y, b.x}].push_back(f);
    }
    for (auto& [zyx, list] : faces) {
      Node& node = nodes.emplace_back();
      node.coord = {zyx[2], zyx[1], zyx[0]};
      fill(std::uint32_t(nodes.size()), list, node.piece);
      list = {};
    }
  }

 private:
  void fill(std::uint32_t owner, const std::vector<std::uint32_t>& faces, Piece& piece) {
    for (const std::uint32_t f : faces) {
      Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = dense_.triangles[f][k];
        if (owner_[v] != owner) {
          owner_[v] = owner;
          id_[v] = std::uint32_t(piece.vertices.size());
          piece.vertices.push_back(dense_.vertices[v]);
        }
        triangle[k] = id_[v];
      }
      piece.triangles.push_back(triangle);
    }
  }

  const LatticeMesh& dense_;
  std::vector<std::uint32_t> id_, owner_;  // per vertex: its place in the piece that had it last, and which
};

class SurfaceTree {
 public:
  SurfaceTree(const LatticeMesh& dense, const SimplifyParams& params) : params_(params) {
    Splitter splitter(dense);
    for (std::uint32_t f = 0; f < dense.triangles.size(); ++f) {
      const BrickCoord b = splitter.brick(f);
      origin_ = {std::min(origin_.x, b.x), std::min(origin_.y, b.y), std::min(origin_.z, b.z)};
    }
    splitter.split(origin_, nodes_);
    for (Node& node : nodes_) node.piece.cell = cell_box(node.coord);
  }

  void merge_flat() {
    for_each_node([&](Node& node) {
      HalfEdgeMesh mesh(std::move(node.piece.vertices), node.piece.triangles, node.piece.cell);
      merge_flat_regions(mesh, params_.edge_limit);
      node.piece.vertices = {};
      node.piece.triangles =
          mesh.live_faces([&](VertexId v, VertexId) { node.piece.vertices.push_back(mesh.position(v)); });
    });
  }

  void collapse(BulkRange range) {
    for_each_node([&](Node& node) {
      Piece& piece = node.piece;
      HalfEdgeMesh mesh(std::move(piece.vertices), piece.triangles, piece.cell);
      Collapser collapser(mesh, std::move(piece.quadrics), params_, node.counts);
      collapse_bulk(collapser, range, 0);
      piece.vertices = {};
      piece.quadrics = {};
      piece.triangles = mesh.live_faces([&](VertexId v, VertexId) {
        piece.vertices.push_back(mesh.position(v));
        piece.quadrics.push_back(collapser.quadric(v));
      });
    });
  }

  /// One level up: the cells of twice the edge.
  void weld_cells() {
    edge_ *= 2;
    const auto parent = [](BrickCoord c) { return BrickCoord{c.x / 2, c.y / 2, c.z / 2}; };
    const auto key = [&](const Node& n) {
      const BrickCoord p = parent(n.coord);
      return std::tuple(p.z, p.y, p.x);
    };
    std::stable_sort(nodes_.begin(), nodes_.end(), [&](const Node& a, const Node& b) { return key(a) < key(b); });
    std::vector<std::pair<std::size_t, std::size_t>> groups;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (i == 0 || key(nodes_[i]) != key(nodes_[i - 1])) groups.emplace_back(i, i);
      groups.back().second = i + 1;
    }
    std::vector<Node> parents(groups.size());
    parallel_for(std::int64_t(groups.size()), [&](std::int64_t i) {
      const auto [begin, end] = groups[std::size_t(i)];
      Node& node = parents[std::size_t(i)];
      node.coord = parent(nodes_[begin].coord);
      node.piece = weld_nodes(begin, end, node.counts);
      node.piece.cell = cell_box(node.coord);
    });
    nodes_ = std::move(parents);
  }

  [[nodiscard]] Piece weld_all(SimplifyCounts& counts) { return weld_nodes(0, nodes_.size(), counts); }
  [[nodiscard]] bool whole() const { return nodes_.size() < 2; }
  [[nodiscard]] std::uint64_t faces() const {
    std::uint64_t n = 0;
    for (const Node& node : nodes_) n += node.piece.triangles.size();
    return n;
  }

 private:
  template <class Body>
  void for_each_node(Body&& body) {
    parallel_for(std::int64_t(nodes_.size()), [&](std::int64_t i) { body(nodes_[std::size_t(i)]); });
  }

  [[nodiscard]] LatticeBox cell_box(BrickCoord coord) const {
    LatticeBox box;
    for (int i = 0; i < 3; ++i) {
      box.min[i] = origin_[i] * kBrickLattice + coord[i] * edge_;
      box.max[i] = box.min[i] + edge_;
    }
    return box;
  }

  [[nodiscard]] Piece weld_nodes(std::size_t begin, std::size_t end, SimplifyCounts& counts) {
    std::vector<Piece> pieces;
    for (std::size_t i = begin; i < end; ++i) {
      pieces.push_back(std::move(nodes_[i].piece));
      counts.collapses += nodes_[i].counts.collapses;
      counts.solved += nodes_[i].counts.solved;
    }
    return weld(pieces);
  }

  const SimplifyParams& params_;
  BrickCoord origin_{INT32_MAX, INT32_MAX, INT32_MAX};  // lowest brick in each coordinate: all weld into one cell
  std::int64_t edge_ = kBrickLattice;                   // of a cell
  std::vector<Node> nodes_;                             // by cell: z, y, x
};

}  // namespace

Piece simplified_surface(const LatticeMesh& dense, const SimplifyParams& params, std::uint64_t enough,
                         SimplifyCounts& counts) {
  SurfaceTree tree(dense, params);
  tree.merge_flat();
  const std::uint64_t flat = tree.faces();
  if (enough > 0) {
    for (double last = 4 * kFirstBound; tree.faces() > kMargin * enough; last *= kBoundPerLevel) {
      tree.collapse({kFirstBound, last});
      if (tree.whole()) break;
      tree.weld_cells();
    }
  }
  Piece root = tree.weld_all(counts);
  root.cell = kEverywhere;
  counts.faces_flat = flat;
  return root;
}

}  // namespace bp
