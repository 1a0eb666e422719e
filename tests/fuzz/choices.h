#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

/// Decisions of a generator, taken from the bytes of a fuzzer. Where the bytes end, every further decision is the
/// plainest one: the first of a list, "no", 0. So short inputs are simple, and a byte changed changes one decision.
namespace fuzz {

class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : next_(data), left_(size) {}

  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *next_++;
  }
  /// 0 to n - 1, for n up to 2^16.
  std::uint32_t below(std::uint32_t n) {
    const std::uint32_t low = byte();
    return (n > 256 ? low | std::uint32_t(byte()) << 8 : low) % n;
  }
  /// True once in n times, n at most 256.
  bool once_in(std::uint32_t n) { return byte() % n == n - 1; }
  template <class T>
  T of(const std::vector<T>& list) {
    return list[below(std::uint32_t(list.size()))];
  }
  template <class T>
  T of(std::initializer_list<T> list) {
    return list.begin()[below(std::uint32_t(list.size()))];
  }
  /// Any value of sizeof(T) bytes.
  template <class T>
  T raw() {
    std::uint8_t bytes[sizeof(T)];
    for (std::uint8_t& b : bytes) b = byte();
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  /// Returns all remaining bytes.
  std::string rest() {
    std::string text(reinterpret_cast<const char*>(next_), left_);
    left_ = 0;
    return text;
  }

 private:
  const std::uint8_t* next_;
  std::size_t left_;
};

/// Returns 0 to n - 1, from a hash of all bytes: a fuzzer that changes any of them rolls again, so that it cannot
/// prefer slow choices.
std::uint32_t roll(const std::uint8_t* data, std::size_t size, std::uint32_t n);
/// A number at a limit of something: of doubles, floats, integers, the exact predicates or the grid; or any double.
double extreme_number(Choices& choices);
/// As extreme_number(), for whole numbers.
std::int64_t extreme_integer(Choices& choices);
/// As text, also in forms that no number has.
std::string extreme_text(Choices& choices);
/// As a C++ or JSON literal; "nan" and "inf" are none in JSON.
std::string text_of(double value);

}  // namespace fuzz
