#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "lib/store/fields.h"

/// Packs values into bytes and back: numbers and enumerators as they lie in memory, strings and vectors with their
/// length, optional values, structs member by member (fields.h). Little-endian, as all machines that we run on.
namespace bp {

/// A number or an enumerator.
template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
/// A string or vector.
template <class T>
concept Sized = requires(T v) {
  v.resize(v.size());
};

/// std::optional.
template <class T>
concept Optional = requires(T v) {
  v.has_value();
  v.emplace();
};

template <class T>
void pack(std::string& out, const T& value) {
  if constexpr (Plain<T>) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  } else if constexpr (Sized<T>) {
    pack(out, std::uint64_t(value.size()));
    if constexpr (Plain<typename T::value_type>) {
      out.append(reinterpret_cast<const char*>(value.data()), value.size() * sizeof(typename T::value_type));
    } else {
      for (const auto& element : value) pack(out, element);
    }
  } else if constexpr (Optional<T>) {
    pack(out, value.has_value());
    if (value) pack(out, *value);
  } else {
    for_each_field(value, [&](const auto& member) { pack(out, member); });
  }
}

/// Takes a value off the front of `in`. Returns false if there are too few bytes; `value` is unspecified then.
template <class T>
[[nodiscard]] bool unpack(std::string_view& in, T& value) {
  if constexpr (Plain<T>) {
    if (in.size() < sizeof value) return false;
    std::memcpy(&value, in.data(), sizeof value);
    in.remove_prefix(sizeof value);
    return true;
  } else if constexpr (Sized<T>) {
    using Element = typename T::value_type;
    std::uint64_t size = 0;
    if (!unpack(in, size) || size > in.size() / (Plain<Element> ? sizeof(Element) : 1)) return false;
    value.resize(size);
    if constexpr (Plain<Element>) {
      if (size > 0) std::memcpy(value.data(), in.data(), size * sizeof(Element));
      in.remove_prefix(size * sizeof(Element));
      return true;
    } else {
      return std::all_of(value.begin(), value.end(), [&](Element& element) { return unpack(in, element); });
    }
  } else if constexpr (Optional<T>) {
    bool there = false;
    value.reset();
    return unpack(in, there) && (!there || unpack(in, value.emplace()));
  } else {
    return with_fields(value, [&](auto&... members) { return (unpack(in, members) && ...); });
  }
}

}  // namespace bp
