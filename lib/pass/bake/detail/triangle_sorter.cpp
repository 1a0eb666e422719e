#include "lib/pass/bake/detail/triangle_sorter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <queue>

namespace bp {

namespace {

constexpr std::size_t kAtOnce = 1024;  // triangles of a run in memory while runs are merged
constexpr int kMortonBits = 57;
/// Classes of size: larger than an eighth of the scene, a 64th, a 512th, and all others.
constexpr int kSizes = 4;

double longest_side(const Bounds3d& b) {
  return std::max({b.max[0] - b.min[0], b.max[1] - b.min[1], b.max[2] - b.min[2]});
}

}  // namespace

/// A run that is read back.
class TriangleSorter::Run {
 public:
  Run(Scratch& store, std::span<const Scratch::Handle> chunks) : store_(store), chunks_(chunks) { load(); }
  [[nodiscard]] const Keyed& front() const { return loaded_[at_]; }
  [[nodiscard]] bool empty() const { return at_ == loaded_.size(); }
  void pop() {
    if (++at_ == loaded_.size()) load();
  }

 private:
  void load() {
    loaded_.clear();
    at_ = 0;
    if (chunks_.empty()) return;
    store_.get(chunks_.front(), bytes_);
    loaded_.resize(bytes_.size() / sizeof(Keyed));
    std::memcpy(loaded_.data(), bytes_.data(), bytes_.size());
    store_.drop(chunks_.front());
    chunks_ = chunks_.subspan(1);
  }
  Scratch& store_;
  std::span<const Scratch::Handle> chunks_;
  std::vector<std::byte> bytes_;
  std::vector<Keyed> loaded_;
  std::size_t at_ = 0;
};

/// Cuts the triangles, in their order, into groups.
class TriangleSorter::Groups {
 public:
  Groups(std::size_t most, const std::function<void(std::span<const TexturedTriangle>)>& body)
      : most_(most), body_(body) {}
  void add(const Keyed& k) {
    if (group_.size() == most_ || (!group_.empty() && k.key >> kMortonBits != size_)) end();
    size_ = k.key >> kMortonBits;
    group_.push_back(k.triangle);
  }
  void end() {
    if (!group_.empty()) body_(group_);
    group_.clear();
  }

 private:
  const std::size_t most_;
  const std::function<void(std::span<const TexturedTriangle>)>& body_;
  std::vector<TexturedTriangle> group_;
  std::uint64_t size_ = 0;
};

TriangleSorter::TriangleSorter(const Bounds3d& bounds, Scratch& store, std::uint64_t memory_bytes)
    : bounds_(bounds),
      side_(longest_side(bounds)),
      store_(store),
      most_waiting_(std::size_t(std::clamp<std::uint64_t>(memory_bytes / (sizeof(Keyed) + 4), 4 * kAtOnce, 1u << 31))) {
}

std::uint64_t TriangleSorter::key_of(const TriangleD& t) const {
  Bounds3d box;
  for (const Vec3d& p : t) box.add(p);
  const double times = side_ / longest_side(box);
  const int size = times > 1 ? std::min(std::ilogb(times) / 3, kSizes - 1) : 0;
  return std::uint64_t(size) << kMortonBits | morton_of(middle_of(t), bounds_);
}

void TriangleSorter::add(const TexturedTriangle& triangle) {
  if (waiting_.size() == most_waiting_) put_run();
  if (waiting_.size() == waiting_.capacity())
    waiting_.reserve(std::min(most_waiting_, std::max(4 * kAtOnce, 2 * waiting_.size())));
  waiting_.push_back({key_of(triangle.corners), triangle});
}

/// Returns the order. Equal triangles stay in the order of the scene.
std::vector<std::uint32_t> TriangleSorter::order() const {
  std::vector<std::uint32_t> order(waiting_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return waiting_[a].key != waiting_[b].key ? waiting_[a].key < waiting_[b].key : a < b;
  });
  return order;
}

void TriangleSorter::put_run() {
  const std::vector<std::uint32_t> sorted = order();
  std::vector<Keyed> chunk;
  std::vector<Scratch::Handle>& run = runs_.emplace_back();
  for (std::size_t i = 0; i < sorted.size(); i += kAtOnce) {
    chunk.clear();
    for (std::size_t k = i; k < std::min(i + kAtOnce, sorted.size()); ++k) chunk.push_back(waiting_[sorted[k]]);
    run.push_back(store_.put(std::as_bytes(std::span(chunk))));
  }
  waiting_.clear();
}

void TriangleSorter::finish(std::size_t most, const std::function<void(std::span<const TexturedTriangle>)>& body) {
  Groups groups(most, body);
  if (runs_.empty()) {
    for (const std::uint32_t i : order()) groups.add(waiting_[i]);
    std::vector<Keyed>().swap(waiting_);
    return groups.end();
  }
  put_run();
  std::vector<Keyed>().swap(waiting_);
  std::vector<Run> runs;
  // key, run; of equal keys the run that is earlier in the scene comes first
  using Next = std::pair<std::uint64_t, std::size_t>;
  std::priority_queue<Next, std::vector<Next>, std::greater<>> next;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    runs.emplace_back(store_, runs_[r]);
    next.emplace(runs.back().front().key, r);
  }
  while (!next.empty()) {
    const std::size_t r = next.top().second;
    next.pop();
    groups.add(runs[r].front());
    runs[r].pop();
    if (!runs[r].empty()) next.emplace(runs[r].front().key, r);
  }
  groups.end();
}

}  // namespace bp
