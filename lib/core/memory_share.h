#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bp {

/// The memory that a process may take. The process itself takes `fixed_bytes`; the rest is shared out.
struct MemoryLimit {
  std::uint64_t bytes = 0;        ///< 0: not known
  std::uint64_t fixed_bytes = 0;  ///< for the process itself; half of `bytes` if that is less
  [[nodiscard]] std::uint64_t rest_bytes() const { return bytes > 2 * fixed_bytes ? bytes - fixed_bytes : bytes / 2; }

  /// Returns the limit at which `share` of the rest has `missing` bytes more than now. 0: not known.
  [[nodiscard]] std::uint64_t with(std::uint64_t missing, double share) const {
    if (missing == 0) return bytes;
    return share > 0 ? for_rest(double(rest_bytes()) + double(missing) / share) : 0;
  }
  /// Returns the limit at which the rest has so many bytes. 0: not known.
  [[nodiscard]] std::uint64_t for_rest(double rest) const {
    const double fixed = double(fixed_bytes);
    return bytes == 0 ? 0 : std::uint64_t(std::ceil(rest > fixed ? rest + fixed : 2 * rest)) + 1;
  }
};

/// The memory that a step may take: a share of the rest of a limit.
struct MemoryShare {
  std::uint64_t bytes = std::uint64_t(512) << 20;
  double share = 0;  ///< between 0 and 1; 0: not known
  MemoryLimit limit{};
  double least_share = 0;  ///< the smallest share that the step has when it runs again in this process; 0: `share`

  /// Returns the limit at which `missing` bytes more are there. 0: not known.
  [[nodiscard]] std::uint64_t limit_with(std::uint64_t missing) const { return limit.with(missing, share); }
  /// Returns the limit at which the step has `needed` bytes each time that it runs. 0: not known.
  [[nodiscard]] std::uint64_t limit_for(std::uint64_t needed) const {
    const auto at = [&](std::uint64_t held, double part) { return limit.with(needed - std::min(needed, held), part); };
    if (!(least_share > 0)) return at(bytes, share);
    return std::max(at(bytes, share), at(std::uint64_t(double(limit.rest_bytes()) * least_share), least_share));
  }
};

}  // namespace bp
