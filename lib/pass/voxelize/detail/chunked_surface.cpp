#include "lib/pass/voxelize/detail/chunked_surface.h"

#include <algorithm>
#include <utility>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/turn.h"

namespace bp {

namespace {

constexpr const char* kMetJob = "a chunk was voxelized";

/// Returns the key of the mark that a chunk was voxelized. It lies beside the chunk's voxels and does not depend on the
/// frame.
ResultKey met_key(const ChunkCutter::Chunk& chunk) {
  return KeyHash(kMetJob).add(chunk.content).key();
}

[[noreturn]] void fail_changed() {
  fail(ErrorCode::bad_input, "the scene changed between the first and the second reading");
}

}  // namespace

/// A chunk to be voxelized.
struct ChunkedSurface::Item {
  std::size_t chunk = 0;
  std::uint64_t count = 0;  // triangles of the item and of the known chunks before it
  std::vector<TriangleD> triangles;
};

/// Reads triangles in order, one batch at a time.
class ChunkedSurface::Reader {
 public:
  explicit Reader(const NextPortion& next) : next_(next) {}
  /// Appends the next n triangles to `out` (null: skips them); returns false if there are fewer.
  bool take(std::uint64_t n, std::vector<TriangleD>* out) {
    while (n > 0) {
      if (at_ == portion_.count) {
        at_ = 0;
        if (!next_(portion_)) return false;
      }
      const std::uint64_t here = std::min(n, portion_.count - at_);
      if (out != nullptr) {
        if (portion_.triangles.empty()) return false;
        const auto first = portion_.triangles.begin() + std::ptrdiff_t(at_);
        out->insert(out->end(), first, first + std::ptrdiff_t(here));
      }
      at_ += here;
      n -= here;
    }
    return true;
  }

 private:
  const NextPortion& next_;
  Portion portion_;
  std::uint64_t at_ = 0;
};

void ChunkedSurface::measure(std::span<const TriangleD> triangles, std::span<const std::uint32_t> places) {
  cutter_.add(triangles, places);
  for (std::size_t i = met_.size(); i < cutter_.chunks().size(); ++i) {
    const ChunkCutter::Chunk& chunk = cutter_.chunks()[i];
    std::string none;
    met_.push_back(results_.get(met_key(chunk), none));
    if (met_.back() == 0) unmet_.emplace_back(ended_, ended_ + chunk.triangles);
    ended_ += chunk.triangles;
  }
}

bool ChunkedSurface::met(std::uint64_t begin, std::uint64_t end) const {
  const auto next =
      std::partition_point(unmet_.begin(), unmet_.end(), [&](const auto& u) { return u.second <= begin; });
  return end <= ended_ && (next == unmet_.end() || next->first >= end);
}

bool ChunkedSurface::needs_met() const {
  for (std::size_t i = 0; i < met_.size(); ++i) {
    if (met_[i] != 0 && found_[i] == 0) return true;
  }
  return false;
}

void ChunkedSurface::look_up(const GridFrame& frame, std::int64_t slack, const BrickBox& grid,
                             std::uint64_t memory_bytes, BrickShelf& shelf) {
  frame_ = frame;
  slack_ = slack;
  grid_ = grid;
  chunks_ = cutter_.finish();
  found_.assign(chunks_.size(), 0);
  bricks_ = std::make_unique<BrickSum>(grid, memory_bytes, shelf);
  met_.resize(chunks_.size());  // the last one ends here
  parallel_for(std::int64_t(chunks_.size()), [&](std::int64_t n) {
    const auto i = std::size_t(n);
    found_[i] = take_kept(i);
    if (found_[i] != 0 && met_[i] == 0) results_.put(met_key(chunks_[i]), "");
  });
  kept_ = std::uint64_t(std::count(found_.begin(), found_.end(), 1));
}

/// Adds the chunk's voxels if they are among the results; returns whether they are.
bool ChunkedSurface::take_kept(std::size_t chunk) {
  std::string bytes;
  return results_.get(chunk_key(chunks_[chunk], frame_, slack_), bytes) && bricks_->add(bytes);
}

/// Reads the next missing chunks into `window`, in reverse order: one, or in a turn as many as there is room for.
/// Returns false if there are no more.
bool ChunkedSurface::read_window(Reader& reader, std::uint64_t bytes, std::vector<Item>& window) {
  Item item;
  for (std::uint64_t held = 0; read_ < chunks_.size() && (window.empty() || (turn_ != 0 && held < bytes)); ++read_) {
    const std::uint64_t n = chunks_[read_].triangles;
    const bool missing = found_[read_] == 0;
    if (missing) item.triangles.reserve(n);
    if (!reader.take(n, missing ? &item.triangles : nullptr)) fail_changed();
    item.count += n;
    if (!missing) continue;
    held += n * sizeof(TriangleD);
    item.chunk = read_;
    window.push_back(std::exchange(item, {}));
  }
  put_in_turn(window, turn_);
  return !window.empty();
}

void ChunkedSurface::add_missing(const NextPortion& next, std::uint64_t work_bytes, std::uint64_t window_bytes,
                                 const std::function<void(std::uint64_t, std::vector<TriangleD>&&)>& done) {
  Reader reader(next);
  std::vector<Item> window;
  pipeline<Item>(
      int(std::clamp<std::uint64_t>(work_bytes / kChunkWorkBytes, 1, std::uint64_t(thread_count()) + 1)),
      [&](Item& item) {
        if (window.empty() && !read_window(reader, window_bytes, window)) return false;
        item = std::move(window.back());
        window.pop_back();
        return true;
      },
      [&](Item& item) {
        if (ChunkCutter::content_of(item.triangles) != chunks_[item.chunk].content) fail_changed();
        make(item);
      },
      [&](Item& item) { done(item.count, std::move(item.triangles)); });
}

/// Voxelizes a chunk and keeps it. The triangles of a chunk that cannot be kept stay in the item.
void ChunkedSurface::make(Item& item) {
  if (turn_ != 0 && take_kept(item.chunk)) {
    ++kept_;
    return std::vector<TriangleD>().swap(item.triangles);
  }
  const std::optional<std::string> bytes = chunk_voxels(item.triangles, frame_, grid_, slack_);
  if (!bytes) return;
  std::vector<TriangleD>().swap(item.triangles);
  results_.put(chunk_key(chunks_[item.chunk], frame_, slack_), *bytes);
  results_.put(met_key(chunks_[item.chunk]), "");
  if (!bricks_->add(*bytes)) fail(ErrorCode::failed, "a chunk of triangles has voxels outside the grid of its scene");
}

}  // namespace bp
