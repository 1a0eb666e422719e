#include "lib/store/page_block.h"

#include <sys/mman.h>

#include <new>

namespace bp {

namespace {
constexpr std::size_t kLeastMapped = 32768;
}

PageBlock::PageBlock(std::size_t bytes) : bytes_(bytes) {
  if (bytes >= kLeastMapped) {
    void* const pages = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mapped_ = pages != MAP_FAILED;
    if (mapped_) data_ = static_cast<std::byte*>(pages);
  }
  if (!mapped_) data_ = static_cast<std::byte*>(::operator new(bytes));
}

void PageBlock::release() noexcept {
  if (mapped_) {
    ::munmap(data_, bytes_);
  } else {
    ::operator delete(data_);
  }
}

}  // namespace bp
