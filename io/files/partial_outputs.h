#pragma once
#include <signal.h>

#include <string>

/// Names of outputs that are being made, so that a signal handler can remove them. A fixed table without locks:
/// everything here is safe in a signal handler and on any thread.
namespace bp {

/// Keeps `name` in the table while it lives. With the table full (256 names at once) or a name beyond PATH_MAX it does
/// nothing.
class PartialOutput {
 public:
  /// What is removed: a file; a folder and all that is in it; a folder if nothing is in it.
  enum class Kind { file, tree, folder };

  PartialOutput() = default;
  explicit PartialOutput(const std::string& name, Kind kind = Kind::file);
  ~PartialOutput();
  PartialOutput(PartialOutput&& other) noexcept;
  PartialOutput& operator=(PartialOutput&& other) noexcept;

 private:
  int slot_ = -1;
};

/// While it lives, nothing is removed: what is made has its name in the table before a signal handler looks for it. To
/// be held for a few system calls, without taking memory: a signal waits for it (end_making()).
class WhileMaking {
 public:
  WhileMaking();  ///< never returns once making has ended: this thread waits for the end of the process
  ~WhileMaking();
  WhileMaking(const WhileMaking&) = delete;
  WhileMaking& operator=(const WhileMaking&) = delete;

 private:
  sigset_t before_{};  ///< signals that this thread held back
};

/// For the handler of a signal that ends the process, before remove_partial_outputs(): waits until no thread makes
/// anything, and lets none begin. After a second it goes on, so that a file system that hangs holds no signal up.
void end_making() noexcept;
[[nodiscard]] bool making_has_ended() noexcept;

/// Removes everything in the table: files, trees, then folders. Does nothing in a child process, which inherits the
/// table but owns nothing in it.
void remove_partial_outputs() noexcept;

}  // namespace bp
