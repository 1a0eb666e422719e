#include "io/partial_outputs.h"

#include <limits.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <utility>

namespace bp {

namespace {

enum State : int { vacant, claimed, named };
struct Slot {
  std::atomic<int> state{vacant};
  pid_t owner = 0;
  char name[PATH_MAX];
};
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers take no locks");

std::array<Slot, 64> g_slots;  // global because a signal handler has no other way to it

}  // namespace

PartialOutput::PartialOutput(const std::string& name) {
  if (name.size() >= PATH_MAX) return;
  for (std::size_t i = 0; i < g_slots.size(); ++i) {
    int expected = vacant;
    if (!g_slots[i].state.compare_exchange_strong(expected, claimed)) continue;
    std::memcpy(g_slots[i].name, name.c_str(), name.size() + 1);
    g_slots[i].owner = ::getpid();
    g_slots[i].state = named;
    slot_ = int(i);
    return;
  }
}

PartialOutput::~PartialOutput() {
  if (slot_ >= 0) g_slots[std::size_t(slot_)].state = vacant;
}

PartialOutput::PartialOutput(PartialOutput&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

PartialOutput& PartialOutput::operator=(PartialOutput&& other) noexcept {
  std::swap(slot_, other.slot_);
  return *this;
}

void remove_partial_outputs() noexcept {
  for (Slot& slot : g_slots) {
    if (slot.state == named && slot.owner == ::getpid()) ::unlink(slot.name);
  }
}

}  // namespace bp
