#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "io/files/file.h"
#include "lib/grid/stream.h"

/// Reader and writer of the brick stream (docs/brick-stream.md).
namespace bp {

struct LayerTotals {
  std::uint64_t bricks = 0, full = 0, voxels = 0;  ///< non-empty bricks, full ones among them, occupied voxels
  friend bool operator==(const LayerTotals&, const LayerTotals&) = default;
};

/// The totals of a stream, as its end record has them.
struct StreamTotals {
  std::array<LayerTotals, 2> layers{};  ///< by Layer
  /// Checksum of the content: layer, coordinate and voxels of each brick.
  std::uint64_t checksum_low = 0, checksum_high = 0;
  std::uint64_t bytes = 0;  ///< size of the stream; not part of the content

  [[nodiscard]] std::string checksum() const;  ///< 32 hexadecimal digits; independent of order, tiling, compression
  void add(const StreamTotals& t);             ///< counts and checksum of disjoint parts
  friend bool operator==(const StreamTotals&, const StreamTotals&) = default;
};

/// Reads a stream, in one pass, some batches ahead in parallel. Checks everything: damage of any kind is bad_input with
/// the byte offset and, if there is one, the brick. Memory: about 2 MiB for each thread, at most 20 MiB.
class BrickReader final : public BrickSource {
 public:
  explicit BrickReader(const std::string& path);  ///< "-" is stdin; reads the header
  ~BrickReader() override;

  [[nodiscard]] const StreamHeader& header() const override;
  bool read(Brick& out) override;
  [[nodiscard]] const StreamTotals& totals() const;  ///< totals so far; complete once read() has returned false

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a stream; the same bricks and header give the same bytes, for any number of threads. Memory as the reader,
/// and 24 bytes a slab. Call finish(), then commit the file. Throws `failed` if bricks come out of order or outside of
/// the box.
class BrickWriter final : public BrickSink {
 public:
  /// Writes the header. `level` is zstd's; 1 writes some 600 MB/s of bricks per core at 10 to 40 to 1, higher levels
  /// gain little. Throws bad_argument if the header is out of the format's range.
  BrickWriter(OutputFile& out, const StreamHeader& header, int level = 1);
  ~BrickWriter() override;

  void write(const Brick& brick) override;
  void finish() override;
  [[nodiscard]] const StreamTotals& totals() const;  ///< valid after finish()

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
