#pragma once
#include <functional>
#include <vector>

#include "lib/volume/detail/clearance.h"
#include "lib/volume/detail/shut_trial.h"
#include "lib/volume/leak.h"

namespace bp {

/// The leaks of a search, the largest room first.
struct FoundLeaks {
  Leaks leaks;
  std::vector<OpeningSides> sides;  ///< of the first leaks, those that are tried
};

/// Finds the leaks, without trials. `trials`: the number of leaks of which both sides are wanted. reached(n) is called
/// now and then with the number of voxels that the flood has reached, and may throw.
[[nodiscard]] FoundLeaks search_leaks(Clearance clearance, std::size_t trials,
                                      const std::function<void(std::uint64_t)>& reached);

}  // namespace bp
