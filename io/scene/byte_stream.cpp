#include "io/scene/byte_stream.h"

#include <cstring>

#include "lib/core/error.h"

namespace bp {

ByteStream::ByteStream(SceneFilePtr file, std::uint64_t offset)
    : file_(std::move(file)), buffer_(new std::byte[kBuffer]), begin_(offset) {}

void ByteStream::seek(std::uint64_t offset) {
  begin_ = offset;
  cur_ = end_ = 0;
}

void ByteStream::refill(std::size_t n) {
  const std::size_t kept = end_ - cur_;
  std::memmove(buffer_.get(), buffer_.get() + cur_, kept);
  begin_ += cur_;
  cur_ = 0;
  end_ = kept + file_->read_at(begin_ + kept, {buffer_.get() + kept, kBuffer - kept});
  if (end_ < n) fail_truncated();
}

void ByteStream::skip(std::uint64_t n) {
  if (n > remaining()) fail_truncated();
  if (n <= end_ - cur_) {
    cur_ += std::size_t(n);
  } else {
    seek(offset() + n);
  }
}

void check_data_end(const SceneFile& file, std::uint64_t end) {
  constexpr std::uint64_t kMostBlanks = 16;
  constexpr std::string_view kBlanks{"\0 \t\r\n\x1A", 6};
  char left[kMostBlanks + 1];
  const std::string_view rest(left, file.read_at(end, std::as_writable_bytes(std::span(left))));
  if (rest.size() > kMostBlanks || rest.find_first_not_of(kBlanks) != rest.npos)
    fail(ErrorCode::bad_input, "{}: byte {}: data begin that the header does not promise; is the file damaged?",
         file.name(), end);
}

void ByteStream::fail_truncated() const {
  fail(ErrorCode::bad_input, "{}: ends at byte {} in the middle of its data; the file is truncated", file_->name(),
       file_->size());
}

}  // namespace bp
