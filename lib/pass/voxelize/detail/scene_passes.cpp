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
  Bounds3d bounds;
  double extent = 0;
  std::optional<SurfaceSums> sums;
};

void ScenePasses::measure(const PassProgress& progress) {
  PassSteps steps(progress, "reading", "triangles", 0);
  ContentHash hash;
  std::optional<Vec3d> origin;
  pipeline<Item>(
      thread_count() + 2,
      [&](Item& item) {
        if (!source_.read(item.triangles)) return false;
        if (!origin && !item.triangles.empty()) sums_ = SurfaceSums(*(origin = item.triangles[0][0]));
        item.sums.emplace(origin.value_or(Vec3d{}));
        return true;
      },
      [&](Item& item) {
        for (const TriangleD& t : item.triangles) {
          Bounds3d box;
          for (const Vec3d& p : t) box.add(p);
          item.bounds.merge(box);
          for (std::size_t i = 0; i < 3; ++i) item.extent += box.max[i] - box.min[i];
        }
        item.sums->add(item.triangles);
        if (chunks_) item.places = ChunkCutter::places(item.triangles);
        if (item.triangles.capacity() > item.triangles.size() / 4 * 5) item.triangles.shrink_to_fit();
      },
      [&](Item& item) {
        hash.add(std::as_bytes(std::span(item.triangles)));
        if (chunks_) chunks_->measure(item.triangles, item.places);
        bounds_.merge(item.bounds);
        sums_.merge(*item.sums);
        item.sums.reset();
        extent_ += item.extent;
        steps.add(item.triangles.size());
        if (!reads_twice_) keep(std::move(item));
      });
  input_hash_ = text_of(hash);
  if (!source_.counts().has_area()) refuse_empty_scene(source_.name(), source_.counts());
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
    const bool more = source_.read(portion.triangles);
    portion.count = portion.triangles.size();
    hash.add(std::as_bytes(std::span(portion.triangles)));
    return more;
  });
  if (text_of(hash) != input_hash_)
    fail(ErrorCode::bad_input, "{}: changed between the first and the second reading", source_.name());
}

}  // namespace bp
