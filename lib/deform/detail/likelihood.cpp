#include "lib/deform/detail/likelihood.h"

#include "lib/deform/detail/mean_value.h"
#include "lib/deform/formulas/likelihood.h"

namespace bp::detail {

namespace {

void take_shares_slowly(const Cage& cage, const WideVec& points, unsigned doubtful, CoordinateScratch& s) {
  for (std::size_t k = 0; k < kWide; ++k) {
    const int lane = int(k);
    if (doubtful >> k & 1) face_shares_slowly(cage, {points.x[lane], points.y[lane], points.z[lane]}, k, s);
  }
}

BP_WIDE_CLONES void take_all_shares(const CageView& view, CoordinateScratch& s) {
  WideBits near{};
  take_face_shares<Wide>(view, s, near);
}

BP_WIDE_CLONES void take_likelihood(const CageView& view, unsigned doubtful, const Wide& total, CoordinateScratch& s) {
  WideBits going = total > 0.0;
  for (unsigned k = 0; k < kWide; ++k) going[k] |= -(long long)(doubtful >> k & 1);
  take_middles<Wide>(view, s);
  likelihood_formula<Wide>(view, going, s);
}

}  // namespace

void likelihood_weights(const Cage& cage, const WideVec& points, unsigned doubtful, const Wide& total,
                        CoordinateScratch& s) {
  const CageView view = view_of(cage);
  s.faces.resize(cage.faces.size());
  take_all_shares(view, s);
  take_shares_slowly(cage, points, doubtful, s);
  take_likelihood(view, doubtful, total, s);
}

}  // namespace bp::detail
