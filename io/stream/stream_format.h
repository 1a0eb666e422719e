#pragma once
#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/stream/brick_stream.h"
#include "io/stream/stream_layout.h"

/// Bytes of the brick stream (docs/brick-stream.md): header, records, end record.
namespace bp::detail {

[[nodiscard]] std::uint64_t hash64(std::span<const std::byte> bytes);

struct FreeHashState {
  void operator()(void* state) const;
};
/// XXH3-64 of bytes that come in pieces.
class Digest {
 public:
  Digest();
  void add(std::span<const std::byte> bytes);
  [[nodiscard]] std::uint64_t hash() const;

 private:
  std::unique_ptr<void, FreeHashState> state_;
};

/// Returns the number of batches that are compressed or decompressed at a time. No result depends on it.
[[nodiscard]] std::size_t batches_ahead();

/// Wraps a payload in a skippable frame. `sealed`: the hash of the payload is appended first.
[[nodiscard]] std::vector<std::byte> frame_of(std::vector<std::byte> payload, bool sealed);
/// Returns whether a payload of at least kHashBytes ends with the hash of the bytes before.
[[nodiscard]] bool seal_holds(std::span<const std::byte> payload);

/// Returns the payload of the header, without hash. Throws bad_argument if the header is out of range.
[[nodiscard]] std::vector<std::byte> encode_header(const StreamHeader& header);
/// Decodes a payload whose sizes, version and hash were checked. Throws bad_input with the field.
[[nodiscard]] StreamHeader decode_header(std::span<const std::byte> payload, const std::string& name);

struct Record {
  BrickCoord coord;
  Layer layer = Layer::solid;
  BrickFill fill = BrickFill::empty;
};
void put_record(ByteSink& sink, const Record& record);
[[nodiscard]] bool before(int slab_axis, const Record& a, const Record& b);  ///< the order of the stream

/// Returns counts and content checksum of records. `planes`: the 32768 bytes of each mixed record, one after the other.
[[nodiscard]] StreamTotals total(std::span<const Record> records, std::span<const std::byte> planes);

/// One slab of the index.
struct IndexEntry {
  std::int32_t slab = 0;
  std::uint32_t batches = 0;
  std::uint64_t offset = 0, records = 0;
};
void put_index_entry(ByteSink& sink, const IndexEntry& entry);

/// The index of a stream (docs/brick-stream.md, section 8), made batch by batch. It is compared by its hash, since a
/// copy could be large.
class SlabIndex {
 public:
  void add(std::int32_t slab, std::uint64_t offset, std::uint64_t records);
  void end();  ///< ends the slab in progress, if it has a batch
  [[nodiscard]] std::uint32_t slabs() const { return slabs_; }
  [[nodiscard]] std::uint64_t hash() const { return digest_.hash(); }

 private:
  IndexEntry last_;
  std::uint32_t slabs_ = 0;
  Digest digest_;
};

[[nodiscard]] std::vector<std::byte> encode_end(const StreamTotals& totals, std::uint64_t index_offset,
                                                std::uint64_t bytes);

}  // namespace bp::detail
