#pragma once
#include <string>

/// Names of output files that are being written, so that a signal handler can remove them. A fixed table without locks:
/// everything here is safe in a signal handler and on any thread.
namespace bp {

/// Keeps `name` in the table while it lives. With the table full (64 files at once) or a name beyond PATH_MAX it does
/// nothing.
class PartialOutput {
 public:
  PartialOutput() = default;
  explicit PartialOutput(const std::string& name);
  ~PartialOutput();
  PartialOutput(PartialOutput&& other) noexcept;
  PartialOutput& operator=(PartialOutput&& other) noexcept;

 private:
  int slot_ = -1;
};

/// Unlinks every file in the table. Does nothing in a child process, which inherits the table but owns no file.
void remove_partial_outputs() noexcept;

}  // namespace bp
