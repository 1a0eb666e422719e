#pragma once
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "lib/core/error.h"

/// Structs of bp.h begin with their size, and may be those of an earlier or a later header.
namespace bp::api {

/// Fills a caller's struct of `size` bytes with `value`. Members that this version does not know become 0.
template <class T>
void put_struct(T* to, std::size_t size, T value) {
  if (to == nullptr) fail(ErrorCode::bad_argument, "a pointer to a result is NULL");
  if (size < sizeof(std::size_t)) fail(ErrorCode::bad_argument, "the size of a struct is {} bytes", size);
  value.size = size;
  std::memset(static_cast<void*>(to), 0, size);
  std::memcpy(static_cast<void*>(to), &value, std::min(size, sizeof(T)));
}

/// Returns a caller's options; members that the caller does not know are as in `defaults`. Null: `defaults`. Throws
/// bad_argument if the caller sets members that this version does not know.
template <class T>
[[nodiscard]] T take_struct(const T* from, const T& defaults, const char* name) {
  T out = defaults;
  if (from == nullptr) return out;
  const std::size_t size = from->size;
  if (size < sizeof(std::size_t) || size > (std::size_t(1) << 16))
    fail(ErrorCode::bad_argument, "{}: its size is {} bytes; set it by the function of its defaults", name, size);
  const char* const bytes = reinterpret_cast<const char*>(from);
  if (size > sizeof(T) && std::any_of(bytes + sizeof(T), bytes + size, [](char c) { return c != 0; }))
    fail(ErrorCode::bad_argument, "{}: sets members that libbp {} does not know", name, BP_VERSION);
  std::memcpy(static_cast<void*>(&out), from, std::min(size, sizeof(T)));
  out.size = sizeof(T);
  return out;
}

/// Returns an object that a caller must give. Throws bad_argument if it is null.
template <class T>
[[nodiscard]] T& needed(T* object, const char* name) {
  if (object == nullptr) fail(ErrorCode::bad_argument, "{} is NULL", name);
  return *object;
}

/// Returns whether a caller gives a list. Throws bad_argument if only one of its values and their number is given.
template <class T>
[[nodiscard]] bool is_list(const T* first, std::size_t count, const char* name, const char* name_of_count) {
  if (count > 0) (void)needed(first, name);
  if (count == 0 && first != nullptr)
    fail(ErrorCode::bad_argument, "{}: it is 0, and {} is set; give the number of its values", name_of_count, name);
  return count > 0;
}

/// Returns `value` as the enum of the library that has `count` values, numbered as in bp.h from `first`.
template <class E>
[[nodiscard]] E choice(std::int32_t value, std::int32_t count, const char* name, std::int32_t first = 0) {
  if (value < first || value >= first + count)
    fail(ErrorCode::bad_argument, "{}: {} is none of its values", name, value);
  return E(value - first);
}

}  // namespace bp::api
