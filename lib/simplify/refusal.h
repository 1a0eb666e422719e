#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

/// Reasons why a change of a mesh was refused, and counts of them.
namespace bp {

/// The test that failed, in the order of the tests.
enum class Refusal : std::uint8_t { none, link, constraints, shape, growth, length, enclosed, guard, limits, error };
constexpr std::size_t kRefusalCount = std::size_t(Refusal::error) + 1;

/// The names in reports.
constexpr std::array<const char*, kRefusalCount> kRefusalNames{"none",   "link",     "constraints", "shape",  "growth",
                                                               "length", "enclosed", "guard",       "limits", "error"};

/// A count for each reason.
class Refusals {
 public:
  [[nodiscard]] std::uint64_t operator[](Refusal why) const { return counts_[std::size_t(why)]; }
  std::uint64_t& operator[](Refusal why) { return counts_[std::size_t(why)]; }
  Refusals& operator+=(const Refusals& more) {
    for (std::size_t i = 0; i < kRefusalCount; ++i) counts_[i] += more.counts_[i];
    return *this;
  }
  Refusals& operator-=(const Refusals& fewer) {
    for (std::size_t i = 0; i < kRefusalCount; ++i) counts_[i] -= fewer.counts_[i];
    return *this;
  }
  /// Calls act(why, name, count) for each reason but `none`.
  template <typename Act>
  void for_each(Act&& act) const {
    for (std::size_t i = 1; i < kRefusalCount; ++i) act(Refusal(i), kRefusalNames[i], counts_[i]);
  }

 private:
  std::array<std::uint64_t, kRefusalCount> counts_{};
};

}  // namespace bp
