#pragma once
#include <bit>
#include <cstdint>
#include <ranges>
#include <string_view>

#include "lib/store/content_hash.h"
#include "lib/store/fields.h"

/// XXH3-128 of a job's input, value by value.
namespace bp {

class KeyHash {
 public:
  /// `job` says what is done with the input. source_digest() is added, too.
  explicit KeyHash(std::string_view job);

  /// Adds values: numbers, enumerators, texts, optional values, lists of these, structs with all their members
  /// (fields.h), and objects that have add_to(KeyHash&). Nothing else compiles. Two sequences of values of the same
  /// types have the same key only if all values are the same. Numbers are compared by their bits.
  template <class... Values>
  KeyHash& add(const Values&... values) {
    (add_one(values), ...);
    return *this;
  }
  [[nodiscard]] ResultKey key() const { return hash_.value(); }

 private:
  void add_bytes(std::span<const std::byte> bytes);

  template <class T>
  void add_one(const T& value) {
    if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
      const auto word = std::int64_t(value);
      hash_.add(std::as_bytes(std::span(&word, 1)));
    } else if constexpr (std::is_same_v<T, double>) {
      add_one(std::bit_cast<std::int64_t>(value));
    } else if constexpr (std::is_convertible_v<const T&, std::string_view>) {
      const std::string_view text = value;
      add_bytes(std::as_bytes(std::span(text.data(), text.size())));
    } else if constexpr (std::is_convertible_v<const T&, std::span<const std::byte>>) {
      add_bytes(value);
    } else if constexpr (requires { value.add_to(*this); }) {
      value.add_to(*this);
    } else if constexpr (requires { value.has_value(); }) {
      add_one(value.has_value());
      if (value) add_one(*value);
    } else if constexpr (std::ranges::sized_range<T>) {
      add_one(std::ranges::size(value));
      for (const auto& element : value) add_one(element);
    } else {
      for_each_field(value, [&](const auto& member) { add_one(member); });
    }
  }

  ContentHash hash_;
};

}  // namespace bp
