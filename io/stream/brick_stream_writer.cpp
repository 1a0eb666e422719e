// docs/brick-stream.md is the specification; section numbers below are its own.
#include <algorithm>
#include <optional>

#include "io/stream/brick_stream.h"
#include "io/stream/stream_format.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"

namespace bp {

using namespace detail;

namespace {

/// A batch that is being written.
struct OutBatch {
  std::vector<Record> records;
  std::vector<BrickBits> mixed;
  std::vector<std::byte> raw, packed;
  StreamTotals totals;
  SideWork encoding;

  [[nodiscard]] bool full() const { return records.size() == kMaxRecords || mixed.size() == kMaxMixed; }
};

/// Encodes a batch (section 6).
void encode(OutBatch& batch, int level) {
  ByteSink heads;
  for (const Record& r : batch.records) put_record(heads, r);
  const std::size_t head_bytes = heads.bytes().size();
  batch.raw.resize(head_bytes + batch.mixed.size() * kBrickBytes);
  std::copy(heads.bytes().begin(), heads.bytes().end(), batch.raw.begin());
  const std::span<std::byte> planes = std::span(batch.raw).subspan(head_bytes);
  for (std::size_t i = 0; i < batch.mixed.size(); ++i) to_planes(batch.mixed[i], planes.data() + i * kBrickBytes);
  compress(batch.raw, level, true, batch.packed);
  batch.totals = total(batch.records, planes);
}

/// Returns the head of a batch (section 5).
std::vector<std::byte> head_of(const OutBatch& batch) {
  ByteSink head;
  head.put_text(kBatchTag);
  head.put(std::uint32_t(batch.records.size()));
  head.put(std::uint32_t(batch.raw.size()));
  head.put(std::uint32_t(batch.packed.size()));
  head.put_coord(batch.records.front().coord);
  head.put_coord(batch.records.back().coord);
  return frame_of(std::move(head.bytes()), false);
}

}  // namespace

struct BrickWriter::State {
  OutputFile& file;
  StreamHeader header;
  int level;
  std::uint64_t bytes = 0;
  std::vector<OutBatch> batches = std::vector<OutBatch>(batches_ahead());  // a ring; kept, with their memory
  std::size_t filling = 0;  // the batch that gets bricks; those after it are being encoded, the oldest first
  std::optional<Record> previous;
  std::vector<IndexEntry> slabs;
  StreamTotals totals;
  bool finished = false;

  void write(std::span<const std::byte> block) {
    file.write(block);
    bytes += block.size();
  }
  void check(const Record& record) const;
  void next_batch();
  void write_batch(OutBatch& batch);
};

void BrickWriter::State::check(const Record& r) const {
  const auto refuse = [&](const char* why) {
    fail(ErrorCode::failed, "{}: brick ({},{},{}) of layer {} {}", file.name(), r.coord.x, r.coord.y, r.coord.z,
         int(r.layer), why);
  };
  if (finished) refuse("comes after the end of the stream");
  if (!header.bricks.contains(r.coord)) refuse("lies outside the brick box of the header");
  if (r.layer != Layer::solid && !(header.has_closing && r.layer == Layer::closing)) refuse("is not in the header");
  if (previous && !before(header.slab_axis, *previous, r)) refuse("is out of order");
}

/// Closes the batch that is being filled, and makes room for the next. Where batches are cut depends only on the
/// bricks.
void BrickWriter::State::next_batch() {
  OutBatch& full = batches[filling];
  if (!full.records.empty()) full.encoding.begin([&full, l = level] { encode(full, l); });
  filling = (filling + 1) % batches.size();
  write_batch(batches[filling]);
}

/// Writes a closed batch, and empties it. Does nothing if it has no bricks.
void BrickWriter::State::write_batch(OutBatch& batch) {
  if (batch.records.empty()) return;
  batch.encoding.wait();
  const std::int32_t slab = batch.records.front().coord[header.slab_axis];
  if (slabs.empty() || slabs.back().slab != slab) slabs.push_back({slab, 0, bytes, 0});
  ++slabs.back().batches;
  slabs.back().records += batch.records.size();
  write(head_of(batch));
  write(batch.packed);
  totals.add(batch.totals);
  batch.records.clear();
  batch.mixed.clear();
}

BrickWriter::BrickWriter(OutputFile& out, const StreamHeader& header, int level)
    : state_(new State{.file = out, .header = header, .level = level, .previous = {}, .slabs = {}, .totals = {}}) {
  state_->write(frame_of(encode_header(header), true));
}
BrickWriter::~BrickWriter() = default;

void BrickWriter::write(const Brick& brick) {
  State& s = *state_;
  Record record{brick.coord, brick.layer, brick.fill};
  // A brick that is passed as mixed, but is empty or full, is stored as empty or full.
  if (brick.fill == BrickFill::mixed) record.fill = classify(brick.bits);
  if (record.fill == BrickFill::empty) return;
  s.check(record);
  const bool new_slab = s.previous && s.previous->coord[s.header.slab_axis] != brick.coord[s.header.slab_axis];
  if (new_slab || s.batches[s.filling].full()) s.next_batch();
  OutBatch& batch = s.batches[s.filling];
  batch.records.push_back(record);
  s.previous = record;
  if (record.fill != BrickFill::mixed) return;
  if (batch.mixed.empty()) batch.mixed.reserve(kMaxMixed);
  batch.mixed.push_back(brick.bits);
}

void BrickWriter::finish() {
  State& s = *state_;
  for (std::size_t i = 0; i < s.batches.size(); ++i) s.next_batch();
  const std::uint64_t index_offset = s.bytes;
  ByteSink index, entries;
  for (const IndexEntry& entry : s.slabs) put_index_entry(entries, entry);
  index.put_text(kIndexTag);
  index.put(std::uint32_t(s.slabs.size()));
  index.bytes().insert(index.bytes().end(), entries.bytes().begin(), entries.bytes().end());
  index.put(hash64(entries.bytes()));
  s.write(frame_of(std::move(index.bytes()), false));
  s.totals.bytes = s.bytes + kFrameHeadBytes + kEndBytes;
  s.write(encode_end(s.totals, index_offset, s.totals.bytes));
  s.finished = true;
}

const StreamTotals& BrickWriter::totals() const {
  return state_->totals;
}

}  // namespace bp
