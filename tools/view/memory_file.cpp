#include "tools/view/memory_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "lib/core/error.h"

namespace bp {

namespace {

[[noreturn]] void refuse() {
  fail(ErrorCode::out_of_resource, "cannot keep a file in memory: {}", std::strerror(errno));
}

}  // namespace

MemoryFile::MemoryFile(std::span<const std::byte> bytes) : fd_(::memfd_create("bpview", MFD_CLOEXEC)) {
  if (fd_ < 0) refuse();
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) refuse();
    bytes = bytes.subspan(std::size_t(n));
  }
}

MemoryFile::MemoryFile(const std::string& text) : MemoryFile(std::as_bytes(std::span(text))) {}

MemoryFile::~MemoryFile() {
  if (fd_ >= 0) ::close(fd_);
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

MemoryFile& MemoryFile::operator=(MemoryFile&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

std::string MemoryFile::path() const {
  return fmt::format("/proc/self/fd/{}", fd_);
}

std::string MemoryFile::bytes() const {
  struct stat info {};
  if (::fstat(fd_, &info) != 0) refuse();
  std::string all(std::size_t(info.st_size), '\0');
  std::size_t done = 0;
  while (done < all.size()) {
    const ssize_t n = ::pread(fd_, all.data() + done, all.size() - done, off_t(done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += std::size_t(n);
  }
  all.resize(done);
  return all;
}

}  // namespace bp
