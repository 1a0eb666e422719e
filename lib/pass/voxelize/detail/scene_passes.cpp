#include "lib/pass/voxelize/detail/scene_passes.h"

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/voxelize/empty_scene.h"
#include "lib/store/content_hash.h"
#include "lib/store/hex.h"

namespace bp {

namespace {

std::string text_of(const ContentHash& hash) {
  const auto [high, low] = hash.value().words;
  return hex_of(high, low);
}

}  // namespace

struct ScenePasses::Item {
  std::vector<TriangleD> triangles;
  std::vector<std::uint32_t> places;
  SurfaceSums sums;
  TriangleBatch batch;
};

void ScenePasses::measure(const PassProgress& progress, const std::optional<Sorter>& sorter) {
  PassSteps steps(progress, "reading", "triangles", 0);
  ContentHash hash;
  std::optional<Vec3d> origin;
  Spares<SurfaceSums> sums;
  sorted_ = sorter.has_value();
  pipeline<Item>(
      2 * thread_count() + 1,  // enough for all threads while the source fetches as many
      [&](Item& item) {
        item.triangles = spare_.take();
        if (!source_.read(item.triangles)) return false;
        if (!origin && !item.triangles.empty()) sums_.reset(*(origin = item.triangles[0][0]));
        item.sums = sums.take();
        item.sums.reset(origin.value_or(Vec3d{}));
        return true;
      },
      [&](Item& item) {
        item.sums.add(item.triangles);
        if (chunks_) item.places = ChunkCutter::places(item.triangles);
        if (sorter && !sorter->bounds.contains(item.sums.bounds())) sorted_ = false;
        if (sorted_) item.batch = sorter->sort(item.triangles);
        if (!sorter && item.triangles.capacity() > item.triangles.size() / 4 * 5) item.triangles.shrink_to_fit();
      },
      [&](Item& item) {
        hash.add(std::as_bytes(std::span(item.triangles)));
        if (chunks_) chunks_->measure(item.triangles, item.places);
        sums_.merge(item.sums);
        sums.give(std::move(item.sums));
        steps.add(item.triangles.size());
        if (sorted_) sorter->add(std::move(item.batch));
        if (sorter || reads_twice_) {
          spare_.give(std::move(item.triangles));
        } else {
          keep(std::move(item.triangles));
        }
      });
  input_hash_ = text_of(hash);
  if (!source_.counts().has_area()) refuse_empty_scene(source_.name(), source_.counts());
}

void ScenePasses::keep(std::vector<TriangleD>&& triangles) {
  kept_bytes_ += triangles.capacity() * sizeof(TriangleD);
  const std::uint64_t count = triangles.size();
  kept_.push_back({std::move(triangles), count});
  if (chunks_) drop_met();
  if (kept_bytes_ <= memory_bytes_) return;
  reads_twice_ = true;
  release();
}

/// Drops triangles whose voxels are probably among the results.
void ScenePasses::drop_met() {
  for (; dropped_ < kept_.size(); ++dropped_) {
    Portion& portion = kept_[dropped_];
    const std::uint64_t end = dropped_end_ + portion.count;
    if (!chunks_->ended(end)) return;
    if (chunks_->met(dropped_end_, end)) {
      kept_bytes_ -= portion.triangles.capacity() * sizeof(TriangleD);
      std::vector<TriangleD>().swap(portion.triangles);
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
  ContentHash hash;
  body([&](Portion& portion) {
    if (portion.triangles.capacity() == 0) portion.triangles = spare_.take();
    const bool more = source_.read(portion.triangles);
    portion.count = portion.triangles.size();
    hash.add(std::as_bytes(std::span(portion.triangles)));
    return more;
  });
  if (text_of(hash) != input_hash_)
    fail(ErrorCode::bad_input, "{}: changed between the first and the second reading", source_.name());
}

}  // namespace bp
