#include "lib/closing/detail/oriented_cube.h"

#include <algorithm>

namespace bp::detail {

namespace {

/// floor(n / a), for n that changes by the same step from time to time. All are below 2^29: rows of 2^14 times a reach
/// of 2^13, twice.
class SteppedQuotient {
 public:
  SteppedQuotient(std::int32_t n, std::int32_t step, std::int32_t a)
      : a_(a),
        step_(floor_div(step, a)),
        step_rest_(step - step_ * a),
        quotient_(floor_div(n, a)),
        rest_(n - quotient_ * a) {}
  [[nodiscard]] std::int32_t get() const { return quotient_; }
  void next() {
    rest_ += step_rest_;
    const std::int32_t over = rest_ >= a_ ? 1 : 0;
    rest_ -= over * a_;
    quotient_ += step_ + over;
  }

 private:
  std::int32_t a_, step_, step_rest_, quotient_, rest_;
};

/// Cuts rows dy = -reach and on to the x with |a x + b dy + c| <= limit, a >= 0.
void cut(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t limit, std::int32_t reach, CubeRow* rows) {
  const std::int32_t count = 2 * reach + 1, t = c - b * reach;
  if (a == 0) {
    for (std::int32_t i = 0; i < count; ++i) {
      if (t + b * i > limit || t + b * i < -limit) rows[i] = {0, -1};
    }
    return;
  }
  SteppedQuotient down(limit + t, b, a), up(limit - t, -b, a);
  for (std::int32_t i = 0; i < count; ++i, down.next(), up.next()) {
    if (-down.get() > rows[i].first) rows[i].first = std::int16_t(std::min(-down.get(), reach + 1));
    if (up.get() < rows[i].last) rows[i].last = std::int16_t(std::max(up.get(), -reach - 1));
  }
}

/// From the first to the last of them that is not empty.
template <class Filled>
Filled filled(const CubeRow* rows, std::int32_t count) {
  const auto empty = [&](std::int32_t i) { return rows[i].last < rows[i].first; };
  std::int32_t begin = 0, end = count;
  while (begin < end && empty(begin)) ++begin;
  while (begin < end && empty(end - 1)) --end;
  return {std::int16_t(begin), std::int16_t(end)};
}

}  // namespace

CubeRows::CubeRows(const Rotation& rotation, Scale s)
    : rotation_(rotation),
      limit_(s * ((1 << kRotationBits) / kScaleOne)),
      reach_(cube_bounds(rotation).reach(s)),
      first_block_(floor_div(-reach_, kEdge)),
      across_(floor_div(reach_, kEdge) + 1 - first_block_) {
  const auto side = std::size_t(2 * reach_ + 1);
  rows_.resize(side * side);
  slices_.resize(side);
  for (std::int32_t j = first_block_; j < first_block_ + across_; ++j) {
    for (std::int32_t i = first_block_; i < first_block_ + across_; ++i) blocks_.push_back(block(i, j));
    layers_.push_back(filled<Filled>(blocks_.data() + blocks_.size() - std::size_t(across_), across_));
  }
}

CubeRow CubeRows::block(std::int32_t i, std::int32_t j) const {
  constexpr std::int32_t more = kEdge - 1;
  std::int32_t first = -reach_, last = reach_;
  for (const auto& [a, b, c] : rotation_.row) {
    const std::int32_t t = kEdge * (b * i + c * j), low = t + (std::min<int>(b, 0) + std::min<int>(c, 0)) * more,
                       high = t + (std::max<int>(b, 0) + std::max<int>(c, 0)) * more;
    if (a == 0) {
      if (low > limit_ || high < -limit_) last = first - 1;
      continue;
    }
    first = std::max(first, -floor_div(limit_ + high, std::int32_t(a)));
    last = std::min(last, floor_div(limit_ - low, std::int32_t(a)));
  }
  return first > last ? CubeRow{0, -1} : CubeRow{std::int16_t(first), std::int16_t(last)};
}

void CubeRows::make_slice(std::int32_t dz) const {
  const std::int32_t side = 2 * reach_ + 1;
  CubeRow* rows = rows_.data() + std::size_t(dz + reach_) * std::size_t(side);
  std::fill_n(rows, side, CubeRow{std::int16_t(-reach_), std::int16_t(reach_)});
  for (const auto& [a, b, c] : rotation_.row) cut(a, b, c * dz, limit_, reach_, rows);
  slices_[std::size_t(dz + reach_)] = filled<Filled>(rows, side);
}

CubeRows::Stretch CubeRows::rows(std::int32_t dz, std::int32_t begin, std::int32_t end) const {
  Filled& slice = slices_[std::size_t(dz + reach_)];
  if (slice.end < slice.begin) make_slice(dz);
  begin = std::max(begin, slice.begin - reach_);
  end = std::min(end, slice.end - reach_);
  return {begin, end, rows_.data() + (dz + reach_) * (2 * reach_ + 1) + begin + reach_};
}

CubeRows::Stretch CubeRows::blocks(std::int32_t j) const {
  const std::int32_t layer = j - first_block_;
  if (layer < 0 || layer >= across_) return {};
  const Filled& f = layers_[std::size_t(layer)];
  return {first_block_ + f.begin, first_block_ + f.end, blocks_.data() + layer * across_ + f.begin};
}

}  // namespace bp::detail
