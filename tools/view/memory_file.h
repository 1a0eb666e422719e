#pragma once
#include <span>
#include <string>

namespace bp {

/// A file without a name, in memory. It ends with the last process that has it open, whatever happens. Tools that
/// bpview starts read and write it by its path.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::byte> bytes = {});  ///< throws out_of_resource
  explicit MemoryFile(const std::string& text);
  ~MemoryFile();
  MemoryFile(MemoryFile&& other) noexcept;
  MemoryFile& operator=(MemoryFile&& other) noexcept;

  [[nodiscard]] int descriptor() const { return fd_; }
  [[nodiscard]] std::string path() const;   ///< valid in this process, and in processes that inherit the descriptor
  [[nodiscard]] std::string bytes() const;  ///< the whole content

 private:
  int fd_ = -1;
};

}  // namespace bp
