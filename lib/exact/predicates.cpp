// All terms of the determinant are added (expansion.h). Refinement in stages was rejected: a scene seldom gets here,
// and the usual cases (coplanar faces, shared edges) have exact differences and many zero terms, which cost nothing.
#include "lib/exact/predicates.h"

#include "lib/exact/expansion.h"

namespace bp::detail {

namespace {

template <int kMax>
void add_product(Expansion<kMax>& e, const ExactPair& x, const ExactPair& y, double sign) {
  for (const double a : {x.error, x.value})
    for (const double b : {y.error, y.value}) e.add_product(sign * a, b);
}

template <int kMax>
void add_product(Expansion<kMax>& e, const ExactPair& x, const ExactPair& y, const ExactPair& z, double sign) {
  for (const double a : {x.error, x.value})
    for (const double b : {y.error, y.value})
      for (const double c : {z.error, z.value}) e.add_product(sign * a, b, c);
}

}  // namespace

int orient3d_exact(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  ExactPair u[3], v[3], w[3];
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = two_diff(b[i], a[i]);
    v[i] = two_diff(c[i], a[i]);
    w[i] = two_diff(d[i], a[i]);
  }
  Expansion<6 * 8 * 4> det;  // 6 terms of 8 products of doubles, 4 doubles each
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    add_product(det, u[i], v[j], w[k], 1);
    add_product(det, u[j], v[i], w[k], -1);
  }
  return det.sign();
}

int orient2d_exact(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis) {
  const std::size_t i = std::size_t(axis + 1) % 3, j = std::size_t(axis + 2) % 3;
  Expansion<2 * 4 * 2> det;
  add_product(det, two_diff(b[i], a[i]), two_diff(c[j], a[j]), 1);
  add_product(det, two_diff(b[j], a[j]), two_diff(c[i], a[i]), -1);
  return det.sign();
}

}  // namespace bp::detail
