#pragma once
#include <signal.h>

#include <string>

/// The names of outputs in progress, so that a signal handler can remove them. A fixed table without locks: everything
/// here is safe in a signal handler and on any thread.
namespace bp {

/// Keeps `name` in the table while this object lives. Does nothing if the table is full (256 names at once) or the name
/// is longer than PATH_MAX.
class PartialOutput {
 public:
  /// The kinds of entries to remove: a file; a folder with all that is in it; a folder only if it is empty.
  enum class Kind { file, tree, folder };

  PartialOutput() = default;
  explicit PartialOutput(const std::string& name, Kind kind = Kind::file);
  ~PartialOutput();
  PartialOutput(PartialOutput&& other) noexcept;
  PartialOutput& operator=(PartialOutput&& other) noexcept;

 private:
  int slot_ = -1;
};

/// While this object lives, nothing is removed, so that a new file has its name in the table before a signal handler
/// looks for it. To be held for a few system calls, without allocating: a signal waits for it (end_making()).
class WhileMaking {
 public:
  WhileMaking();  ///< never returns once making has ended: the thread waits for the end of the process
  ~WhileMaking();
  WhileMaking(const WhileMaking&) = delete;
  WhileMaking& operator=(const WhileMaking&) = delete;

 private:
  sigset_t before_{};  ///< signals that this thread held back before
};

/// For the handler of a signal that ends the process, before remove_partial_outputs(): waits until no thread makes
/// anything, and lets none begin. Gives up after a second, so that a hanging file system does not hold the signal up.
void end_making() noexcept;
[[nodiscard]] bool making_has_ended() noexcept;

/// Removes all entries of the table: files, trees, then folders. Does nothing in a child process, which inherits the
/// table but owns nothing in it.
void remove_partial_outputs() noexcept;

}  // namespace bp
