#include "lib/levels/lod_chain.h"

#include <algorithm>
#include <mutex>
#include <span>
#include <utility>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/levels/detail/level_search.h"
#include "lib/levels/level_request.h"
#include "lib/mesh/half_edge_mesh.h"

namespace bp {

namespace {

/// Returns the context of one of n levels that are made at the same time. If its share of the memory is refused, no
/// limit is computed, since the level is then made alone.
PassContext share_of(const PassContext& all, std::uint64_t n) {
  PassContext one = all;
  one.memory.bytes /= n;
  one.memory.limit = {};
  one.pieces = all.pieces.split(n);
  one.pieces.limit = {};
  one.progress = {};
  return one;
}

}  // namespace

struct LodChain::State {
  State(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends, LodOptions options)
      : scene(header, std::move(solid), backends, std::move(options)) {}

  /// No closed surface has fewer faces than a tetrahedron. A request for fewer is one for these: the search would end
  /// with what a budget that cannot be met happened to leave.
  std::vector<LodLevel> make(const std::vector<LodTarget>& asked) {
    std::vector<LodTarget> targets = asked;
    for (LodTarget& target : targets)
      if (target.faces > 0) target.faces = std::max(target.faces, kFacesOfTetrahedron);
    std::vector<LodLevel> levels(targets.size());
    std::size_t first = 0;
    if (!std::exchange(is_begun, true)) {
      if (any_may_follow(targets)) begin_with(scene.own_surface());
      // The first level leaves the mesh that these start from.
      if (targets.size() == 1 || any_may_follow(std::span(targets).subspan(1))) {
        std::optional<LevelStart> left;
        levels[first++] = searched_level(scene, scene.context(), targets[0], start_for(targets[0]), &left);
        if (left) begin_with(std::move(left));
      }
    }
    make_at_once(targets, first, levels);
    for (std::size_t i = 0; i < levels.size(); ++i)
      levels[i].reached = levels[i].reached && (asked[i].faces == 0 || asked[i].faces == targets[i].faces);
    return levels;
  }

  LevelScene scene;

 private:
  [[nodiscard]] bool any_may_follow(std::span<const LodTarget> targets) const {
    return std::any_of(targets.begin(), targets.end(), [&](const LodTarget& t) { return may_follow(scene, t); });
  }

  void begin_with(std::optional<LevelStart> found) {
    start = std::move(found);
    if (start)
      scene.take_off(start->mesh.vertices.size() * sizeof(LatticeCoord) +
                     start->mesh.triangles.size() * sizeof(Triangle));
  }

  [[nodiscard]] const LevelStart* start_for(const LodTarget& target) const {
    return start && follows_from(scene, target, *start) ? &*start : nullptr;
  }

  [[nodiscard]] LodLevel made(const LodTarget& target, const PassContext& context) {
    return searched_level(scene, context, target, start_for(target));
  }

  /// Returns how many levels surely fit into the memory at the same time, at most as many as the default list has. Each
  /// level keeps about four threads busy.
  [[nodiscard]] std::size_t most_at_once() const {
    const std::uint64_t each = scene.bytes_of_level(start ? start->mesh.triangles.size() : 0);
    const std::uint64_t fitting = scene.context().pieces.bytes() / std::max<std::uint64_t>(each, 1);
    return std::clamp<std::size_t>(fitting, 1, std::min(std::size_t(kDefaultLevels), std::size_t(thread_count())));
  }

  /// Makes the levels from number `first` on, several at the same time, each with its share of the memory. A level
  /// whose share was refused is made afterwards, alone, with all of the memory.
  void make_at_once(const std::vector<LodTarget>& targets, std::size_t first, std::vector<LodLevel>& levels) {
    std::vector<char> is_made(targets.size());
    const std::size_t n = std::min(targets.size() - first, most_at_once());
    if (n > 1) {
      scene.context().report("meshing", "levels", first, targets.size());
      const PassContext share = share_of(scene.context(), n);
      std::mutex mutex;
      std::size_t next = first, done = first;
      run_jobs<std::size_t>(
          int(n), [&](std::size_t& i) { return (i = next++) < targets.size(); },
          [&](std::size_t& i) {
            try {
              levels[i] = made(targets[i], share);
            } catch (const NeedsMemory&) {
              return;
            }
            const std::lock_guard lock(mutex);
            is_made[i] = 1;
            scene.context().report("meshing", "levels", ++done, targets.size());
          });
    }
    for (std::size_t i = first; i < targets.size(); ++i) {
      if (is_made[i] == 0) levels[i] = made(targets[i], scene.context());
    }
  }

  bool is_begun = false;
  std::optional<LevelStart> start;  // for the levels whose faces suffice for its parts and holes
};

LodChain::LodChain(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
                   LodOptions options)
    : state_(std::make_unique<State>(header, std::move(solid), backends, std::move(options))) {}

LodChain::~LodChain() = default;

std::uint64_t LodChain::dense_faces() const {
  return state_->scene.ruler().dense_faces;
}

std::vector<LodLevel> LodChain::make(const std::vector<LodTarget>& targets) {
  return naming_limit([&] { return state_->make(targets); }, [&] { return state_->scene.all_steps_limit(); });
}

}  // namespace bp
