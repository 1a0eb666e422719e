#include "lib/volume/outside.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "lib/core/error.h"
#include "lib/volume/detail/tile_components.h"

// Connected components by runs (detail/empty_runs.h), tile by tile (detail/tile_components.h). This file joins tiles,
// by runs along the faces that they share.

namespace bp {

using namespace detail;

namespace {

/// A run of positions u + v * width of a face, all of one component. Gaps are occupied voxels.
struct FaceRun {
  std::uint32_t begin, end;
  std::uint32_t label;
};
using FaceRuns = std::vector<FaceRun>;

void append(FaceRuns& runs, std::uint32_t begin, std::uint32_t end, std::uint32_t label) {
  if (!runs.empty() && runs.back().end == begin && runs.back().label == label) {
    runs.back().end = end;
  } else {
    runs.push_back({begin, end, label});
  }
}

void check_face_area(const VoxelBox& tile) {
  const VoxelCoord s = tile.size();
  const std::int64_t limit = std::int64_t(1) << 32;
  if (std::int64_t(s.x) * s.y >= limit || std::int64_t(s.x) * s.z >= limit || std::int64_t(s.y) * s.z >= limit)
    fail(ErrorCode::bad_argument, {Remedy::smaller_tiles}, "a tile of {} x {} x {} voxels is too large", s.x, s.y, s.z);
}

}  // namespace

/// Faces in the order -x +x -y +y -z +z; positions are y + z * size.y, x + z * size.x, x + y * size.x.
struct OutsideFlood::TileLabels {
  VoxelBox tile;
  std::uint32_t count = 0;  ///< components that touch a face
  bool any_inside = false;  ///< a component touches none
  FaceRuns faces[6];
};

void OutsideFlood::ReleaseLabels::operator()(TileLabels* labels) const {
  delete labels;
}

OutsideFlood::Labels OutsideFlood::label(const BitBox& solid, const VoxelBox& tile) {
  check_face_area(tile);
  Labels out(new TileLabels{tile, 0, false, {}});
  const VoxelCoord size = tile.size();
  Components c;
  find_components(solid, tile, c, [&](const Run& run, std::int32_t y, std::int32_t z) {
    const std::uint32_t along_x = std::uint32_t(y) + std::uint32_t(z) * std::uint32_t(size.y);
    const std::uint32_t along_y = std::uint32_t(z) * std::uint32_t(size.x);
    const std::uint32_t along_z = std::uint32_t(y) * std::uint32_t(size.x);
    const std::uint32_t begin = std::uint32_t(run.begin), end = std::uint32_t(run.end);
    if (run.begin == 0) append(out->faces[0], along_x, along_x + 1, run.label);
    if (run.end == size.x) append(out->faces[1], along_x, along_x + 1, run.label);
    if (y == 0) append(out->faces[2], along_y + begin, along_y + end, run.label);
    if (y == size.y - 1) append(out->faces[3], along_y + begin, along_y + end, run.label);
    if (z == 0) append(out->faces[4], along_z + begin, along_z + end, run.label);
    if (z == size.z - 1) append(out->faces[5], along_z + begin, along_z + end, run.label);
  });
  for (FaceRuns& face : out->faces) {
    FaceRuns numbered;
    for (const FaceRun& r : face) append(numbered, r.begin, r.end, c.face_id[r.label]);
    numbered.shrink_to_fit();
    face = std::move(numbered);
  }
  out->count = c.face_count;
  out->any_inside = c.any_inside;
  return out;
}

OutsideFlood::Labels OutsideFlood::label_empty(const VoxelBox& tile) {
  check_face_area(tile);
  const VoxelCoord s = tile.size();
  Labels out(new TileLabels{tile, 1, false, {}});
  const std::uint32_t area[3] = {std::uint32_t(s.y) * std::uint32_t(s.z), std::uint32_t(s.x) * std::uint32_t(s.z),
                                 std::uint32_t(s.x) * std::uint32_t(s.y)};
  for (int face = 0; face < 6; ++face) out->faces[face].push_back({0, area[face / 2], 0});
  return out;
}

struct OutsideFlood::State {
  struct Joined {
    std::uint32_t first = 0, count = 0;  ///< nodes of the components that touch a face
    bool enclosed = false;               ///< some component is enclosed (before resolve(): touches no face)
  };
  /// A maximal run of tiles along x that were never joined. All are empty, so the run is one node.
  struct EmptyRun {
    std::int32_t begin, end;
    std::uint32_t node;
  };

  VoxelBox grid;
  VoxelCoord tile_vox, tiles;
  DisjointSets nodes;                                      ///< node 0 is the outside
  std::unordered_map<std::uint64_t, Joined> joined;        ///< by tile index
  std::unordered_map<std::uint64_t, FaceRuns> waiting[3];  ///< by axis and index of the tile above the face
  std::vector<std::vector<EmptyRun>> empty_rows;           ///< after resolve(), by ty + tz * tiles.y
  bool resolved = false;

  [[nodiscard]] std::uint64_t index(VoxelCoord t) const {
    return std::uint64_t(t.x) +
           std::uint64_t(tiles.x) * (std::uint64_t(t.y) + std::uint64_t(tiles.y) * std::uint64_t(t.z));
  }
  [[nodiscard]] VoxelCoord coord(std::uint64_t i) const {
    const std::uint64_t nx = std::uint64_t(tiles.x), ny = std::uint64_t(tiles.y);
    return {std::int32_t(i % nx), std::int32_t(i / nx % ny), std::int32_t(i / nx / ny)};
  }
  /// Returns the place of `tile`, in tiles from the grid's corner.
  [[nodiscard]] VoxelCoord coord(const VoxelBox& tile) const {
    const VoxelCoord d = tile.min - grid.min;
    return {d.x / tile_vox.x, d.y / tile_vox.y, d.z / tile_vox.z};
  }
  /// Returns the node of an empty tile that was never joined. Valid after resolve().
  [[nodiscard]] std::uint32_t empty_node(VoxelCoord t) const {
    const auto& row = empty_rows[std::size_t(t.y) + std::size_t(t.z) * std::size_t(tiles.y)];
    const auto after = std::upper_bound(row.begin(), row.end(), t.x,
                                        [](std::int32_t x, const EmptyRun& run) { return x < run.begin; });
    return std::prev(after)->node;
  }

  void join_face(int axis, bool upper, VoxelCoord tile, FaceRuns&& runs);
  void find_empty_runs();
  void join_empty_runs();
};

namespace {

/// Unites the components of both sides wherever both are empty.
void join_runs(DisjointSets& nodes, const FaceRuns& a, const FaceRuns& b) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].begin < b[j].end && b[j].begin < a[i].end) nodes.unite(a[i].label, b[j].label);
    if (a[i].end < b[j].end) {
      ++i;
    } else {
      ++j;
    }
  }
}

void join_all(DisjointSets& nodes, const FaceRuns& runs, std::uint32_t node) {
  for (const FaceRun& r : runs) nodes.unite(r.label, node);
}

}  // namespace

OutsideFlood::OutsideFlood(const VoxelBox& grid, VoxelCoord tile_vox) : state_(new State) {
  state_->grid = grid;
  state_->tile_vox = tile_vox;
  double total = 1;
  for (int i = 0; i < 3; ++i) {
    if (tile_vox[i] <= 0) fail(ErrorCode::bad_argument, "a tile of {} voxels a side cannot be", tile_vox[i]);
    const std::int64_t side = std::int64_t(grid.max[i]) - grid.min[i];
    state_->tiles[i] = std::int32_t(std::max<std::int64_t>(0, (side + tile_vox[i] - 1) / tile_vox[i]));
    total *= state_->tiles[i];
  }
  if (total >= double(std::int64_t(1) << 62))
    fail(ErrorCode::bad_argument, {Remedy::larger_tiles, Remedy::larger_voxels}, "the grid has too many tiles");
  state_->nodes.add();
}

OutsideFlood::~OutsideFlood() = default;

void OutsideFlood::State::join_face(int axis, bool upper, VoxelCoord tile, FaceRuns&& runs) {
  if (upper ? tile[axis] == tiles[axis] - 1 : tile[axis] == 0) return join_all(nodes, runs, 0);
  if (upper) ++tile[axis];
  const std::uint64_t key = index(tile);
  const auto other = waiting[axis].find(key);
  if (other == waiting[axis].end()) {
    waiting[axis].emplace(key, std::move(runs));
  } else {
    join_runs(nodes, other->second, runs);
    waiting[axis].erase(other);
  }
}

void OutsideFlood::join(Labels labels) {
  State& s = *state_;
  const VoxelCoord tile = s.coord(labels->tile);
  const std::uint32_t first = s.nodes.size();
  for (std::uint32_t i = 0; i < labels->count; ++i) s.nodes.add();
  s.joined.emplace(s.index(tile), State::Joined{first, labels->count, labels->any_inside});
  for (int face = 0; face < 6; ++face) {
    for (FaceRun& r : labels->faces[face]) r.label += first;
    s.join_face(face / 2, face % 2 == 1, tile, std::move(labels->faces[face]));
  }
}

/// Finds the tiles that were never joined, as runs along x, one node each.
void OutsideFlood::State::find_empty_runs() {
  std::vector<std::uint64_t> occupied;
  occupied.reserve(joined.size());
  for (const auto& [key, value] : joined) occupied.push_back(key);
  std::sort(occupied.begin(), occupied.end());
  empty_rows.resize(std::size_t(tiles.y) * std::size_t(tiles.z));
  std::size_t next = 0;
  for (std::size_t row = 0; row < empty_rows.size(); ++row) {
    const std::uint64_t base = std::uint64_t(row) * std::uint64_t(tiles.x);
    std::int32_t begin = 0;
    const auto close = [&](std::int32_t end) {
      if (begin < end) empty_rows[row].push_back({begin, end, nodes.add()});
    };
    for (; next < occupied.size() && occupied[next] < base + std::uint64_t(tiles.x); ++next) {
      const std::int32_t x = std::int32_t(occupied[next] - base);
      close(x);
      begin = x + 1;
    }
    close(tiles.x);
  }
}

/// Unites the runs of empty tiles with each other and with the outside.
void OutsideFlood::State::join_empty_runs() {
  const auto overlap = [&](const std::vector<EmptyRun>& a, const std::vector<EmptyRun>& b) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      if (a[i].begin < b[j].end && b[j].begin < a[i].end) nodes.unite(a[i].node, b[j].node);
      if (a[i].end < b[j].end) {
        ++i;
      } else {
        ++j;
      }
    }
  };
  for (std::int32_t z = 0; z < tiles.z; ++z) {
    for (std::int32_t y = 0; y < tiles.y; ++y) {
      const std::size_t row = std::size_t(y) + std::size_t(z) * std::size_t(tiles.y);
      const bool border = y == 0 || z == 0 || y == tiles.y - 1 || z == tiles.z - 1;
      for (const EmptyRun& run : empty_rows[row]) {
        if (border || run.begin == 0 || run.end == tiles.x) nodes.unite(run.node, 0);
      }
      if (y > 0) overlap(empty_rows[row - 1], empty_rows[row]);
      if (z > 0) overlap(empty_rows[row - std::size_t(tiles.y)], empty_rows[row]);
    }
  }
}

void OutsideFlood::resolve() {
  State& s = *state_;
  s.find_empty_runs();
  s.join_empty_runs();
  for (int axis = 0; axis < 3; ++axis) {
    for (const auto& [key, runs] : s.waiting[axis]) {  // in any order: the sets do not depend on it
      VoxelCoord empty = s.coord(key);
      if (s.joined.contains(key)) --empty[axis];  // the tile above the face was joined, so the one below was not
      join_all(s.nodes, runs, s.empty_node(empty));
    }
    s.waiting[axis].clear();
  }
  s.nodes.flatten();
  for (auto& [key, tile] : s.joined) {
    for (std::uint32_t i = 0; i < tile.count; ++i) tile.enclosed |= s.nodes.parent(tile.first + i) != 0;
  }
  s.resolved = true;
}

bool OutsideFlood::has_enclosed(const VoxelBox& tile) const {
  const VoxelCoord t = state_->coord(tile);
  const auto joined = state_->joined.find(state_->index(t));
  if (joined != state_->joined.end()) return joined->second.enclosed;
  return state_->nodes.parent(state_->empty_node(t)) != 0;
}

namespace {

/// Sets bits [begin, end) of a row.
void set_bits(std::uint64_t* row, std::int32_t begin, std::int32_t end) {
  for (std::int32_t word = begin / 64; word * 64 < end; ++word) {
    row[word] |= bit_range(std::max(begin - word * 64, 0), std::min(end - word * 64, 64));
  }
}

}  // namespace

std::uint64_t OutsideFlood::fill_enclosed(const VoxelBox& tile, BitBox& solid) const {
  if (!has_enclosed(tile)) return 0;
  const State& s = *state_;
  const auto joined = s.joined.find(s.index(s.coord(tile)));
  const std::uint32_t first = joined == s.joined.end() ? s.empty_node(s.coord(tile)) : joined->second.first;
  Components c;
  find_components(solid, tile, c, [](const Run&, std::int32_t, std::int32_t) {});
  std::vector<std::uint8_t> enclosed(c.face_id.size());
  for (std::size_t i = 0; i < enclosed.size(); ++i) {
    enclosed[i] = c.face_id[i] == kNoLabel || s.nodes.parent(first + c.face_id[i]) != 0;
  }
  std::uint64_t filled = 0;
  std::uint32_t next = 0;
  const std::int32_t offset = tile.min.x - solid.box().min.x;
  scan(
      solid, tile, [&] { return next++; }, [](std::uint32_t, std::uint32_t) {},
      [&](const Run& run, std::int32_t y, std::int32_t z) {
        if (enclosed[run.label] == 0) return;
        set_bits(solid.row(tile.min.y + y, tile.min.z + z), offset + run.begin, offset + run.end);
        filled += std::uint64_t(run.end - run.begin);
      });
  return filled;
}

}  // namespace bp
