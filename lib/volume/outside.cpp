#include "lib/volume/outside.h"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>

#include "lib/core/error.h"

// Connected components by runs: the empty voxels of a row come as runs (begin, end) from the packed words, each run is
// united with those that overlap it in the row before and in the slice before. Only two slices of runs are alive; a
// second scan repeats the same provisional labels instead of storing them.

namespace bp {

namespace {

/// Union-find over small integers; the root of a set is its smallest member, so numbering follows the scan.
class Forest {
 public:
  std::uint32_t add() {
    parent_.push_back(std::uint32_t(parent_.size()));
    return parent_.back();
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// Afterwards parent(i) is the root of i.
  void flatten() {
    for (std::uint32_t& p : parent_) p = parent_[p];  // parents come first
  }
  [[nodiscard]] std::uint32_t parent(std::uint32_t i) const { return parent_[i]; }
  [[nodiscard]] std::uint32_t size() const { return std::uint32_t(parent_.size()); }

 private:
  std::vector<std::uint32_t> parent_;
};

struct Run {
  std::int32_t begin, end;  ///< voxels from the tile's min.x
  std::uint32_t label;
};

/// Run of positions u + v * width of a face, all of one component. Gaps are occupied voxels.
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

/// Bits [begin, end) of a word.
std::uint64_t bit_range(std::int32_t begin, std::int32_t end) {
  return (~std::uint64_t(0) << begin) & (~std::uint64_t(0) >> (64 - end));
}

/// emit(begin, end) for each run of zero bits in bits [first, last) of `row`; positions count from `first`.
template <class Emit>
void for_empty_runs(const std::uint64_t* row, std::int32_t first, std::int32_t last, const Emit& emit) {
  std::int32_t open = -1;  // begin of the run that reaches the current word, in bits of the row
  for (std::int32_t base = first & ~63; base < last; base += 64) {
    std::uint64_t empty = ~row[base / 64] & bit_range(std::max(first - base, 0), std::min(last - base, 64));
    if (empty == ~std::uint64_t(0)) {
      if (open < 0) open = base;
      continue;
    }
    if (open >= 0) {
      const int ones = std::countr_one(empty);
      emit(open - first, base + ones - first);
      open = -1;
      empty &= empty + 1;  // clears the trailing ones
    }
    while (empty != 0) {
      const int begin = std::countr_zero(empty), length = std::countr_one(empty >> begin);
      if (begin + length == 64) {
        open = base + begin;
        break;
      }
      emit(base + begin - first, base + begin + length - first);
      empty &= empty + (std::uint64_t(1) << begin);  // clears the lowest run of ones
    }
  }
  if (open >= 0) emit(open - first, last - first);
}

/// The runs of one slice, row by row.
struct Slice {
  std::vector<Run> runs;
  std::vector<std::uint32_t> rows;  ///< rows[y] .. rows[y + 1] are the runs of row y

  void clear() {
    runs.clear();
    rows.assign(1, 0);
  }
  void reserve_row(std::int32_t voxels) {
    const std::size_t need = runs.size() + std::size_t(voxels) / 2 + 1;
    if (runs.capacity() < need) runs.reserve(2 * need);
  }
  [[nodiscard]] const Run* begin(std::int32_t y) const { return runs.data() + rows[std::size_t(y)]; }
  [[nodiscard]] const Run* end(std::int32_t y) const { return runs.data() + rows[std::size_t(y) + 1]; }
};

constexpr std::uint32_t kNoLabel = ~std::uint32_t(0);

/// A cursor over the runs of a neighbouring row; calls get ascending runs.
class Neighbours {
 public:
  Neighbours(const Run* begin, const Run* end) : at_(begin), end_(end) {}
  /// touch(label) for each run that overlaps [begin, end).
  template <class Touch>
  void overlaps(std::int32_t begin, std::int32_t end, const Touch& touch) {
    while (at_ != end_ && at_->end <= begin) ++at_;
    for (const Run* r = at_; r != end_ && r->begin < end; ++r) touch(r->label);
  }

 private:
  const Run *at_, *end_;
};

/// True if bits [first, last) of `row` are zero, both multiples of 64.
bool empty_words(const std::uint64_t* row, std::int32_t first, std::int32_t last) {
  std::uint64_t any = 0;
  for (std::int32_t word = first / 64; word < last / 64; ++word) any |= row[word];
  return any == 0;
}

/// Scans the empty runs of `tile` in a fixed order. Each gets the provisional label of the first run that overlaps it
/// in the row before, else in the slice before, else fresh(); unite(a, b) reports every other overlap. Then
/// visit(run, y, z), y and z from the tile's corner. Two scans of the same bits give the same labels.
template <class Fresh, class Unite, class Visit>
void scan(const BitBox& solid, const VoxelBox& tile, const Fresh& fresh, const Unite& unite, const Visit& visit) {
  const VoxelCoord size = tile.size();
  const std::int32_t first = tile.min.x - solid.box().min.x;
  const bool aligned = first % 64 == 0 && size.x % 64 == 0;
  Slice before, now;
  for (std::int32_t z = 0; z < size.z; ++z) {
    now.clear();
    for (std::int32_t y = 0; y < size.y; ++y) {
      now.reserve_row(size.x);  // the pointers below stay valid
      // Most rows are empty beside empty ones: the run beside takes them in, whatever lies below.
      const Run* last = now.runs.empty() ? nullptr : &now.runs.back();
      if (aligned && y > 0 && now.end(y - 1) - now.begin(y - 1) == 1 && last->begin == 0 && last->end == size.x &&
          empty_words(solid.row(tile.min.y + y, tile.min.z + z), first, first + size.x)) {
        const std::uint32_t label = last->label;
        if (z > 0) {
          for (const Run* r = before.begin(y); r != before.end(y); ++r) {
            if (r->label != label) unite(label, r->label);
          }
        }
        now.runs.push_back({0, size.x, label});
        visit(now.runs.back(), y, z);
        now.rows.push_back(std::uint32_t(now.runs.size()));
        continue;
      }
      Neighbours beside = y > 0 ? Neighbours(now.begin(y - 1), now.end(y - 1)) : Neighbours(nullptr, nullptr);
      Neighbours below = z > 0 ? Neighbours(before.begin(y), before.end(y)) : Neighbours(nullptr, nullptr);
      for_empty_runs(solid.row(tile.min.y + y, tile.min.z + z), first, first + size.x,
                     [&](std::int32_t begin, std::int32_t end) {
                       std::uint32_t label = kNoLabel;
                       const auto touch = [&](std::uint32_t other) {
                         if (label == kNoLabel) {
                           label = other;
                         } else if (label != other) {
                           unite(label, other);
                         }
                       };
                       beside.overlaps(begin, end, touch);
                       below.overlaps(begin, end, touch);
                       if (label == kNoLabel) label = fresh();
                       now.runs.push_back({begin, end, label});
                       visit(now.runs.back(), y, z);
                     });
      now.rows.push_back(std::uint32_t(now.runs.size()));
    }
    std::swap(before, now);
  }
}

/// Components of one tile. Those that touch a face are numbered 0, 1, ... by first appearance in the scan; the others
/// are enclosed already.
struct Components {
  Forest forest;
  std::vector<std::uint8_t> at_face;   ///< per provisional label
  std::vector<std::uint32_t> face_id;  ///< per provisional label; kNoLabel inside
  std::uint32_t face_count = 0;
  bool any_inside = false;

  /// After the scan: numbers the components.
  void number() {
    forest.flatten();
    for (std::uint32_t i = 0; i < forest.size(); ++i) at_face[forest.parent(i)] |= at_face[i];
    face_id.assign(forest.size(), kNoLabel);
    for (std::uint32_t i = 0; i < forest.size(); ++i) {
      const std::uint32_t root = forest.parent(i);
      if (root == i && at_face[i] != 0) face_id[i] = face_count++;
      if (root == i && at_face[i] == 0) any_inside = true;
      face_id[i] = face_id[root];
    }
  }
};

/// First scan; visit as in scan().
template <class Visit>
void find_components(const BitBox& solid, const VoxelBox& tile, Components& c, const Visit& visit) {
  const VoxelCoord size = tile.size();
  scan(
      solid, tile,
      [&] {
        c.at_face.push_back(0);
        return c.forest.add();
      },
      [&](std::uint32_t a, std::uint32_t b) { c.forest.unite(a, b); },
      [&](const Run& run, std::int32_t y, std::int32_t z) {
        const bool face = run.begin == 0 || run.end == size.x || y == 0 || y == size.y - 1 || z == 0 || z == size.z - 1;
        if (face) {
          c.at_face[run.label] = 1;
          visit(run, y, z);
        }
      });
  c.number();
}

void check_face_area(const VoxelBox& tile) {
  const VoxelCoord s = tile.size();
  const std::int64_t limit = std::int64_t(1) << 32;
  if (std::int64_t(s.x) * s.y >= limit || std::int64_t(s.x) * s.z >= limit || std::int64_t(s.y) * s.z >= limit)
    fail(ErrorCode::bad_argument, "a tile of {} x {} x {} voxels is too large; use smaller tiles", s.x, s.y, s.z);
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
  /// A maximal run of tiles along x that were never joined: all empty, hence one node.
  struct EmptyRun {
    std::int32_t begin, end;
    std::uint32_t node;
  };

  VoxelBox grid;
  VoxelCoord tile_vox, tiles;
  Forest nodes;                                            ///< node 0 is the outside
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
  /// The tile that `tile` is, in tiles from the grid's corner.
  [[nodiscard]] VoxelCoord coord(const VoxelBox& tile) const {
    const VoxelCoord d = tile.min - grid.min;
    return {d.x / tile_vox.x, d.y / tile_vox.y, d.z / tile_vox.z};
  }
  /// Node of an empty tile that was never joined; after resolve().
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
void join_runs(Forest& nodes, const FaceRuns& a, const FaceRuns& b) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].begin < b[j].end && b[j].begin < a[i].end) nodes.unite(a[i].label, b[j].label);
    if (a[i].end < b[j].end) {
      ++i;
    } else {
      ++j;
    }
  }
}

void join_all(Forest& nodes, const FaceRuns& runs, std::uint32_t node) {
  for (const FaceRun& r : runs) nodes.unite(r.label, node);
}

}  // namespace

OutsideFlood::OutsideFlood(const VoxelBox& grid, VoxelCoord tile_vox) : state_(new State) {
  state_->grid = grid;
  state_->tile_vox = tile_vox;
  double total = 1;
  for (int i = 0; i < 3; ++i) {
    if (tile_vox[i] <= 0)
      fail(ErrorCode::bad_argument, "a tile of {} voxels a side cannot be; use 64 or more", tile_vox[i]);
    const std::int64_t side = std::int64_t(grid.max[i]) - grid.min[i];
    state_->tiles[i] = std::int32_t(std::max<std::int64_t>(0, (side + tile_vox[i] - 1) / tile_vox[i]));
    total *= state_->tiles[i];
  }
  if (total >= double(std::int64_t(1) << 62))
    fail(ErrorCode::bad_argument, "the grid has too many tiles; use larger tiles or larger voxels");
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

/// The tiles that were never joined, as runs along x, one node each.
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
    for (const auto& [key, runs] : s.waiting[axis]) {  // any order: sets do not depend on it
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
