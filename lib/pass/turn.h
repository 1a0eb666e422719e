#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// Jobs that run at the same time and keep results in one store share the work that all of them need. Each job does
/// it in an order of its own, and looks once more for the result of an item just before it makes it. So n jobs make
/// each item about once, and none of them needs to know of the others.
namespace bp {

/// Puts items into the order of a turn, the same on each call. Turn 0 leaves them as they are.
template <class T>
void put_in_turn(std::vector<T>& items, std::uint64_t turn) {
  if (turn == 0) return;
  std::uint64_t state = turn;
  for (std::size_t left = items.size(); left > 1; --left) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;  // splitmix64
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    std::swap(items[left - 1], items[std::size_t((z ^ (z >> 31)) % left)]);
  }
}

}  // namespace bp
