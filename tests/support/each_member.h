#pragma once
#include "lib/store/packing.h"

namespace bp::test {

/// Changes each number, enumerator and text in `value` in turn, calls `act()`, and changes it back.
template <class T, class Act>
void change_each_member(T& value, const Act& act) {
  if constexpr (std::is_same_v<T, std::string>) {
    value += 'x';
    act();
    value.pop_back();
  } else if constexpr (Plain<T>) {
    const T before = value;
    value = std::is_same_v<T, bool> ? T(!bool(before)) : T(double(before) + 1);
    act();
    value = before;
  } else {
    for_each_field(value, [&](auto& member) { change_each_member(member, act); });
  }
}

}  // namespace bp::test
