#include "lib/check/tile_cover.h"

#include <fmt/format.h>

#include <atomic>
#include <memory>

#include "lib/check/detail/cover/cover_cells.h"
#include "lib/check/detail/cover/leaf_verdict.h"
#include "lib/check/detail/tile_body.h"
#include "lib/check/tile_drawn.h"
#include "lib/core/parallel.h"
#include "lib/exact/triangle_part.h"
#include "lib/tileset/tile_tree.h"

namespace bp {

namespace {

/// The content of a leaf, which must be the scene itself.
struct LeafBody {
  LeafBody(const IndexedMesh& content, const Bounds3d& cell, double flat)
      : mesh(weld(content, 1, report)), surface(mesh), proof(surface.bvh(), cell, flat) {}
  CheckReport report;
  WeldedMesh mesh;
  Surface surface;
  LeafProof proof;
};

/// A tile while its tileset is checked.
struct CheckedTile {
  bool held = false, unsound = false;
  TileSubtree below;  ///< itself included
  TileOctants octants{};
  /// Its content while its share is tested; both null without one.
  std::unique_ptr<TileBody> body;
  std::unique_ptr<LeafBody> leaf;
  CoverCounts counts;
};

/// A triangle of the scene, its box, and what its points may be off by.
struct Sought {
  const TriangleD& t;
  Bounds3d bounds;
  double off = 0;
};

/// Returns whether the root's cell holds t, and all that is within `off` of it.
bool lies_in_root(const std::optional<Bounds3d>& cell, const TriangleD& t, double off) {
  if (!cell) return true;
  for (const Vec3d& p : t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(p[i] - off >= cell->min[i] && p[i] + off <= cell->max[i])) return false;
    }
  }
  return true;
}

/// True unless t surely avoids all that is within `off` of the closed cell.
bool meets(const Sought& of, const Bounds3d& cell, double off) {
  if (lies_in(of.bounds, cell)) return true;
  const Bounds3d box = grown(cell, growth_for(cell, of.t) / 2 + off);
  return overlap(of.bounds, box) && !TrianglePart(of.t, box).empty();
}

/// Returns whether t meets the cell as read, and not only within what it may be off by.
bool meets_as_read(const std::optional<Bounds3d>& cell, const Sought& of) {
  return of.off == 0 || !cell || meets(of, *cell, 0);
}

/// Returns the end of the share of tiles that begins with `begin` and whose contents fit in memory_bytes.
std::size_t end_of_share(const std::vector<CoverTile>& tiles, const std::vector<bool>& mine, std::size_t begin,
                         std::uint64_t memory_bytes) {
  std::uint64_t bytes = 0;
  std::size_t end = begin;
  while (end < tiles.size()) {
    bytes += mine[end] ? tiles[end].triangles.value_or(0) * kCoverBytesPerTriangle : 0;
    if (bytes > memory_bytes && end > begin) break;
    ++end;
  }
  return end;
}

/// Reports triangles of the scene that leave the root's cell, or may.
void report_astray(const std::string& place, std::uint64_t astray, std::uint64_t nearly,
                   std::vector<TileFinding>& findings) {
  if (astray > 0) findings.push_back({fmt::format("{}: {} triangles of the scene leave its cell", place, astray)});
  if (nearly > 0)
    findings.push_back(
        {fmt::format("{}: {} triangles of the scene may leave its cell, as coordinates may be off", place, nearly),
         Answer::undecided});
}

class CoverChecker {
 public:
  CoverChecker(const std::vector<CoverTile>& tiles, const CoverContents& content_of, TilePart part,
               TriangleSource& scene)
      : tiles_(tiles),
        content_of_(content_of),
        mine_(tiles_of(part, tiles)),
        checked_(tiles.size()),
        errors_(judge_leaf_errors(tiles, mine_, scene, report_.findings)) {
    report_.leaf_error = errors_.largest;
    const std::vector<bool> held = tiles_held_above(tiles);
    const std::vector<TileSubtree> below = tile_subtrees(tiles, mine_);
    for (std::size_t i = 0; i < tiles.size(); ++i)
      checked_[i].held = held[i], checked_[i].below = below[i], checked_[i].octants = octants_of(tiles, i);
  }

  CoverReport run(TriangleSource& scene, std::uint64_t memory_bytes) {
    for (begin_ = 0; begin_ < tiles_.size(); begin_ = end_) {
      end_ = end_of_share(tiles_, mine_, begin_, memory_bytes);
      parallel_for(std::int64_t(end_ - begin_), [&](std::int64_t i) { load(begin_ + std::size_t(i)); });
      pass(scene);
      for (std::size_t i = begin_; i < end_; ++i) {
        if (checked_[i].leaf) checked_[i].counts.strays = checked_[i].leaf->proof.strays();
        checked_[i].leaf.reset();
        checked_[i].body.reset();
      }
    }
    return report();
  }

 private:
  void load(std::size_t i) {
    CheckedTile& tile = checked_[i];
    if (!mine_[i] || !tiles_[i].triangles || errors_.refused[i]) return;
    if (tiles_[i].leaf_error) {
      tile.leaf = std::make_unique<LeafBody>(content_of_(i), *tiles_[i].cell, errors_.flat);
    } else {
      tile.body = std::make_unique<TileBody>(content_of_(i), i);
      tile.unsound = !tile.body->sound();
    }
  }

  void pass(TriangleSource& scene) {
    scene.rewind();
    pipeline<std::vector<TriangleD>>(
        2 * thread_count(), [&](std::vector<TriangleD>& chunk) { return scene.read(chunk); },
        [&](std::vector<TriangleD>& chunk) {
          KnownInside known;
          for (const TriangleD& t : chunk) {
            const double off = errors_.rounding.of(t);
            if (lies_in_root(tiles_[0].cell, t, 0)) {
              if (begin_ == 0 && !lies_in_root(tiles_[0].cell, t, off)) ++nearly_astray_;
              visit(0, {t, bounds_of(t), off}, known);
            } else if (begin_ == 0) {
              ++astray_;
            }
          }
        },
        [](std::vector<TriangleD>&) {});
  }

  /// Tests t, which may meet the cell of tile i, in the subtree. Only tiles of this share count.
  void visit(std::size_t i, const Sought& of, KnownInside& known) {
    CheckedTile& here = checked_[i];
    if (here.below.first >= end_ || here.below.last < begin_) return;
    const CoverTile& tile = tiles_[i];
    const bool mine = mine_[i] && i >= begin_ && i < end_;
    if (mine && !here.held && !tile.triangles && tile.children.empty()) here.counts.add(shown_by_nothing(i, of));
    if (mine && tile.triangles && !errors_.refused[i]) here.counts.add(compare_with_content(i, of, known));
    if (tile.children.empty()) return;
    if (tile.children.size() == 1 && tiles_[tile.children[0]].cell == tile.cell)
      return visit(tile.children[0], of, known);
    if (!tile.cell) return;
    const Bounds3d near = grown(of.bounds, growth_for(*tile.cell, of.t) + of.off);
    const bool stays = here.held || (tile.adds && tile.triangles && !tile.leaf_error);
    for (int k = 0; k < 8; ++k) {
      const Bounds3d octant = octant_of(*tile.cell, k);
      if (!overlap(near, octant) || !meets(of, octant, of.off)) continue;
      if (const std::size_t child = here.octants[std::size_t(k)]; child != 0) {
        visit(child, of, known);
      } else if (mine && !stays) {
        const CoverVerdict verdict = without_child(i, octant, of);
        here.counts.add(verdict == CoverVerdict::missing ? CoverVerdict::uncovered : verdict);
      }
    }
  }

  /// Returns the verdict for an octant without a child. No leaf is made for parts of a neighbour's triangle just beyond
  /// a face.
  [[nodiscard]] CoverVerdict without_child(std::size_t i, const Bounds3d& octant, const Sought& of) const {
    if (const auto& error = checked_[i].below.leaf_error)
      return compare_with_nothing(octant, of.t, *error, errors_.flat);
    return of.off == 0 || meets(of, octant, 0) ? CoverVerdict::missing : CoverVerdict::rounded;
  }
  /// Returns the verdict for a tile without content and children: a leaf, or none.
  [[nodiscard]] CoverVerdict shown_by_nothing(std::size_t i, const Sought& of) const {
    const CoverTile& tile = tiles_[i];
    if (!tile.leaf_error || errors_.refused[i])
      return meets_as_read(tile.cell, of) ? CoverVerdict::bare : CoverVerdict::rounded;
    const CoverVerdict verdict = compare_with_nothing(*tile.cell, of.t, *tile.leaf_error, errors_.flat);
    return verdict == CoverVerdict::missing ? CoverVerdict::bare : verdict;
  }

  [[nodiscard]] CoverVerdict compare_with_content(std::size_t i, const Sought& of, KnownInside& known) const {
    const std::optional<Bounds3d>& cell = tiles_[i].cell;
    if (checked_[i].leaf) return compare_with_leaf(checked_[i].leaf->proof, *cell, of.t, *tiles_[i].leaf_error);
    const TileBody& body = *checked_[i].body;
    const auto keeps_clear = [&](bool is_inside) {
      return body.keeps_clear(of.t, cell, of.off, is_inside, known) ? CoverVerdict::fine : CoverVerdict::rounded;
    };
    if (!meets_as_read(cell, of)) return keeps_clear(false);
    switch (body.side_of(of.t, of.bounds, cell, known)) {
      case TileBody::Side::inside:
        return keeps_clear(true);
      case TileBody::Side::touching:
        return CoverVerdict::touching;
      case TileBody::Side::outside:
        return CoverVerdict::outside;
      default:
        return CoverVerdict::undecided;
    }
  }

  CoverReport report() {
    std::vector<TileFinding>& findings = report_.findings;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (!mine_[i]) continue;
      if (checked_[i].unsound)
        findings.push_back(
            {fmt::format("{}: {} is no closed, oriented, embedded 2-manifold", tiles_[i].place, tiles_[i].uri)});
      check_cells(tiles_, i, findings);
      report_.thin += checked_[i].counts.of(CoverVerdict::thin);
      report_.flat += checked_[i].counts.of(CoverVerdict::flat);
    }
    if (mine_[0]) report_astray(tiles_[0].place, astray_, nearly_astray_, findings);
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (mine_[i]) report_verdicts(tiles_[i], checked_[i].counts, findings);
    }
    return std::move(report_);
  }

  const std::vector<CoverTile>& tiles_;
  const CoverContents& content_of_;
  const std::vector<bool> mine_;
  CoverReport report_;
  std::vector<CheckedTile> checked_;  ///< by tile
  const LeafErrors errors_;
  std::size_t begin_ = 0, end_ = 0;  ///< range of tiles of this share
  std::atomic<std::uint64_t> astray_{0}, nearly_astray_{0};
};

}  // namespace

CoverReport check_cover(const std::vector<CoverTile>& tiles, const CoverContents& content_of, TriangleSource& scene,
                        std::uint64_t memory_bytes, TilePart part) {
  return CoverChecker(tiles, content_of, part, scene).run(scene, memory_bytes);
}

}  // namespace bp
