#include "io/files/partial_outputs.h"

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <time.h>
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
  PartialOutput::Kind kind = PartialOutput::Kind::file;
  char name[PATH_MAX];
};
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers take no locks");

// Global, since signal handlers can reach nothing else.
std::array<Slot, 256> g_slots;
std::atomic<int> g_makers{0};
std::atomic<bool> g_ended{false};
static_assert(std::atomic<bool>::is_always_lock_free);

bool remove_at(int parent, const char* name);

/// Removes the entries of a folder. Repeats until none is found, since other threads may still add some. Uses no
/// opendir() and readdir(), which allocate memory, as a signal handler must not.
void remove_entries(int folder) {
  alignas(dirent64) char buffer[2048];
  for (bool again = true; again;) {
    again = false;
    ::lseek(folder, 0, SEEK_SET);
    for (ssize_t size = 0; (size = ::getdents64(folder, buffer, sizeof buffer)) > 0;) {
      for (ssize_t at = 0; at < size;) {
        const auto* entry = reinterpret_cast<const dirent64*>(buffer + at);
        at += entry->d_reclen;
        if (std::strcmp(entry->d_name, ".") == 0 || std::strcmp(entry->d_name, "..") == 0) continue;
        again = remove_at(folder, entry->d_name) || again;
      }
    }
  }
}

bool remove_at(int parent, const char* name) {
  if (::unlinkat(parent, name, 0) == 0) return true;
  const int folder = ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return false;
  remove_entries(folder);
  ::close(folder);
  return ::unlinkat(parent, name, AT_REMOVEDIR) == 0;
}

/// Removes all entries of a kind; returns whether something was removed.
bool remove_all_of(PartialOutput::Kind kind) {
  bool any = false;
  for (Slot& slot : g_slots) {
    if (slot.state != named || slot.owner != ::getpid() || slot.kind != kind) continue;
    any = (kind == PartialOutput::Kind::folder ? ::rmdir(slot.name) == 0 : remove_at(AT_FDCWD, slot.name)) || any;
  }
  return any;
}

}  // namespace

PartialOutput::PartialOutput(const std::string& name, Kind kind) {
  if (name.size() >= PATH_MAX) return;
  for (std::size_t i = 0; i < g_slots.size(); ++i) {
    int expected = vacant;
    if (!g_slots[i].state.compare_exchange_strong(expected, claimed)) continue;
    std::memcpy(g_slots[i].name, name.c_str(), name.size() + 1);
    g_slots[i].owner = ::getpid();
    g_slots[i].kind = kind;
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

/// Holds signals back: a handler on this thread would wait for the thread itself. In the order of all atomics, either
/// the count comes first, and end_making() waits for this thread, or the end comes first, and this thread stops here.
WhileMaking::WhileMaking() {
  sigset_t ending;
  sigemptyset(&ending);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, number);
  ::pthread_sigmask(SIG_BLOCK, &ending, &before_);
  ++g_makers;
  if (!g_ended) return;
  --g_makers;
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  while (true) ::pause();
}

WhileMaking::~WhileMaking() {
  --g_makers;
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void end_making() noexcept {
  g_ended = true;
  const timespec millisecond{0, 1000000};
  for (int i = 0; i < 1000 && g_makers > 0; ++i) ::nanosleep(&millisecond, nullptr);
}

bool making_has_ended() noexcept {
  return g_ended;
}

void remove_partial_outputs() noexcept {
  remove_all_of(PartialOutput::Kind::file);
  remove_all_of(PartialOutput::Kind::tree);
  while (remove_all_of(PartialOutput::Kind::folder)) {  // a folder can be removed once those below it are gone
  }
}

}  // namespace bp
