#include "lib/stage/scene_passes.h"

#include <mutex>
#include <utility>

#include "lib/core/error.h"
#include "lib/core/hex.h"
#include "lib/core/parallel.h"

namespace bp {

struct ScenePasses::Item {
  std::unique_ptr<FetchedTriangles> fetched;
  std::vector<TriangleD> triangles;
  ChunkCutter::Digest digest;
  Bounds3d bounds;
};

/// Memory of triangles that did not stay, for the next ones: fresh pages cost as much as what is written there.
class ScenePasses::Spares {
 public:
  std::vector<TriangleD> take() {
    const std::lock_guard lock(mutex_);
    if (spares_.empty()) return {};
    std::vector<TriangleD> spare = std::move(spares_.back());
    spares_.pop_back();
    return spare;
  }
  void give(std::vector<TriangleD>&& spare) {
    const std::lock_guard lock(mutex_);
    if (spares_.size() < kMost) spares_.push_back(std::move(spare));
  }

 private:
  std::mutex mutex_;
  std::vector<std::vector<TriangleD>> spares_;
  static constexpr std::size_t kMost = 8;  // a chunk gives some back at once
};

ScenePasses::ScenePasses(TriangleSource& source, std::uint64_t memory_bytes, ChunkedSurface* chunks)
    : source_(source), memory_bytes_(memory_bytes), chunks_(chunks), spares_(std::make_unique<Spares>()) {}
ScenePasses::~ScenePasses() = default;

void ScenePasses::measure(const StageProgress& progress) {
  StageSteps steps(progress, "reading", "triangles", 0);
  pipeline<Item>(
      thread_count() + 2, [&](Item& item) { return (item.fetched = source_.next()) != nullptr; },
      [&](Item& item) {
        item.triangles = spares_->take();
        item.fetched->make(item.triangles);
        item.fetched.reset();
        for (const TriangleD& t : item.triangles) {
          for (const Vec3d& p : t) item.bounds.add(p);
        }
        item.digest.set(item.triangles);
        if (item.triangles.capacity() > item.triangles.size() / 4 * 5) item.triangles.shrink_to_fit();
      },
      [&](Item& item) {
        cutter_.add(item.digest);
        add_chunks();
        bounds_.merge(item.bounds);
        steps.add(item.triangles.size());
        if (!reads_twice_) keep(std::move(item));
      });
  cutter_.finish();
  add_chunks();
  if (chunks_ && !reads_twice_) drop_met();
  spares_.reset();
  input_hash_ = cutter_.content();
  if (bounds_.empty()) {
    const SceneCounts& c = source_.counts();
    fail(ErrorCode::bad_input,
         "{}: no triangles ({} degenerate, {} non-finite, {} bad faces skipped); a scene needs at least one with an "
         "area",
         source_.name(), c.degenerate, c.non_finite, c.bad_faces);
  }
}

std::string ScenePasses::input_hash() const {
  const auto [high, low] = input_hash_.words;
  return hex_of(high, low);
}

/// Those that have ended.
void ScenePasses::add_chunks() {
  if (!chunks_) return;
  while (chunks_added_ < cutter_.chunks().size()) chunks_->add(cutter_.chunks()[chunks_added_++]);
}

void ScenePasses::keep(Item&& item) {
  kept_bytes_ += item.triangles.capacity() * sizeof(TriangleD);
  const std::uint64_t count = item.triangles.size();
  kept_.push_back({std::move(item.triangles), count});
  if (chunks_) drop_met();
  if (kept_bytes_ <= memory_bytes_) return;
  reads_twice_ = true;
  release();
}

/// Triangles whose voxels are probably known do not stay.
void ScenePasses::drop_met() {
  for (; dropped_ < kept_.size(); ++dropped_) {
    Portion& portion = kept_[dropped_];
    const std::uint64_t end = dropped_end_ + portion.count;
    if (!chunks_->ended(end)) return;
    if (chunks_->met(dropped_end_, end)) {
      kept_bytes_ -= portion.triangles.capacity() * sizeof(TriangleD);
      spares_->give(std::exchange(portion.triangles, {}));
    }
    dropped_end_ = end;
  }
}

void ScenePasses::again(const std::function<void(const NextPortion&)>& body) {
  if (!reads_twice_) {
    std::size_t i = 0;
    body([&](Portion& portion) {
      if (i == kept_.size()) return false;
      portion = std::move(kept_[i++]);
      return true;
    });
    return;
  }
  source_.rewind();
  constexpr std::size_t kPart = 2048;
  ChunkCutter cutter;
  std::vector<ChunkCutter::Digest> parts;
  body([&](Portion& portion) {
    const bool more = source_.read(portion.triangles);
    const std::span<const TriangleD> all(portion.triangles);
    portion.count = all.size();
    parts.resize((all.size() + kPart - 1) / kPart);
    parallel_for(std::int64_t(parts.size()), [&](std::int64_t i) {
      const std::size_t begin = std::size_t(i) * kPart;
      parts[std::size_t(i)].set(all.subspan(begin, std::min(kPart, all.size() - begin)));
    });
    for (const ChunkCutter::Digest& part : parts) cutter.add(part);
    return more;
  });
  cutter.finish();
  if (cutter.content() != input_hash_)
    fail(ErrorCode::bad_input, "{}: changed between the first and the second reading", source_.name());
}

}  // namespace bp
