#pragma once
#include <algorithm>
#include <vector>

namespace bp {

/// The upper one of two in the middle; 0 of none.
inline double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v.empty() ? 0 : v[v.size() / 2];
}

}  // namespace bp
