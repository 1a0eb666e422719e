// docs/brick-stream.md is the specification; section numbers below are its own.
#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "io/stream/brick_stream.h"
#include "io/stream/stream_format.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"

namespace bp {

using namespace detail;

namespace {

std::string brick_name(BrickCoord c) {
  return fmt::format("({},{},{})", c.x, c.y, c.z);
}

bool starts_with(std::span<const std::byte> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

/// Returns a description of a file that is no stream of this suite.
std::string describe(std::span<const std::byte> head) {
  struct Kind {
    std::string_view start;
    const char* what;
  };
  static constexpr Kind kinds[] = {
      {"\x89PNG", "a PNG image"},
      {"glTF", "a GLB scene"},
      {"ply", "a PLY mesh"},
      {"solid", "an STL mesh"},
      {"\xff\xd8\xff", "a JPEG image"},
      {"\x1f\x8b", "a gzip file"},
      {"PK\x03\x04", "a zip archive"},
      {"OFF", "an OFF mesh"},
      {"{", "a JSON or glTF file"},
      {"# ", "a text file"},
      {"v ", "an OBJ mesh"},
      {"BPVS", "a stream of voxels without its frame"},
      {"\x28\xb5\x2f\xfd", "a zstd file of something else"},
  };
  constexpr std::size_t kWord = 4;  // a shorter run of letters may be chance
  for (const Kind& kind : kinds) {
    if (starts_with(head, kind.start)) return fmt::format("looks like {}, not a stream of voxels", kind.what);
  }
  std::string text;
  for (const std::byte b : head) {
    if (char(b) < ' ' || char(b) > '~') break;
    text += char(b);
  }
  return "is not a stream of voxels" + (text.size() < kWord ? "" : fmt::format("; it begins with '{}'", text));
}

/// A batch that is being read.
struct InBatch {
  std::uint64_t offset = 0;  ///< offset of its head in the stream
  std::uint32_t records_declared = 0, raw_bytes = 0;
  BrickCoord first, last;
  std::vector<std::byte> packed, raw;
  std::vector<Record> records;
  std::vector<BrickBits> mixed;  ///< at least one for each mixed record; further ones are left from earlier batches
  StreamTotals totals;
  std::string fault;  ///< why it cannot be used; empty if it can
  SideWork decoding;

  [[nodiscard]] std::span<const std::byte> planes() const {
    return std::span(raw).subspan(records.size() * kRecordBytes);
  }
};

/// Reads the record heads (section 6); returns a fault, or "" if there is none.
std::string read_records(const StreamHeader& header, InBatch& batch) {
  ByteSource in(batch.raw);
  std::size_t mixed = 0;
  for (std::uint32_t i = 0; i < batch.records_declared; ++i) {
    Record r;
    r.coord = in.get_coord();
    const auto layer = in.get<std::uint8_t>(), fill = in.get<std::uint8_t>();
    const auto reserved = in.get<std::uint16_t>();
    const std::string brick = "brick " + brick_name(r.coord);
    if (layer > (header.has_closing ? 1 : 0)) return fmt::format("{}: layer {} is not in this stream", brick, layer);
    if (fill != 1 && fill != 2) return fmt::format("{}: unknown fill {}", brick, fill);
    if (reserved != 0) return fmt::format("{}: reserved bytes are in use", brick);
    if (!header.bricks.contains(r.coord)) return fmt::format("{}: lies outside the brick box of the header", brick);
    r.layer = Layer(layer);
    r.fill = BrickFill(fill);
    if (i == 0 && r.coord != batch.first)
      return fmt::format("{}: is not the first brick that the batch head names", brick);
    if (i > 0 && !before(header.slab_axis, batch.records.back(), r)) return fmt::format("{}: is out of order", brick);
    if (r.coord[header.slab_axis] != batch.first[header.slab_axis]) return fmt::format("{}: is of another slab", brick);
    mixed += r.fill == BrickFill::mixed;
    batch.records.push_back(r);
  }
  if (batch.records.back().coord != batch.last)
    return fmt::format("brick {}: is not the last brick that the batch head names",
                       brick_name(batch.records.back().coord));
  if (mixed > kMaxMixed || batch.raw.size() != batch.records.size() * kRecordBytes + mixed * kBrickBytes)
    return fmt::format("{} mixed bricks do not fit {} bytes", mixed, batch.raw.size());
  return "";
}

/// Reads the mixed bricks, which must be neither empty nor full; returns a fault, or "".
std::string read_voxels(InBatch& batch) {
  const std::span<const std::byte> planes = batch.planes();
  batch.mixed.resize(std::max(batch.mixed.size(), planes.size() / kBrickBytes));
  std::size_t i = 0;
  for (const Record& r : batch.records) {
    if (r.fill != BrickFill::mixed) continue;
    from_planes(planes.data() + i * kBrickBytes, batch.mixed[i]);
    if (classify(batch.mixed[i++]) != BrickFill::mixed)
      return fmt::format("brick {}: is called mixed, but all its voxels are alike", brick_name(r.coord));
  }
  return "";
}

void decode(const StreamHeader& header, InBatch& batch) {
  batch.raw.resize(batch.raw_bytes);
  batch.records.clear();
  if ((std::uint8_t(batch.packed.size() > 4 ? batch.packed[4] : std::byte(0)) & 4) == 0) {
    batch.fault = "the zstd frame has no checksum";
  } else if (const char* fault = decompress(batch.packed, batch.raw)) {
    batch.fault = fmt::format("it {}", fault);
  } else {
    batch.fault = read_records(header, batch);
    if (batch.fault.empty()) batch.fault = read_voxels(batch);
    if (batch.fault.empty()) batch.totals = total(batch.records, batch.planes());
  }
}

}  // namespace

struct BrickReader::State {
  InputFile file;
  StreamHeader header;
  StreamTotals totals;
  std::vector<InBatch> batches = std::vector<InBatch>(batches_ahead());  // a ring; kept, with their memory
  std::size_t at_batch = 0, ahead = 0;   // of the ring: the batch whose bricks are handed out, and how many were read
  bool accepted = false, ended = false;  // that batch; the end record, which has been read
  std::size_t at_record = 0, at_mixed = 0;  // position of the next brick to hand out
  std::exception_ptr pending;               // found while reading ahead; thrown when its turn comes
  std::uint64_t index_offset = 0;
  std::uint32_t index_size = 0;  // not 0: the index has begun
  std::optional<Record> previous;
  SlabIndex index;

  explicit State(const std::string& path) : file(path) {}

  template <class... Args>
  [[noreturn]] void refuse(std::uint64_t offset, fmt::format_string<Args...> format, Args&&... args) const {
    fail(ErrorCode::bad_input, "{}: byte {}: {}", file.name(), offset,
         fmt::format(format, std::forward<Args>(args)...));
  }

  void take(std::span<std::byte> bytes, const char* what) {
    if (file.read(bytes) == bytes.size()) return;
    fail(ErrorCode::bad_input,
         "{}: truncated: it ends at byte {}, within the {}; the tool that wrote it did not finish, run it again",
         file.name(), file.offset(), what);
  }
  template <std::size_t N>
  std::array<std::byte, N> take(const char* what) {
    std::array<std::byte, N> bytes;
    take(bytes, what);
    return bytes;
  }

  void check_magic(std::span<const std::byte> head);
  void read_header();
  void read_payload(std::vector<std::byte>& payload, std::size_t known);
  bool fetch(InBatch& batch);
  void accept(const InBatch& batch);
  void read_index();
  void read_end();
  void fetch_ahead();
  bool next_batch();
};

/// Refuses bytes that are not the beginning of a brick stream, as far as they go.
void BrickReader::State::check_magic(std::span<const std::byte> head) {
  const auto begins = [&](std::size_t at, const void* bytes, std::size_t n) {
    return at >= head.size() || std::memcmp(head.data() + at, bytes, std::min(n, head.size() - at)) == 0;
  };
  if (!begins(0, &kFrameMagic, 4))
    fail(ErrorCode::bad_input, {Remedy::name_scene_format}, "{}: {}; bpvox makes one", file.name(), describe(head));
  if (!begins(kFrameHeadBytes, kStreamMagic.data(), kStreamMagic.size())) {
    if (begins(kFrameHeadBytes, kStreamMagic.data(), 4))
      refuse(kFrameHeadBytes + 4,
             "the magic is damaged, as by a transfer in text mode; copy the stream in binary mode");
    if (begins(kFrameHeadBytes, kWeightMagic.data(), kWeightMagic.size()))
      fail(ErrorCode::bad_input,
           "{}: holds weights, not a stream of voxels; bpinfo and bpdeform read them, by the name of their file",
           file.name());
    fail(ErrorCode::bad_input, "{}: is a zstd file of something else, not a stream of voxels; bpvox makes one",
         file.name());
  }
}

/// Reads the header (section 4). The version is checked first: a later version may have changed everything after it.
void BrickReader::State::read_header() {
  std::array<std::byte, kFrameHeadBytes + kStreamMagic.size() + 2> start;
  const std::size_t got = file.read(start);
  if (got == 0) {
    fail(ErrorCode::bad_input, "{}: is empty, not a stream of voxels; did the tool before it fail?", file.name());
  }
  check_magic(std::span(start).first(got));
  if (got < start.size()) take(std::span(start).subspan(got), "header");
  ByteSource in(start);
  (void)in.get<std::uint32_t>();
  const auto size = in.get<std::uint32_t>();
  (void)in.get<std::uint64_t>();
  const auto version = in.get<std::uint16_t>();
  if (version != kStreamVersion) {
    refuse(kFrameHeadBytes + kStreamMagic.size(), "version {} of the stream of voxels; this tool reads version {}",
           version, kStreamVersion);
  }
  if (size < kHeaderFixedBytes + kHashBytes || size > kHeaderFixedBytes + kMaxScaleBytes + kMaxProvenanceBytes +
                                                          kMaxSceneBytes + kMaxOrientationBytes + 4 + kHashBytes)
    refuse(4, "a header of {} bytes cannot be; the stream is damaged", size);
  std::vector<std::byte> payload(size);
  const std::size_t known = start.size() - kFrameHeadBytes;
  std::copy(start.begin() + kFrameHeadBytes, start.end(), payload.begin());
  read_payload(payload, known);
}

/// Reads the rest of a header of which `known` bytes are there.
void BrickReader::State::read_payload(std::vector<std::byte>& payload, std::size_t known) {
  const std::size_t size = payload.size();
  // The fixed part declares the sizes of the two texts; they are checked before reading on.
  take(std::span(payload).subspan(known, kHeaderFixedBytes - known), "header");
  ByteSource sizes(std::span<const std::byte>(payload).subspan(kHeaderFixedBytes - 8));
  const auto scale = sizes.get<std::uint32_t>(), provenance = sizes.get<std::uint32_t>();
  if (scale > kMaxScaleBytes || provenance > kMaxProvenanceBytes ||
      size < kHeaderFixedBytes + scale + provenance + kHashBytes ||
      size > kHeaderFixedBytes + scale + provenance + kMaxSceneBytes + kMaxOrientationBytes + 4 + kHashBytes)
    refuse(kFrameHeadBytes + kHeaderFixedBytes - 8, "the sizes in the header disagree; the stream is damaged");
  take(std::span(payload).subspan(kHeaderFixedBytes), "header");
  if (!seal_holds(payload)) refuse(kFrameHeadBytes, "the checksum of the header differs; the stream is damaged");
  header = decode_header(std::span(payload).first(size - kHashBytes), file.name());
}

/// Reads a batch (sections 5 and 6). False if the index comes instead, which it reads with the end record.
bool BrickReader::State::fetch(InBatch& batch) {
  batch.offset = file.offset();
  const auto frame_bytes = take<kFrameHeadBytes>("next frame: there is no end record");
  ByteSource frame(frame_bytes);
  const auto magic = frame.get<std::uint32_t>(), size = frame.get<std::uint32_t>();
  if (magic != kFrameMagic || size < 16)
    refuse(batch.offset, "neither a batch nor an index begins here; the stream is damaged");
  const auto tag = take<4>("tag of a batch or of the index");
  if (starts_with(tag, kIndexTag)) {
    index_offset = batch.offset;
    index_size = size;
    return false;
  }
  if (!starts_with(tag, kBatchTag) || size != kBatchHeadBytes)
    refuse(batch.offset, "neither a batch nor an index begins here; the stream is damaged");
  const auto head_bytes = take<kBatchHeadBytes - 4>("batch head");
  ByteSource head(head_bytes);
  batch.records_declared = head.get<std::uint32_t>();
  batch.raw_bytes = head.get<std::uint32_t>();
  const auto packed = head.get<std::uint32_t>();
  batch.first = head.get_coord();
  batch.last = head.get_coord();
  if (batch.records_declared == 0 || batch.records_declared > kMaxRecords || batch.raw_bytes > kMaxRawBytes ||
      batch.raw_bytes < batch.records_declared * kRecordBytes || packed == 0 || packed > kMaxPackedBytes)
    refuse(batch.offset, "a batch of {} bricks in {} bytes ({} compressed) cannot be; the stream is damaged",
           batch.records_declared, batch.raw_bytes, packed);
  batch.packed.resize(packed);
  take(batch.packed, "batch");
  return true;
}

/// Checks what spans several batches: order, totals, index.
void BrickReader::State::accept(const InBatch& batch) {
  if (!batch.fault.empty()) {
    refuse(batch.offset, "batch of bricks {} to {}: {}; the stream is damaged", brick_name(batch.first),
           brick_name(batch.last), batch.fault);
  }
  const Record& first = batch.records.front();
  if (previous && !before(header.slab_axis, *previous, first))
    refuse(batch.offset, "brick {}: is out of order; the stream is damaged", brick_name(first.coord));
  const std::int32_t at = first.coord[header.slab_axis];
  index.add(at, batch.offset, batch.records.size());
  previous = batch.records.back();
  totals.add(batch.totals);
}

/// Reads the index (section 8) after its tag.
void BrickReader::State::read_index() {
  index.end();
  const auto count = take<4>("index");
  const auto n = ByteSource(count).get<std::uint32_t>();
  if (n != index.slabs() || index_size != 8 + std::uint64_t(n) * kIndexEntryBytes + kHashBytes)
    refuse(index_offset, "the index is of {} slabs, the stream of {}; it is damaged", n, index.slabs());
  Digest found;
  for (std::uint32_t i = 0; i < n; ++i) found.add(take<kIndexEntryBytes>("index"));
  const auto hash = take<kHashBytes>("index");
  const auto declared = ByteSource(hash).get<std::uint64_t>();
  if (found.hash() != index.hash() || found.hash() != declared)
    refuse(index_offset, "the index is not that of this stream; it is damaged");
}

/// Reads the end record (section 9).
void BrickReader::State::read_end() {
  const std::uint64_t offset = file.offset();
  const auto found = take<kFrameHeadBytes + kEndBytes>("end record");
  totals.bytes = file.offset();
  const std::vector<std::byte> expected = encode_end(totals, index_offset, totals.bytes);
  if (!std::equal(found.begin(), found.begin() + kFrameHeadBytes + 4, expected.begin()) ||
      !seal_holds(std::span(found).subspan(kFrameHeadBytes)))
    refuse(offset, "the end record is damaged");
  if (!std::equal(found.begin(), found.end(), expected.begin())) {
    refuse(offset, "the end record counts other bricks or voxels than were read; the stream is damaged");
  }
  std::byte more;
  if (file.read({&more, 1}) != 0)
    refuse(offset + found.size(),
           "bytes follow the end record; streams cannot be joined by writing one after the other");
}

/// Reads as many batches as the ring holds. An error waits in `pending` until the bricks before it were handed out, so
/// that a stream gives the same bricks before the same error for any number of threads.
void BrickReader::State::fetch_ahead() {
  try {
    while (ahead < batches.size() && index_size == 0 && !pending) {
      InBatch& batch = batches[(at_batch + ahead) % batches.size()];
      if (!fetch(batch)) return;
      batch.decoding.begin([this, &batch] { decode(header, batch); });
      ++ahead;
    }
  } catch (const Error&) {
    pending = std::current_exception();
  }
}

/// Makes the next batch ready to hand out. Returns false at the end of the stream.
bool BrickReader::State::next_batch() {
  if (std::exchange(accepted, false)) at_batch = (at_batch + 1) % batches.size(), --ahead;
  if (ended) return false;
  fetch_ahead();
  if (ahead == 0 && pending) std::rethrow_exception(pending);
  try {
    if (ahead > 0) {
      batches[at_batch].decoding.wait();
      accept(batches[at_batch]);
      at_record = at_mixed = 0;
      return accepted = true;
    }
    read_index();
    read_end();
  } catch (...) {  // the next call says the same
    ahead = 0;
    pending = std::current_exception();
    throw;
  }
  return !(ended = true);
}

BrickReader::BrickReader(const std::string& path) : state_(std::make_unique<State>(path)) {
  state_->read_header();
}
BrickReader::~BrickReader() = default;

const StreamHeader& BrickReader::header() const {
  return state_->header;
}

const StreamTotals& BrickReader::totals() const {
  return state_->totals;
}

bool BrickReader::read(Brick& out) {
  State& s = *state_;
  if ((!s.accepted || s.at_record == s.batches[s.at_batch].records.size()) && !s.next_batch()) return false;
  const InBatch& batch = s.batches[s.at_batch];
  const Record& record = batch.records[s.at_record++];
  out.coord = record.coord;
  out.layer = record.layer;
  out.fill = record.fill;
  if (record.fill == BrickFill::mixed) {
    out.bits = batch.mixed[s.at_mixed++];
  } else {
    out.bits.fill(~std::uint64_t(0));
  }
  return true;
}

}  // namespace bp
