#pragma once
#include "io/scene/scene_file.h"

/// Consecutive bytes of a file, one buffer at a time.
namespace bp {

/// Throws bad_input if more than a few blanks, with which some programs fill up, follow the data of a binary file.
void check_data_end(const SceneFile& file, std::uint64_t end);

class ByteStream {
 public:
  static constexpr std::size_t kMaxTake = std::size_t(1) << 16;

  explicit ByteStream(SceneFilePtr file, std::uint64_t offset = 0);

  void seek(std::uint64_t offset);
  [[nodiscard]] std::uint64_t offset() const { return begin_ + cur_; }
  [[nodiscard]] std::uint64_t remaining() const { return file_->size() - std::min(file_->size(), offset()); }

  /// Returns the next n <= kMaxTake bytes, valid until the next call. Throws bad_input if the file ends before them.
  const std::byte* take(std::size_t n) {
    if (n > end_ - cur_) refill(n);
    cur_ += n;
    return buffer_.get() + cur_ - n;
  }
  /// Skips n bytes. Throws bad_input if the file ends before them.
  void skip(std::uint64_t n);
  [[noreturn]] void fail_truncated() const;
  [[nodiscard]] const SceneFile& file() const { return *file_; }

 private:
  static constexpr std::size_t kBuffer = std::size_t(1) << 18;
  void refill(std::size_t n);

  SceneFilePtr file_;
  std::unique_ptr<std::byte[]> buffer_;
  std::uint64_t begin_ = 0;
  std::size_t cur_ = 0, end_ = 0;
};

}  // namespace bp
