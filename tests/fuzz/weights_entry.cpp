#include <fstream>
#include <iterator>
#include <span>

#include "io/store/brick_codec.h"
#include "io/stream/stream_format.h"
#include "tests/fuzz/choices.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/tool_runs.h"

namespace fuzz {

namespace {

using Bytes = std::vector<std::byte>;

constexpr const char* kScene = "v 1 1 1\nv 3 1 1\nv 1 3 1\nv 1 1 3\nv 2 2 1\nf 1 2 3\nf 1 3 4\nf 2 3 5\n";
constexpr const char* kCage = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// A frame of a file of weights: the payload of one of the suite's own frames without its hash, or the content of a
/// zstd frame.
struct Frame {
  bool ours = false;
  Bytes content;
};

std::uint32_t u32_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

/// Splits a file that bpdeform wrote into frames. A zstd frame lasts until the next frame of the suite's own, as its
/// block head tells.
std::vector<Frame> frames_of(const Bytes& file) {
  std::vector<Frame> frames;
  const std::size_t header = 8, columns = u32_at(file, header + 16) +
                                          (u32_at(file, header + 12) == 1 ? u32_at(file, header + 20) : 0);
  for (std::size_t at = 0; at < file.size();) {
    const std::span<const std::byte> left = std::span(file).subspan(at);
    if (u32_at(left, 0) != 0x184D2A5B) fail_fuzz("weights", "a sound file has other frames");
    const std::size_t size = u32_at(left, 4);
    Frame& ours = frames.emplace_back();
    ours.ours = true;
    ours.content.assign(left.begin() + 8, left.begin() + std::ptrdiff_t(size));
    at += 8 + size;
    if (std::memcmp(ours.content.data(), "BLCK", 4) != 0) continue;
    const std::size_t packed = u32_at(ours.content, 16);
    Frame& block = frames.emplace_back();
    block.content.resize(std::size_t(u32_at(frames[frames.size() - 2].content, 4)) * (4 * columns + 1));
    if (bp::detail::decompress(std::span(file).subspan(at, packed), block.content) != nullptr)
      fail_fuzz("weights", "a sound file is not read");
    at += packed;
  }
  return frames;
}

std::vector<Frame> sound_frames(const std::string& kind) {
  Workplace place;
  place.write("s.obj", kScene);
  place.write("c.obj", kCage);
  const ToolResult made = place.run(
      "bpdeform", {"bind", place.path("s.obj"), place.path("c.obj"), "--coordinates", kind, "-o", place.path("w.bpw")},
      {"w.bpw"});
  if (!made.done()) fail_fuzz("bpdeform bind", made.messages);
  std::ifstream in(place.path("w.bpw"), std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
  return frames_of({bytes.begin(), bytes.end()});
}

void damage(Choices& c, Bytes& bytes) {
  if (bytes.empty()) return;
  const std::uint32_t size = std::uint32_t(std::min<std::size_t>(bytes.size(), 60000));
  if (c.once_in(3)) {
    const std::uint32_t at = c.below(size) / 4 * 4;
    const std::int64_t value = extreme_integer(c);
    std::memcpy(bytes.data() + at, &value, std::min<std::size_t>(c.once_in(2) ? 4 : 8, bytes.size() - at));
  } else if (c.once_in(3) && size >= 8) {
    const double value = extreme_number(c);
    std::memcpy(bytes.data() + (c.below(size - 7) + 4) / 8 * 8 % (size - 7), &value, 8);
  } else if (c.once_in(6)) {
    bytes.resize(c.below(size + 16));
  } else {
    bytes[c.below(size)] = std::byte(c.byte());
  }
}

/// Returns the bytes of frames, with hashes and sizes that fit.
std::string bytes_of(const std::vector<Frame>& frames, bool fix_sizes) {
  std::string out;
  const auto append = [&](const Bytes& bytes) {
    out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Bytes packed;
    if (i + 1 < frames.size() && !frames[i + 1].ours) bp::detail::compress(frames[i + 1].content, 1, true, packed);
    if (!frames[i].ours) continue;
    Bytes payload = frames[i].content;
    const std::uint64_t size = packed.size();
    if (fix_sizes && !packed.empty() && payload.size() >= 24) std::memcpy(payload.data() + 16, &size, 8);
    append(bp::detail::frame_of(std::move(payload), true));
    append(packed);
  }
  return out;
}

}  // namespace

void weights(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::vector<Frame>> kSound{sound_frames("mean-value"), sound_frames("green")};
  Choices c(data, size);
  std::vector<Frame> frames = c.of(kSound);
  for (std::uint32_t n = c.below(5); n > 0; --n) damage(c, frames[c.below(std::uint32_t(frames.size()))].content);
  if (c.once_in(12)) frames.erase(frames.begin() + c.below(std::uint32_t(frames.size())));
  if (c.once_in(12)) frames.push_back(frames[c.below(std::uint32_t(frames.size()))]);
  std::string bytes = bytes_of(frames, !c.once_in(12));
  if (c.once_in(12)) bytes.resize(c.below(std::uint32_t(bytes.size()) + 1));
  Workplace place;
  place.write("s.obj", kScene);
  place.write("c.obj", kCage);
  place.write("w.bpw", bytes);
  (void)place.run("bpdeform", {"apply", place.path("w.bpw"), place.path("c.obj"), "-o", place.path("o.obj")},
                  {"o.obj"});
}

}  // namespace fuzz
