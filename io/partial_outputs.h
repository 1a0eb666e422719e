#pragma once
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

/// Removes everything in the table: files, trees, then folders. Does nothing in a child process, which inherits the
/// table but owns nothing in it.
void remove_partial_outputs() noexcept;

}  // namespace bp
