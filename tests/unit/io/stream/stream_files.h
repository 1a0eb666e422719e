#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/stream/brick_stream.h"

/// Streams for tests, as bytes.
namespace stream_files {

using Bytes = std::vector<unsigned char>;

/// A file in memory with these bytes.
class TempFile {
 public:
  explicit TempFile(const Bytes& bytes = {});
  ~TempFile();
  TempFile(const TempFile&) = delete;
  TempFile& operator=(const TempFile&) = delete;
  void assign(const Bytes& bytes);
  [[nodiscard]] Bytes bytes() const;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  int fd_;
  std::string path_;
};

/// A name in a new folder, for an output; all of it is gone when this goes.
class StreamFolder {
 public:
  StreamFolder();
  ~StreamFolder();
  StreamFolder(const StreamFolder&) = delete;
  StreamFolder& operator=(const StreamFolder&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] Bytes bytes() const;

 private:
  std::string path_, folder_;
};

bp::StreamHeader random_header(std::uint32_t seed);
/// The bounds of a scene that fills the header's brick box.
void fit_bounds(bp::StreamHeader& header);
/// Non-empty bricks in slab order, mixed of several kinds and full.
std::vector<bp::Brick> random_bricks(const bp::StreamHeader& header, std::uint32_t seed, int count);
/// A header and one mixed brick: a few hundred bytes.
bp::StreamHeader small_header();
std::vector<bp::Brick> small_bricks();

Bytes written(const bp::StreamHeader& header, const std::vector<bp::Brick>& bricks, int level = 1);

struct Content {
  bp::StreamHeader header;
  std::vector<bp::Brick> bricks;
  bp::StreamTotals totals;
};
Content read_back(const Bytes& bytes);     ///< throws bp::Error
std::string error_of(const Bytes& bytes);  ///< empty if it reads; the code must be bad_input
bool same(const bp::Brick& a, const bp::Brick& b);
bool same(const std::vector<bp::Brick>& a, const std::vector<bp::Brick>& b);

}  // namespace stream_files
