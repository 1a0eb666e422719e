#include "lib/closing/detail/oriented_cube.h"

#include <algorithm>
#include <cstdlib>

namespace bp::detail {

namespace {

/// Computes floor(n / a) for an n that changes by the same step from time to time. All numbers are below 2^29: rows of
/// 2^14 times a reach of 2^13, twice.
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

constexpr std::int32_t kFar = 1 << 14;  ///< beyond any reach

/// Cuts rows dy in [begin, end) to the x with |a x + b dy + c| <= limit, a >= 0. `rows` points to row 0.
void cut(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t limit, std::int32_t begin, std::int32_t end,
         CubeRow* rows) {
  const std::int32_t t = c + b * begin;
  if (a == 0) {
    for (std::int32_t i = begin; i < end; ++i) {
      if (std::abs(c + b * i) > limit) rows[i] = {0, -1};
    }
    return;
  }
  SteppedQuotient down(limit + t, b, a), up(limit - t, -b, a);
  for (std::int32_t i = begin; i < end; ++i, down.next(), up.next()) {
    rows[i].first = std::int16_t(std::max<std::int32_t>(rows[i].first, std::min(-down.get(), kFar)));
    rows[i].last = std::int16_t(std::min<std::int32_t>(rows[i].last, std::max(up.get(), -kFar)));
  }
}

/// Returns the range from the first to the last row that is not empty.
template <class Filled>
Filled filled(const CubeRow* rows, std::int32_t count) {
  const auto empty = [&](std::int32_t i) { return rows[i].last < rows[i].first; };
  std::int32_t begin = 0, end = count;
  while (begin < end && empty(begin)) ++begin;
  while (begin < end && empty(end - 1)) --end;
  return {std::int16_t(begin), std::int16_t(end)};
}

}  // namespace

bool keeps_axis(const Rotation& r, int axis) {
  int across = 0;
  for (const auto& row : r.row) {
    const bool along = row[axis] != 0;
    if (along && std::abs(row[axis]) != 1 << kRotationBits) return false;
    for (int k = 0; along && k < 3; ++k) {
      if (k != axis && row[k] != 0) return false;
    }
    across += along ? 0 : 1;
  }
  return across == 2;
}

CubeRows::CubeRows(const Rotation& rotation, Scale s, int flat)
    : rotation_(rotation),
      limit_(s * ((1 << kRotationBits) / kScaleOne)),
      reach_(cube_bounds(rotation).reach(s)),
      flat_(flat),
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
  if ((flat_ == 1 && i != 0) || (flat_ == 2 && j != 0)) last = first - 1;
  return first > last ? CubeRow{0, -1} : CubeRow{std::int16_t(first), std::int16_t(last)};
}

void CubeRows::make_slice(std::int32_t dz) const {
  Filled &slice = slices_[std::size_t(dz + reach_)], &mirrored = slices_[std::size_t(reach_ - dz)];
  CubeRow* to = row(dz);
  if (mirrored.begin <= mirrored.end) {  // the cube is its own mirror image through its centre
    slice = {std::int16_t(2 * reach_ + 1 - mirrored.end), std::int16_t(2 * reach_ + 1 - mirrored.begin)};
    const CubeRow* from = row(-dz);
    for (std::int32_t i = slice.begin - reach_; i < slice.end - reach_; ++i)
      to[i] = {std::int16_t(-from[-i].last), std::int16_t(-from[-i].first)};
    return;
  }
  const Stretch in = blocks(floor_div(dz, kEdge));
  const std::int32_t begin = std::max(kEdge * in.begin, flat_ == 1 ? 0 : -reach_);
  const std::int32_t end = flat_ == 2 && dz != 0 ? begin : std::min(kEdge * in.end, flat_ == 1 ? 1 : reach_ + 1);
  if (begin < end) {
    std::fill(to + begin, to + end, CubeRow{std::int16_t(-reach_), std::int16_t(reach_)});
    for (const auto& [a, b, c] : rotation_.row) cut(a, b, c * dz, limit_, begin, end, to);
  }
  const auto count = std::max(end - begin, 0), before = begin < end ? begin + reach_ : 0;
  slice = filled<Filled>(to - reach_ + before, count);
  slice = {std::int16_t(slice.begin + before), std::int16_t(slice.end + before)};
}

}  // namespace bp::detail
