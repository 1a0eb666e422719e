#pragma once
#include <cstddef>
#include <type_traits>

/// Visits all members of a struct, in their order. So code that visits them forgets none: a struct of more than 12
/// members, or one that is not an aggregate, does not compile.
namespace bp {

namespace detail {

/// Converts to a member of any type.
struct AnyField {
  template <class T>
  operator T() const;  // NOLINT(google-explicit-constructor)
};

template <class T, class... Fields>
constexpr std::size_t field_count() {
  if constexpr (requires { T{Fields{}..., AnyField{}}; }) {
    return field_count<T, Fields..., AnyField>();
  } else {
    return sizeof...(Fields);
  }
}

}  // namespace detail

template <class T>
constexpr std::size_t kFieldCount = detail::field_count<std::remove_const_t<T>>();

/// Calls act(members...), or act(elements...) for a std::array. Built-in arrays are not allowed among the members.
template <class T, class Act>
decltype(auto) with_fields(T& s, Act&& act) {
  static_assert(std::is_aggregate_v<std::remove_const_t<T>>, "only structs without constructors have fields");
  constexpr std::size_t n = kFieldCount<T>;
  static_assert(n >= 1 && n <= 13, "with_fields() knows structs of 1 to 13 members");
  if constexpr (n == 1) {
    auto& [a] = s;
    return act(a);
  } else if constexpr (n == 2) {
    auto& [a, b] = s;
    return act(a, b);
  } else if constexpr (n == 3) {
    auto& [a, b, c] = s;
    return act(a, b, c);
  } else if constexpr (n == 4) {
    auto& [a, b, c, d] = s;
    return act(a, b, c, d);
  } else if constexpr (n == 5) {
    auto& [a, b, c, d, e] = s;
    return act(a, b, c, d, e);
  } else if constexpr (n == 6) {
    auto& [a, b, c, d, e, f] = s;
    return act(a, b, c, d, e, f);
  } else if constexpr (n == 7) {
    auto& [a, b, c, d, e, f, g] = s;
    return act(a, b, c, d, e, f, g);
  } else if constexpr (n == 8) {
    auto& [a, b, c, d, e, f, g, h] = s;
    return act(a, b, c, d, e, f, g, h);
  } else if constexpr (n == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = s;
    return act(a, b, c, d, e, f, g, h, i);
  } else if constexpr (n == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = s;
    return act(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (n == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = s;
    return act(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (n == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = s;
    return act(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (n == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = s;
    return act(a, b, c, d, e, f, g, h, i, j, k, l, m);
  }
}

/// Calls act(member) for each member.
template <class T, class Act>
void for_each_field(T& s, Act&& act) {
  with_fields(s, [&](auto&... members) { (act(members), ...); });
}

}  // namespace bp
