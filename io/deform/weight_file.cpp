// docs/weight-file.md is the specification; section numbers below are its own.
#include "io/deform/weight_file.h"

#include <algorithm>
#include <filesystem>

#include "io/store/brick_codec.h"
#include "io/stream/stream_format.h"
#include "lib/core/error.h"

namespace bp {

using namespace detail;

namespace {

constexpr std::uint16_t kVersion = 1;
constexpr auto kLastKind = std::uint32_t(CoordinateKind::maximum_likelihood);
constexpr char kBlockTag[] = "BLCK";
constexpr std::size_t kFixedBytes = 36, kBlockHeadBytes = 24, kWeightEndBytes = 48;
constexpr std::uint32_t kMostName = 4096, kMostTriangles = kMostCageTriangles;

struct Sizes {
  std::uint32_t vertices, triangles, name;
  [[nodiscard]] std::size_t payload() const {
    return kFixedBytes + 24 * std::size_t(vertices) + 12 * std::size_t(triangles) + name;
  }
};

/// Section 3.
std::vector<std::byte> encode(const WeightHeader& h) {
  if (h.scene.size() > kMostName || h.cage.triangles.size() > kMostTriangles)
    fail(ErrorCode::bad_argument, "a file of weights holds names of {} bytes and cages of {} triangles at most",
         kMostName, kMostTriangles);
  ByteSink out;
  for (const unsigned char c : kWeightMagic) out.put(c);
  out.put(kVersion);
  out.put(std::uint16_t(0));
  out.put(std::uint32_t(h.kind));
  out.put(std::uint32_t(h.cage.vertices.size()));
  out.put(std::uint32_t(h.cage.triangles.size()));
  out.put(std::uint32_t(h.scene.size()));
  out.put(h.scene_bytes);
  for (const Vec3d& v : h.cage.vertices) {
    for (const double x : v) out.put(x);
  }
  for (const auto& t : h.cage.triangles) {
    for (const std::uint32_t v : t) out.put(v);
  }
  out.put_text(h.scene);
  return std::move(out.bytes());
}

/// Maps small numbers of either sign to small numbers.
std::uint32_t zigzag(std::uint32_t x) {
  return x << 1 ^ (0u - (x >> 31));
}
std::uint32_t unzigzag(std::uint32_t x) {
  return x >> 1 ^ (0u - (x & 1));
}

/// Section 4: the difference from point to point, in planes of bytes.
std::vector<std::byte> raw_of(const WeightBlock& block) {
  const std::size_t n = block.units.size();
  std::vector<std::byte> raw(block.points + 4 * n);
  std::memcpy(raw.data(), block.bits.data(), block.points);
  std::byte* const plane = raw.data() + block.points;
  for (std::size_t c = 0; c < block.columns; ++c) {
    std::uint32_t before = 0;
    for (std::size_t i = c * block.points; i < (c + 1) * block.points; ++i) {
      const auto unit = std::uint32_t(block.units[i]);
      const std::uint32_t step = zigzag(unit - before);
      before = unit;
      for (std::size_t k = 0; k < 4; ++k) plane[k * n + i] = std::byte(step >> (8 * k));
    }
  }
  return raw;
}

void take_raw(std::span<const std::byte> raw, WeightBlock& block) {
  const std::size_t n = block.points * block.columns;
  block.bits.resize(block.points);
  block.units.resize(n);
  std::memcpy(block.bits.data(), raw.data(), block.points);
  const std::byte* const plane = raw.data() + block.points;
  for (std::size_t c = 0; c < block.columns; ++c) {
    std::uint32_t unit = 0;
    for (std::size_t i = c * block.points; i < (c + 1) * block.points; ++i) {
      std::uint32_t step = 0;
      for (std::size_t k = 0; k < 4; ++k) step |= std::uint32_t(plane[k * n + i]) << (8 * k);
      unit += unzigzag(step);
      block.units[i] = std::int32_t(unit);
    }
  }
}

}  // namespace

std::size_t points_of_block(std::size_t columns) {
  return std::clamp<std::size_t>((std::size_t(1) << 20) / std::max<std::size_t>(columns, 1), 16, 4096);
}

void pack_weights(const WeightBlock& block, PackedWeights& out) {
  out.points = std::uint32_t(block.points);
  compress(raw_of(block), kDefaultLevel, true, out.bytes);
}

const char* unpack_weights(const PackedWeights& packed, std::size_t columns, WeightBlock& out) {
  out.points = packed.points;
  out.columns = columns;
  std::vector<std::byte> raw(out.points * (4 * out.columns + 1));
  if (const char* fault = decompress(packed.bytes, raw)) return fault;
  take_raw(raw, out);
  const bool wrong =
      std::any_of(out.bits.begin(), out.bits.end(), [](std::uint8_t b) { return b > WeightBlock::kBits; });
  return wrong ? "has weights that cannot be" : nullptr;
}

struct WeightWriter::State {
  OutputFile& file;
  std::uint64_t points = 0, blocks = 0;
};

WeightWriter::WeightWriter(OutputFile& out, const WeightHeader& header) : state_(new State{out}) {
  out.write(frame_of(encode(header), true));
}
WeightWriter::~WeightWriter() = default;

void WeightWriter::write(const PackedWeights& block) {
  ByteSink head;
  head.put_text(kBlockTag);
  head.put(block.points);
  head.put(state_->points);
  head.put(std::uint64_t(block.bytes.size()));
  state_->file.write(frame_of(std::move(head.bytes()), true));
  state_->file.write(block.bytes);
  state_->points += block.points;
  ++state_->blocks;
}

/// Section 5.
void WeightWriter::finish(const WeightTotals& totals) {
  ByteSink end;
  end.put_text(kEndTag);
  end.put(std::uint32_t(0));
  end.put(totals.points);
  end.put(totals.outside);
  end.put(state_->blocks);
  for (const std::uint64_t word : totals.hash.words) end.put(word);
  state_->file.write(frame_of(std::move(end.bytes()), true));
}

struct WeightReader::State {
  InputFile file;
  WeightHeader header{};
  WeightTotals totals{};
  std::size_t columns = 0;
  std::uint64_t points = 0, blocks = 0;
  bool ended = false;

  explicit State(const std::string& path) : file(path) {}

  [[noreturn]] void refuse(std::uint64_t offset, const std::string& what) const {
    fail(ErrorCode::bad_input, "{}: byte {}: {}; bind the scene again", file.name(), offset, what);
  }
  void take(std::span<std::byte> bytes) {
    if (file.read(bytes) != bytes.size())
      fail(ErrorCode::bad_input, "{}: truncated: it ends at byte {}; bind the scene again", file.name(), file.offset());
  }
  /// Returns the payload of the next frame. Throws unless its size lies in the range and its hash is right.
  std::vector<std::byte> take_sealed(std::size_t least, std::size_t most) {
    const std::uint64_t offset = file.offset();
    std::vector<std::byte> head(kFrameHeadBytes);
    take(head);
    ByteSource source(head);
    const auto magic = source.get<std::uint32_t>(), size = source.get<std::uint32_t>();
    if (magic != kFrameMagic || size < least + kHashBytes || size > most + kHashBytes)
      refuse(offset, "the file is damaged");
    std::vector<std::byte> payload(size);
    take(payload);
    if (!seal_holds(payload)) refuse(offset, "a checksum differs");
    payload.resize(size - kHashBytes);
    return payload;
  }
  void check_start();
  void read_header();
  void read_cage(ByteSource& in, const Sizes& sizes);
  void read_end(std::span<const std::byte> payload);
};

std::string find_scene(const WeightHeader& header, const std::string& path) {
  const std::filesystem::path name = header.scene, beside = std::filesystem::path(path).parent_path() / name;
  std::error_code unknown;
  if (std::filesystem::exists(beside, unknown)) return beside.string();
  return std::filesystem::exists(name, unknown) ? header.scene : "";  // files written before this rule name it so
}

bool begins_as_weights(const InputFile& file) {
  std::array<std::byte, kFrameHeadBytes + kWeightMagic.size()> start{};
  return file.seekable() && file.read_at(0, start) == start.size() && std::memcmp(start.data(), &kFrameMagic, 4) == 0 &&
         std::memcmp(start.data() + kFrameHeadBytes, kWeightMagic.data(), kWeightMagic.size()) == 0;
}

void WeightReader::State::check_start() {
  if (!begins_as_weights(file))
    fail(ErrorCode::bad_input, "{}: is no file of weights; bpdeform bind makes one", file.name());
}

void WeightReader::State::read_header() {
  if (!file.seekable())
    fail(ErrorCode::bad_input, "{}: a file of weights is read from a file, not a pipe", file.name());
  check_start();
  const Sizes most{kMostCageVertices, kMostTriangles, kMostName};
  const std::vector<std::byte> payload = take_sealed(kFixedBytes, most.payload());
  ByteSource in(payload);
  (void)in.get<std::uint64_t>();
  const auto version = in.get<std::uint16_t>(), flags = in.get<std::uint16_t>();
  const auto kind = in.get<std::uint32_t>();
  if (version != kVersion || flags != 0)
    refuse(kFrameHeadBytes,
           fmt::format("version {} of the file of weights; this tool reads version {}", version, kVersion));
  if (kind > kLastKind) refuse(kFrameHeadBytes, fmt::format("coordinates of kind {}, which this tool lacks", kind));
  header.kind = CoordinateKind(kind);
  Sizes sizes{};
  sizes.vertices = in.get<std::uint32_t>(), sizes.triangles = in.get<std::uint32_t>();
  sizes.name = in.get<std::uint32_t>();
  if (sizes.vertices == 0 || sizes.vertices > most.vertices || sizes.triangles > most.triangles ||
      sizes.name > most.name || sizes.payload() != payload.size())
    refuse(kFrameHeadBytes, "the sizes in the header disagree");
  header.scene_bytes = in.get<std::uint64_t>();
  read_cage(in, sizes);
  header.scene = in.get_text(sizes.name);
  columns = columns_of(header.kind, header.cage);
}

void WeightReader::State::read_cage(ByteSource& in, const Sizes& sizes) {
  header.cage.vertices.resize(sizes.vertices);
  for (Vec3d& v : header.cage.vertices) {
    for (double& x : v) x = in.get<double>();
  }
  header.cage.triangles.resize(sizes.triangles);
  for (auto& t : header.cage.triangles) {
    for (std::uint32_t& v : t) {
      v = in.get<std::uint32_t>();
      if (v >= sizes.vertices) refuse(kFrameHeadBytes, "a face of the cage names a vertex that does not exist");
    }
  }
}

void WeightReader::State::read_end(std::span<const std::byte> payload) {
  ByteSource in(payload);
  (void)in.get<std::uint64_t>();
  totals.points = in.get<std::uint64_t>();
  totals.outside = in.get<std::uint64_t>();
  const auto declared = in.get<std::uint64_t>();
  for (std::uint64_t& word : totals.hash.words) word = in.get<std::uint64_t>();
  if (totals.points != points || declared != blocks) refuse(file.offset(), "blocks are missing");
  std::byte more;
  if (file.read({&more, 1}) != 0) refuse(file.offset(), "bytes follow the end");
  ended = true;
}

WeightReader::WeightReader(const std::string& path) : state_(std::make_unique<State>(path)) {
  state_->read_header();
}
WeightReader::~WeightReader() = default;

const WeightHeader& WeightReader::header() const {
  return state_->header;
}
std::uint64_t WeightReader::points_declared() const {
  constexpr std::size_t kAt = 8, kFrame = kFrameHeadBytes + kWeightEndBytes + kHashBytes;
  std::uint64_t points = 0;
  const std::uint64_t size = state_->file.size();
  if (size > kFrame)
    state_->file.read_at(size - kFrame + kFrameHeadBytes + kAt, std::as_writable_bytes(std::span(&points, 1)));
  return points;
}
const WeightTotals& WeightReader::totals() const {
  return state_->totals;
}

bool WeightReader::next(PackedWeights& out) {
  State& s = *state_;
  if (s.ended) return false;
  out.offset = s.file.offset();
  const std::vector<std::byte> payload = s.take_sealed(kBlockHeadBytes, kWeightEndBytes);
  if (payload.size() == kWeightEndBytes && std::memcmp(payload.data(), kEndTag, 4) == 0) {
    s.read_end(payload);
    return false;
  }
  ByteSource in(payload);
  const bool is_block = payload.size() == kBlockHeadBytes && in.get_text(4) == kBlockTag;
  if (!is_block) s.refuse(out.offset, "neither a block nor the end begins here");
  out.points = in.get<std::uint32_t>();
  const auto first = in.get<std::uint64_t>(), bytes = in.get<std::uint64_t>();
  if (out.points == 0 || out.points > points_of_block(s.columns) || first != s.points || bytes == 0 ||
      bytes > compress_bound(out.points * (4 * s.columns + 1)))
    s.refuse(out.offset, "a block is out of place, or cannot be");
  out.bytes.resize(bytes);
  s.take(out.bytes);
  s.points += out.points;
  ++s.blocks;
  return true;
}

void WeightReader::unpack(const PackedWeights& packed, WeightBlock& out) const {
  if (const char* fault = unpack_weights(packed, state_->columns, out))
    state_->refuse(packed.offset, fmt::format("a block {}", fault));
}

}  // namespace bp
