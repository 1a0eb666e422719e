#pragma once
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <span>

#include "io/files/write_signals.h"

namespace bp::detail {

/// Writes all bytes; returns false, with errno set, if that fails.
inline bool write_all(int fd, std::span<const std::byte> bytes) {
  const NoWriteSignals as_errors;
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(std::size_t(n));
  }
  return true;
}

}  // namespace bp::detail
