#include "lib/atlas/pack.h"

#include <algorithm>
#include <numeric>

namespace bp {

namespace {

/// The upper edge of the rectangles in the strip, as spans from left to right.
class Skyline {
 public:
  explicit Skyline(int width) : width_(width), spans_{{0, 0}} {}

  /// Finds the lowest place; if there are several, the leftmost.
  [[nodiscard]] std::optional<std::size_t> lowest(const PackedRect& rect, int& y) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < spans_.size() && spans_[i].x + rect.width <= width_; ++i) {
      const int top = top_of(i, rect.width);
      if (best && top >= y) continue;
      y = top;
      best = i;
    }
    return best;
  }
  void put(std::size_t i, PackedRect& rect, int y) {
    rect.x = spans_[i].x;
    rect.y = y;
    const int end = rect.x + rect.width;
    std::size_t last = i;  // the span that holds the end, or begins there
    while (last + 1 < spans_.size() && spans_[last + 1].x <= end) ++last;
    const Span after{end, spans_[last].y};
    const bool ends_inside = end < width_ && spans_[last].x < end;
    const auto begin = spans_.begin() + std::ptrdiff_t(i);
    spans_.erase(begin, spans_.begin() + std::ptrdiff_t(last + (spans_[last].x < end ? 1 : 0)));
    const std::ptrdiff_t at = std::ptrdiff_t(i);
    if (ends_inside) spans_.insert(spans_.begin() + at, after);
    spans_.insert(spans_.begin() + at, {rect.x, y + rect.height});
  }

 private:
  struct Span {
    int x, y;
  };
  [[nodiscard]] int top_of(std::size_t i, int width) const {
    int top = 0;
    for (const int end = spans_[i].x + width; i < spans_.size() && spans_[i].x < end; ++i)
      top = std::max(top, spans_[i].y);
    return top;
  }
  int width_;
  std::vector<Span> spans_;
};

}  // namespace

std::optional<int> pack(std::vector<PackedRect>& rects, int width, int most_height) {
  std::vector<std::size_t> order(rects.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const PackedRect &r = rects[a], &s = rects[b];
    return r.height != s.height ? r.height > s.height : r.width > s.width;
  });
  Skyline skyline(width);
  int height = 0;
  for (const std::size_t i : order) {
    int y = 0;
    const std::optional<std::size_t> place = skyline.lowest(rects[i], y);
    if (!place || y + rects[i].height > most_height) return {};
    skyline.put(*place, rects[i], y);
    height = std::max(height, y + rects[i].height);
  }
  return height;
}

}  // namespace bp
