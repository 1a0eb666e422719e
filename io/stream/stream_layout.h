#pragma once
#include <array>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "io/store/brick_codec.h"
#include "lib/grid/orientation_field.h"

/// The layout of a brick stream (docs/brick-stream.md): sizes, limits, tags, and little-endian values.
namespace bp::detail {

constexpr std::uint32_t kFrameMagic = 0x184D2A5B;  ///< a skippable zstd frame, with the number of this suite
constexpr std::array<unsigned char, 8> kStreamMagic{'B', 'P', 'V', 'S', '\r', '\n', 0x1a, '\n'};
constexpr std::array<unsigned char, 8> kWeightMagic{'B', 'P', 'W', 'T', '\r', '\n', 0x1a, '\n'};  ///< io/deform
constexpr std::uint16_t kStreamVersion = 1;
constexpr std::uint16_t kFlagClosing = 1, kFlagScene = 2, kFlagField = 4, kFlagOrientation = 8;

constexpr std::size_t kFrameHeadBytes = 8;
constexpr std::size_t kHeaderFixedBytes = 128;  ///< bytes before the texts
constexpr std::size_t kHashBytes = 8;
constexpr std::size_t kBatchHeadBytes = 40;
constexpr std::size_t kRecordBytes = 16;
constexpr std::size_t kIndexEntryBytes = 24;
constexpr std::size_t kEndBytes = 96;

constexpr std::uint32_t kMaxScaleBytes = 1u << 22, kMaxProvenanceBytes = 1u << 20, kMaxSceneBytes = 1u << 20;
constexpr std::uint32_t kMaxOrientationBytes = 32 + 8 * (1u << 16) + 2 * OrientationField::kMostCells;
constexpr std::uint32_t kMaxRecords = 4096, kMaxMixed = 32;
constexpr std::uint32_t kMaxRawBytes = kMaxRecords * kRecordBytes + kMaxMixed * kBrickBytes;
constexpr std::uint32_t kMaxPackedBytes = kMaxRawBytes + 65536;

constexpr char kBatchTag[] = "BTCH", kIndexTag[] = "INDX", kEndTag[] = "TAIL";

/// Appends little-endian values.
class ByteSink {
 public:
  template <class T>
  void put(T value) {
    const std::size_t n = bytes_.size();
    bytes_.resize(n + sizeof(T));
    std::memcpy(bytes_.data() + n, &value, sizeof(T));
  }
  void put_coord(BrickCoord c) { put(c.x), put(c.y), put(c.z); }
  void put_text(std::string_view text) {
    const auto* p = reinterpret_cast<const std::byte*>(text.data());
    bytes_.insert(bytes_.end(), p, p + text.size());
  }
  [[nodiscard]] std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Takes little-endian values from bytes. There must be enough, and they must outlive this object.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  [[nodiscard]] T get() {
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  [[nodiscard]] BrickCoord get_coord() {
    const auto x = get<std::int32_t>(), y = get<std::int32_t>();
    return {x, y, get<std::int32_t>()};
  }
  [[nodiscard]] std::string get_text(std::size_t n) {
    std::string text(reinterpret_cast<const char*>(bytes_.data()), n);
    bytes_ = bytes_.subspan(n);
    return text;
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace bp::detail
