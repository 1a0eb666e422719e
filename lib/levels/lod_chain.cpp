#include "lib/levels/lod_chain.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/levels/detail/level_search.h"

namespace bp {

namespace {

constexpr std::size_t kMostAtOnce = 4;  // levels

/// For one of n levels at work; the progress is that of all.
PassContext share_of(const PassContext& all, std::uint64_t n) {
  PassContext one = all;
  one.memory.bytes /= n;
  one.memory.share /= double(n);
  one.pieces = all.pieces.split(n);
  one.progress = {};
  return one;
}

}  // namespace

struct LodChain::State {
  State(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends, LodOptions options)
      : scene(header, std::move(solid), backends, std::move(options)) {}

  std::vector<LodLevel> make(const std::vector<LodTarget>& targets) {
    std::vector<LodLevel> levels(targets.size());
    if (targets.empty()) return levels;
    std::size_t first = 0;
    if (!start) {  // the first level leaves one
      begin(targets);
      LevelSearch search(scene, scene.context(), targets[0], start_for(targets[0]));
      levels[first++] = search.make();
      if (search.start()) start = std::move(search.start());
    }
    make_at_once(first, targets.size(), [&](std::size_t i, const PassContext& context) {
      levels[i] = LevelSearch(scene, context, targets[i], start_for(targets[i])).make();
    });
    return levels;
  }

  LevelScene scene;

 private:
  void begin(const std::vector<LodTarget>& targets) {
    const auto asks = [&](const LodTarget& target) { return may_follow(scene, target); };
    if (std::any_of(targets.begin(), targets.end(), asks)) start = scene.own_surface();
  }

  [[nodiscard]] const LevelStart* start_for(const LodTarget& target) const {
    return start && follows_from(scene, target, *start) ? &*start : nullptr;
  }

  /// make(i, context) for [first, end), several at the same time, each with its share of the memory. Those whose share
  /// does not suffice follow one by one, with all of it.
  template <class Make>
  void make_at_once(std::size_t first, std::size_t end, const Make& make) {
    const std::size_t n = std::min({end - first, kMostAtOnce, std::size_t(thread_count())});
    std::vector<std::size_t> alone;
    if (n > 1) {
      const PassContext share = share_of(scene.context(), n);
      std::mutex mutex;
      std::size_t next = first;
      run_jobs<std::size_t>(
          int(n), [&](std::size_t& i) { return (i = next++) < end; },
          [&](std::size_t& i) {
            try {
              make(i, share);
            } catch (const Error& e) {
              if (e.code() != ErrorCode::out_of_resource) throw;
              const std::lock_guard lock(mutex);
              alone.push_back(i);
            }
          });
      std::sort(alone.begin(), alone.end());
    } else {
      for (std::size_t i = first; i < end; ++i) alone.push_back(i);
    }
    for (const std::size_t i : alone) make(i, scene.context());
  }

  std::optional<LevelStart> start;  // of the levels whose faces suffice for it
};

LodChain::LodChain(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
                   LodOptions options)
    : state_(std::make_unique<State>(header, std::move(solid), backends, std::move(options))) {}

LodChain::~LodChain() = default;

std::uint64_t LodChain::dense_faces() const {
  return state_->scene.ruler().dense_faces;
}

std::int64_t LodChain::longest_side_vox() const {
  return state_->scene.ground().longest_side_vox;
}

std::vector<LodLevel> LodChain::make(const std::vector<LodTarget>& targets) {
  std::vector<LodLevel> levels;
  state_->scene.naming_all([&] { levels = state_->make(targets); });
  return levels;
}

}  // namespace bp
