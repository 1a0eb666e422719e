#include "lib/check/tile_cover.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>

#include "lib/check/counted.h"
#include "lib/check/detail/leaf_proof.h"
#include "lib/check/detail/tile_body.h"
#include "lib/check/tile_drawn.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/exact/triangle_part.h"
#include "lib/geometry/triangle_totals.h"
#include "lib/tileset/tile_tree.h"

namespace bp {

namespace {

constexpr double kLeafRounding = 16;        // rounding of values computed from a leaf and the scene, for rounding_of()
constexpr double kMostLeafError = 0x1p-18;  // of the longest edge of the scene's box
constexpr double kFlat = 0x1p-22;  // relative to the same edge: float32 rounds that much in a tile four times as long

/// Verdicts on a triangle in the cell of a tile. bare, uncovered: nothing is drawn, in the cell or in an octant of it.
enum class Verdict { fine, thin, flat, touching, outside, undecided, rounded, missing, bare, uncovered, count };

/// The content of a leaf, which must be the scene itself.
struct LeafBody {
  LeafBody(const IndexedMesh& content, const Bounds3d& cell, double flat)
      : mesh(weld(content, 1, report)), surface(mesh), proof(surface.bvh(), cell, flat) {}
  CheckReport report;
  WeldedMesh mesh;
  Surface surface;
  LeafProof proof;
};

struct Counts {
  std::array<std::atomic<std::uint64_t>, std::size_t(Verdict::count)> triangles{};
  [[nodiscard]] std::uint64_t of(Verdict verdict) const { return triangles[std::size_t(verdict)]; }
  std::uint64_t strays = 0;  ///< triangles of a leaf
};

class CoverChecker {
 public:
  CoverChecker(const std::vector<CoverTile>& tiles, const CoverContents& content_of, TilePart part)
      : tiles_(tiles),
        content_of_(content_of),
        mine_(tiles_of(part, tiles)),
        bodies_(tiles.size()),
        leaves_(tiles.size()),
        unsound_(tiles.size()),
        counts_(tiles.size()),
        below_(tiles.size()),
        octants_(tiles.size()),
        held_(tiles_held_above(tiles)),
        refused_(tiles.size()) {
    find_below(0);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      if (tiles[i].cell) octants_[i] = children_in_octants(i);
    }
  }

  CoverReport run(TriangleSource& scene, std::uint64_t memory_bytes) {
    judge_errors(scene);
    for (begin_ = 0; begin_ < tiles_.size(); begin_ = end_) {
      end_ = end_of_share(memory_bytes);
      parallel_for(std::int64_t(end_ - begin_), [&](std::int64_t i) { load(begin_ + std::size_t(i)); });
      pass(scene);
      for (std::size_t i = begin_; i < end_; ++i) {
        if (leaves_[i]) counts_[i].strays = leaves_[i]->proof.strays();
        leaves_[i].reset();
        bodies_[i].reset();
      }
    }
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (!mine_[i]) continue;
      say_of_tile(i);
      report_.thin += counts_[i].of(Verdict::thin);
      report_.flat += counts_[i].of(Verdict::flat);
    }
    if (mine_[0] && astray_ > 0)
      findings_.push_back(
          {fmt::format("{}: {} triangles of the scene leave its cell", tiles_[0].place, astray_.load())});
    if (mine_[0] && nearly_astray_ > 0)
      findings_.push_back({fmt::format("{}: {} triangles of the scene may leave its cell, as coordinates may be off",
                                       tiles_[0].place, nearly_astray_.load()),
                           Answer::undecided});
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (mine_[i]) say_of_scene(i);
    }
    return std::move(report_);
  }

 private:
  /// The tiles of a subtree that belong to this part of the check.
  struct Numbers {
    std::size_t first = 0, last = 0;   ///< least and largest number of these; none: the first is above the last
    std::optional<double> leaf_error;  ///< the largest error, if the tiles below are only leaves
  };

  /// For each eighth of a tile's cell: the child that has it as its cell, or 0.
  using Octants = std::array<std::uint32_t, 8>;

  [[nodiscard]] Octants children_in_octants(std::size_t i) const {
    Octants out{};
    for (int k = 0; k < 8; ++k) {
      const Bounds3d box = octant_of(*tiles_[i].cell, k);
      for (const std::size_t child : tiles_[i].children) {
        if (tiles_[child].cell == box) out[std::size_t(k)] = std::uint32_t(child);
      }
    }
    return out;
  }

  const Numbers& find_below(std::size_t i) {
    Numbers& all = below_[i] = {mine_[i] ? i : SIZE_MAX, mine_[i] ? i : 0, 0.0};
    for (const std::size_t child : tiles_[i].children) {
      const Numbers& some = find_below(child);
      all.first = std::min(all.first, some.first), all.last = std::max(all.last, some.last);
      const bool is_leaf = tiles_[child].leaf_error.has_value();
      if (!some.leaf_error || (tiles_[child].triangles && !is_leaf)) all.leaf_error.reset();
      if (all.leaf_error)
        all.leaf_error = std::max({*all.leaf_error, *some.leaf_error, tiles_[child].leaf_error.value_or(0)});
    }
    return all;
  }

  [[nodiscard]] std::size_t end_of_share(std::uint64_t memory_bytes) const {
    std::uint64_t bytes = 0;
    std::size_t end = begin_;
    while (end < tiles_.size()) {
      bytes += mine_[end] ? tiles_[end].triangles.value_or(0) * kCoverBytesPerTriangle : 0;
      if (bytes > memory_bytes && end > begin_) break;
      ++end;
    }
    return end;
  }

  void load(std::size_t i) {
    if (!mine_[i] || !tiles_[i].triangles || refused_[i]) return;
    if (tiles_[i].leaf_error) {
      leaves_[i] = std::make_unique<LeafBody>(content_of_(i), *tiles_[i].cell, kFlat * scene_edge_);
    } else {
      bodies_[i] = std::make_unique<TileBody>(content_of_(i), i);
      unsound_[i] = !bodies_[i]->sound();
    }
  }

  void pass(TriangleSource& scene) {
    scene.rewind();
    pipeline<std::vector<TriangleD>>(
        2 * thread_count(), [&](std::vector<TriangleD>& chunk) { return scene.read(chunk); },
        [&](std::vector<TriangleD>& chunk) {
          KnownInside known;
          for (const TriangleD& t : chunk) {
            const double off = rounding_.of(t);
            if (in_root(t, 0)) {
              if (begin_ == 0 && !in_root(t, off)) ++nearly_astray_;
              visit(0, {t, bounds_of(t), off}, known);
            } else if (begin_ == 0) {
              ++astray_;
            }
          }
        },
        [](std::vector<TriangleD>&) {});
  }

  static constexpr std::size_t kSame = 8, kNowhere = 9, kPlaces = 10;
  /// Returns the octant of a tile that a child has as its cell; kSame: the whole cell.
  [[nodiscard]] std::size_t place_in(std::size_t parent, std::size_t child) const {
    const auto &p = tiles_[parent].cell, &c = tiles_[child].cell;
    if (p == c) return kSame;
    for (int k = 0; p && c && k < 8; ++k) {
      if (octant_of(*p, k) == *c) return std::size_t(k);
    }
    return kNowhere;
  }

  /// Returns whether the root's cell holds t, and all that is within `off` of it.
  [[nodiscard]] bool in_root(const TriangleD& t, double off) const {
    if (!tiles_[0].cell) return true;
    const Bounds3d& cell = *tiles_[0].cell;
    for (const Vec3d& p : t) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (!(p[i] - off >= cell.min[i] && p[i] + off <= cell.max[i])) return false;
      }
    }
    return true;
  }

  /// A triangle of the scene, its box, and what its points may be off by.
  struct Sought {
    const TriangleD& t;
    Bounds3d bounds;
    double off = 0;
  };
  /// True unless t surely avoids all that is within `off` of the closed cell.
  [[nodiscard]] static bool meets(const Sought& of, const Bounds3d& cell, double off) {
    if (lies_in(of.bounds, cell)) return true;
    const Bounds3d box = grown(cell, growth_for(cell, of.t) / 2 + off);
    return overlap(of.bounds, box) && !TrianglePart(of.t, box).empty();
  }
  /// Returns whether t meets the cell as read, and not only within what it may be off by.
  [[nodiscard]] bool meets_as_read(std::size_t i, const Sought& of) const {
    return of.off == 0 || !tiles_[i].cell || meets(of, *tiles_[i].cell, 0);
  }
  /// Tests t, which may meet the cell of tile i, in the subtree. Only tiles of this share count.
  void visit(std::size_t i, const Sought& of, KnownInside& known) {
    if (below_[i].first >= end_ || below_[i].last < begin_) return;
    const CoverTile& tile = tiles_[i];
    const bool mine = mine_[i] && i >= begin_ && i < end_;
    if (mine && !held_[i] && !tile.triangles && tile.children.empty()) count(i, shown_by_nothing(i, of));
    if (mine && tile.triangles && !refused_[i]) count(i, tile.leaf_error ? compare(i, of.t) : examine(i, of, known));
    if (tile.children.empty()) return;
    if (tile.children.size() == 1 && tiles_[tile.children[0]].cell == tile.cell)
      return visit(tile.children[0], of, known);
    if (!tile.cell) return;
    const Bounds3d near = grown(of.bounds, growth_for(*tile.cell, of.t) + of.off);
    const bool stays = held_[i] || (tile.adds && tile.triangles && !tile.leaf_error);
    for (int k = 0; k < 8; ++k) {
      const Bounds3d octant = octant_of(*tile.cell, k);
      if (!overlap(near, octant) || !meets(of, octant, of.off)) continue;
      if (const std::size_t child = octants_[i][std::size_t(k)]; child != 0) {
        visit(child, of, known);
      } else if (mine && !stays) {
        const Verdict verdict = without_child(i, octant, of);
        count(i, verdict == Verdict::missing ? Verdict::uncovered : verdict);
      }
    }
  }

  void count(std::size_t i, Verdict verdict) {
    if (verdict != Verdict::fine) ++counts_[i].triangles[std::size_t(verdict)];
  }

  /// Compares t with a leaf.
  [[nodiscard]] Verdict compare(std::size_t i, const TriangleD& t) {
    return compare(leaves_[i]->proof, *tiles_[i].cell, t, *tiles_[i].leaf_error);
  }
  /// Returns the verdict for an octant without a child. No leaf is made for parts of a neighbour's triangle just beyond
  /// a face.
  [[nodiscard]] Verdict without_child(std::size_t i, const Bounds3d& octant, const Sought& of) const {
    if (below_[i].leaf_error) return compare_with_nothing(octant, of.t, *below_[i].leaf_error);
    return of.off == 0 || meets(of, octant, 0) ? Verdict::missing : Verdict::rounded;
  }
  /// Returns the verdict for a tile without content and children: a leaf, or none.
  [[nodiscard]] Verdict shown_by_nothing(std::size_t i, const Sought& of) const {
    const CoverTile& tile = tiles_[i];
    if (!tile.leaf_error || refused_[i]) return meets_as_read(i, of) ? Verdict::bare : Verdict::rounded;
    const Verdict verdict = compare_with_nothing(*tile.cell, of.t, *tile.leaf_error);
    return verdict == Verdict::missing ? Verdict::bare : verdict;
  }
  [[nodiscard]] Verdict compare_with_nothing(const Bounds3d& box, const TriangleD& t, double error) const {
    const TriangleBvh nothing({});
    LeafProof proof(nothing, box, kFlat * scene_edge_);
    return compare(proof, box, t, error);
  }
  /// Compares t with a leaf. A triangle without area shows nothing, and no leaf has it.
  [[nodiscard]] static Verdict compare(LeafProof& proof, const Bounds3d& cell, const TriangleD& t, double error) {
    if (in_predicate_domain(t[0]) && in_predicate_domain(t[1]) && in_predicate_domain(t[2]) &&
        collinear(t[0], t[1], t[2]))
      return Verdict::fine;
    const std::vector<Vec3d> part = part_within(t, cell);
    if (part.empty()) return Verdict::fine;
    switch (proof.add(part, leaf_error(cell, t, error))) {
      case LeafProof::Cover::whole:
        return Verdict::fine;
      case LeafProof::Cover::thin:
        return Verdict::thin;
      case LeafProof::Cover::flat:
        return Verdict::flat;
      case LeafProof::Cover::missing:
        return Verdict::missing;
      default:
        return Verdict::undecided;
    }
  }

  [[nodiscard]] static double leaf_error(const Bounds3d& cell, const TriangleD& t, double error) {
    return error + kLeafRounding * rounding_of(cell, t);
  }

  [[nodiscard]] Verdict examine(std::size_t i, const Sought& of, KnownInside& known) const {
    const TileBody& body = *bodies_[i];
    const std::optional<Bounds3d>& cell = tiles_[i].cell;
    const auto keeps_clear = [&](bool is_inside) {
      return body.keeps_clear(of.t, cell, of.off, is_inside, known) ? Verdict::fine : Verdict::rounded;
    };
    if (!meets_as_read(i, of)) return keeps_clear(false);
    switch (body.side_of(of.t, of.bounds, cell, known)) {
      case TileBody::Side::inside:
        return keeps_clear(true);
      case TileBody::Side::touching:
        return Verdict::touching;
      case TileBody::Side::outside:
        return Verdict::outside;
      default:
        return Verdict::undecided;
    }
  }

  void say_of_tile(std::size_t i) {
    const CoverTile& tile = tiles_[i];
    if (unsound_[i] != 0)
      findings_.push_back({fmt::format("{}: {} is no closed, oriented, embedded 2-manifold", tile.place, tile.uri)});
    std::array<std::uint64_t, kPlaces> at{};
    for (const std::size_t child : tile.children) ++at[place_in(i, child)];
    for (const std::size_t child : tile.children) {
      const std::size_t place = place_in(i, child);
      if (place == kNowhere || (place == kSame && tile.children.size() > 1))
        findings_.push_back(
            {fmt::format("{}: its cell is neither its parent's nor an octant of it", tiles_[child].place)});
      if (place != kNowhere && at[place] > 1)
        findings_.push_back({fmt::format("{}: another child of its parent has the same cell", tiles_[child].place)});
    }
  }

  /// Judges the errors of leaves, once all coordinates were read and their rounding is known. The file chose the errors
  /// of leaves and the cells, but only the scene tells what rounding is. Leaves with larger errors are refused, and
  /// compared with nothing.
  void judge_errors(TriangleSource& scene) {
    const auto is_leaf = [](const CoverTile& tile) { return tile.leaf_error.has_value(); };
    const Bounds3d bounds = bounds_of(scene);
    rounding_ = scene.counts().rounding;
    if (bounds.empty() || std::none_of(tiles_.begin(), tiles_.end(), is_leaf)) return;
    double farthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      scene_edge_ = std::max(scene_edge_, bounds.max[k] - bounds.min[k]);
      farthest = std::max({farthest, std::abs(bounds.min[k]), std::abs(bounds.max[k])});
    }
    const double most = kMostLeafError * scene_edge_ + 2 * kLeafRounding * 0x1p-50 * farthest;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (is_leaf(tiles_[i])) judge_error(i, {bounds.min, bounds.max, bounds.max}, most);
    }
  }

  void judge_error(std::size_t i, const TriangleD& farthest, double most) {
    const double error = leaf_error(*tiles_[i].cell, farthest, *tiles_[i].leaf_error);
    report_.leaf_error = std::max(report_.leaf_error, error + rounding_.most);
    refused_[i] = error > most;
    if (refused_[i] && mine_[i])
      findings_.push_back({fmt::format("{}: {} is compared to within {:.3g}; rounding of this scene is {:.3g} at most",
                                       tiles_[i].place, tiles_[i].uri, error, most)});
  }

  void say_of_scene(std::size_t i) {
    const CoverTile& tile = tiles_[i];
    const Counts& c = counts_[i];
    const auto add = [&](Verdict verdict, const char* what, Answer answer = Answer::refuted) {
      const std::uint64_t n = c.of(verdict);
      if (n == 0) return;
      findings_.push_back(
          {fmt::format("{}: {} {} {} of the scene", tile.place, tile.uri, what, counted(n, "triangle")), answer});
    };
    add(Verdict::missing, "does not show");
    if (c.strays > 0)
      findings_.push_back({fmt::format("{}: {} shows {} that the scene does not have", tile.place, tile.uri,
                                       counted(c.strays, "triangle"))});
    add(Verdict::touching, "is touched by");
    add(Verdict::outside, "leaves outside");
    add(Verdict::undecided, "cannot be decided for", Answer::undecided);
    add(Verdict::rounded, "is as near as coordinates may be off to", Answer::undecided);
    add(Verdict::bare, "draws nothing for");
    add(Verdict::uncovered, "has no child for");
  }

  const std::vector<CoverTile>& tiles_;
  const CoverContents& content_of_;
  const std::vector<bool> mine_;
  /// Per tile of this share: its content; null for a leaf, or without one.
  std::vector<std::unique_ptr<TileBody>> bodies_;
  std::vector<std::unique_ptr<LeafBody>> leaves_;
  std::vector<std::uint8_t> unsound_;
  std::vector<Counts> counts_;
  std::vector<Numbers> below_;    ///< per tile: its subtree, itself included
  std::vector<Octants> octants_;  ///< per tile: the octants of its cell
  const std::vector<bool> held_;
  std::size_t begin_ = 0, end_ = 0;  ///< range of tiles of this share
  std::atomic<std::uint64_t> astray_{0}, nearly_astray_{0};
  double scene_edge_ = 0;      ///< longest edge of the scene's box, if there are leaves
  Rounding rounding_;          ///< the scene's
  std::vector<bool> refused_;  ///< per tile: a leaf with too large an error
  CoverReport report_;
  std::vector<TileFinding>& findings_ = report_.findings;
};

}  // namespace

CoverReport check_cover(const std::vector<CoverTile>& tiles, const CoverContents& content_of, TriangleSource& scene,
                        std::uint64_t memory_bytes, TilePart part) {
  return CoverChecker(tiles, content_of, part).run(scene, memory_bytes);
}

}  // namespace bp
