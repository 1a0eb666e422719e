#include "tests/fuzz/brick_stream_entry.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "tests/reference/brick_stream.h"

namespace fuzz {

namespace {

void require(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "brick stream: %s\n", what);
  std::abort();
}

/// The input as a file.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : fd_(::memfd_create("fuzz", 0)) {
    require(fd_ >= 0 && ::write(fd_, data, size) == ssize_t(size), "no memory file");
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", fd_); }

 private:
  int fd_;
};

bool equal(const bp::Brick& brick, const reference::Voxels& voxels) {
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if ((brick.bits[i / 64] >> (i % 64) & 1) != voxels[i]) return false;
  }
  return true;
}

}  // namespace

bool read_brick_stream(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  std::vector<bp::Brick> bricks;
  std::string checksum;
  try {
    bp::BrickReader reader(file.path());
    bp::Brick brick;
    while (reader.read(brick)) bricks.push_back(brick);
    checksum = reader.totals().checksum();
  } catch (const bp::Error& e) {
    require(e.code() == bp::ErrorCode::bad_input, e.what());
    return false;
  }
  const reference::StreamFile expected = reference::read_stream({data, data + size});
  require(expected.checksum == checksum, "the checksum differs from the reference");
  require(expected.bricks.size() == bricks.size(), "the number of bricks differs from the reference");
  for (const bp::Brick& b : bricks) {
    const auto found = expected.bricks.find({int(b.layer), b.coord.x, b.coord.y, b.coord.z});
    require(found != expected.bricks.end() && equal(b, found->second), "a brick differs from the reference");
  }
  return true;
}

}  // namespace fuzz
