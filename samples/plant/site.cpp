#include "samples/plant/site.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"

namespace plant {

namespace {

constexpr std::uint64_t kSeedsPerKind = 3;

std::uint64_t width_of(std::uint64_t plots) {
  auto w = std::uint64_t(std::sqrt(double(plots)));
  while (w * w < plots) ++w;
  return std::max<std::uint64_t>(w, 1);
}

/// Larger sites have finer parts, so that a site of 10^9 triangles still is a few kilometres wide.
double detail_for(std::uint64_t triangles) {
  double detail = 1;
  for (std::uint64_t n = 2000000; n < triangles && detail < 6; n *= 8) detail += 1;
  return triangles < 60000 ? 0.5 : triangles < 500000 ? 0.6 : detail;
}

}  // namespace

Site::Site(std::uint64_t triangles, std::uint64_t seed) : seed_(seed), detail_(detail_for(triangles)) {
  if (triangles < 10000)
    bp::fail(bp::ErrorCode::bad_argument, "--triangles {}: at least 10000 make a plant", triangles);
  for (int kind = 0; kind < kModuleKinds; ++kind) {
    for (std::uint64_t k = 0; k < kSeedsPerKind; ++k) add_shape(Kind(kind), seed * 1000 + k, 0);
  }
  rack_ = add_shape(Kind::rack, seed, 0);
  fence_ = add_shape(Kind::fence, seed, 0);
  ground_ = add_shape(Kind::ground, seed, 0);
  CountSink drum;
  build(Kind::yard, seed, detail_, 1, drum);

  // Modules as long as they fit beside the racks, the fence and the yard; then drums.
  std::uint64_t modules = 0;
  const auto total = [&](std::uint64_t plots, std::uint64_t module_triangles) {
    return module_triangles + plots * shapes_[rack_].counts.triangles + surroundings(plots + 1);
  };
  const auto fits = [&](std::size_t shape) {
    const std::uint64_t next = modules + shapes_[shape].counts.triangles;
    if (total(plots_ + 1, next) > triangles) return false;
    modules = next;
    ++plots_;
    return true;
  };
  while (fits(module_of(plots_))) {
  }
  for (std::size_t shape = 0; shape < rack_; shape += kSeedsPerKind) {  // what is left over holds smaller ones
    if (fits(shape)) extras_.push_back(shape);
  }
  const std::uint64_t used = total(plots_, modules);
  yard_ = add_shape(Kind::yard, seed, used < triangles ? (triangles - used) / drum.counts.triangles : 0);

  for_each([this](const Placement& p) { counts_.add(shapes_[p.shape].counts); });
}

std::size_t Site::add_shape(Kind kind, std::uint64_t seed, std::uint64_t items) {
  CountSink sink;
  build(kind, seed, detail_, items, sink);
  shapes_.push_back({kind, seed, items, sink.counts});
  return shapes_.size() - 1;
}

/// Every kind once in each seven plots, in an order drawn from the seed.
std::size_t Site::module_of(std::uint64_t plot) const {
  if (plot + extras_.size() >= plots_ && plot < plots_) return extras_[plot + extras_.size() - plots_];
  std::array<std::size_t, kModuleKinds> order{};
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::uint64_t round = plot / kModuleKinds;
  Random random(seed_ * 7919 + round);
  for (std::size_t i = order.size() - 1; round > 0 && i > 0; --i)
    std::swap(order[i], order[std::size_t(random.integer(0, int(i)))]);
  return order[plot % kModuleKinds] * kSeedsPerKind + std::size_t(Random(seed_ + plot).integer(0, kSeedsPerKind - 1));
}

/// Triangles of the ground and the fence.
std::uint64_t Site::surroundings(std::uint64_t plots) const {
  const std::uint64_t width = width_of(plots), rows = (plots + width - 1) / width;
  return 2 * (width + rows) * shapes_[fence_].counts.triangles + width * rows * shapes_[ground_].counts.triangles;
}

void Site::build_shape(std::size_t shape, Sink& sink) const {
  build(shapes_[shape].kind, shapes_[shape].seed, detail_, shapes_[shape].items, sink);
}

void Site::for_each(const std::function<void(const Placement&)>& visit) const {
  const std::uint64_t width = width_of(plots_ + 1), rows = (plots_ + width) / width;
  for (std::uint64_t plot = 0; plot < width * rows; ++plot) {
    const std::uint64_t row = plot / width, column = row % 2 == 0 ? plot % width : width - 1 - plot % width;
    const double x = kPlot * double(column), z = kPlot * double(row);
    visit({ground_, 1, 0, 0, 1, x, z});
    if (plot == plots_) visit({yard_, 1, 0, 0, 1, x, z});
    if (plot >= plots_) continue;
    // Shapes are turned by half, mirrored, or stay as drawn.
    const int pose = plot < kModuleKinds ? 0 : Random(seed_ * 31 + plot).integer(0, 3);
    const double sx = pose & 1 ? -1 : 1, sz = pose & 2 ? -1 : 1;
    visit({module_of(plot), sx, 0, 0, sz, x + (sx < 0 ? kPlot : 0), z + (sz < 0 ? kModuleDepth : 0)});
    visit({rack_, 1, 0, 0, 1, x, z});
  }
  const double far_x = kPlot * double(width), far_z = kPlot * double(rows);
  for (std::uint64_t i = 0; i < width; ++i) {
    visit({fence_, 1, 0, 0, 1, kPlot * double(i), -1});
    visit({fence_, -1, 0, 0, -1, kPlot * double(i + 1), far_z + 1});
  }
  for (std::uint64_t i = 0; i < rows; ++i) {
    visit({fence_, 0, 1, -1, 0, -1, kPlot * double(i + 1)});
    visit({fence_, 0, -1, 1, 0, far_x + 1, kPlot * double(i)});
  }
}

}  // namespace plant
