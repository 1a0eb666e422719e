#pragma once
#include <cstddef>
#include <utility>

/// A block of some ten kilobytes or more that comes straight from the system and goes back to it at once. If blocks are
/// made on one thread and released on another by the hundred thousand, the heap would keep holes for both, and the peak
/// would grow with their number.
namespace bp {

class PageBlock {
 public:
  PageBlock() = default;
  explicit PageBlock(std::size_t bytes);  ///< throws std::bad_alloc; about 2 us and a page fault for each 4 KiB used
  ~PageBlock() { release(); }
  PageBlock(PageBlock&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        bytes_(std::exchange(other.bytes_, 0)),
        mapped_(std::exchange(other.mapped_, false)) {}
  PageBlock& operator=(PageBlock&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    std::swap(mapped_, other.mapped_);
    return *this;
  }

  [[nodiscard]] std::byte* data() const { return data_; }  ///< aligned as operator new aligns
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  void release() noexcept;
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
  bool mapped_ = false;  ///< false: from the heap, since the block is small or the system has no mapping left
};

}  // namespace bp
