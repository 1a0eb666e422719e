#pragma once
#include <algorithm>
#include <vector>

namespace bp {

/// Returns the median, the upper one of two in the middle; 0 of no values.
inline double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v.empty() ? 0 : v[v.size() / 2];
}

}  // namespace bp
