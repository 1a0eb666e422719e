#include "io/gltf/detail/glb_copy.h"

#include <array>

#include "io/gltf/json_fault.h"
#include "lib/core/error.h"

namespace bp::detail {

namespace {

constexpr std::uint32_t kJson = 0x4E4F534A, kBin = 0x004E4942;
constexpr std::uint64_t kFirst = 12;

struct Chunk {
  std::uint64_t begin = 0, size = 0;  ///< of its content
  std::uint32_t type = 0;
  [[nodiscard]] std::uint64_t end() const { return begin + (size + 3) / 4 * 4; }
};

Chunk chunk_at(const SceneFile& file, std::uint64_t at) {
  std::array<std::uint32_t, 2> words{};
  if (file.read_at(at, std::as_writable_bytes(std::span(words))) != sizeof words) return {};
  return {at + 8, words[0], words[1]};
}

/// Calls f(bytes) with the bytes [begin, end) of a file, block by block.
template <class File, class F>
void each_block(const File& file, std::uint64_t begin, std::uint64_t end, const F& f) {
  std::vector<std::byte> block(std::size_t(1) << 20);
  for (; begin < end; begin += block.size()) {
    block.resize(std::size_t(std::min<std::uint64_t>(block.size(), end - begin)));
    file.read_at(begin, std::span(block));
    f(std::span<const std::byte>(block));
  }
}

}  // namespace

void check_glb(const SceneFile& file) {
  const Chunk json = chunk_at(file, kFirst), data = chunk_at(file, json.end());
  if (json.type != kJson || data.type != kBin || data.end() < file.size())
    fail(ErrorCode::bad_input, "{}: is no GLB of JSON and one binary chunk", file.name());
}

GlbCopy::GlbCopy(SceneFilePtr file, const std::string& temp_dir)
    : file_(std::move(file)), data_(std::make_unique<ScratchFile>(temp_dir)) {
  const Chunk json = chunk_at(*file_, kFirst), data = chunk_at(*file_, json.end());
  std::string text(json.size, ' ');
  file_->read_at(json.begin, std::as_writable_bytes(std::span(text)));
  try {
    json_ = GltfOutJson::parse(text);
  } catch (const GltfOutJson::exception& e) {
    fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: broken JSON: {}", file_->name(), json_fault(e));
  }
  each_block(*file_, data.begin, data.begin + data.size, [&](std::span<const std::byte> b) { data_->append(b); });
}

void GlbCopy::set_bounds(std::uint64_t accessor, const Bounds3d& bounds) {
  if (bounds.empty()) return;
  json_["accessors"][accessor]["min"] = bounds.min;
  json_["accessors"][accessor]["max"] = bounds.max;
}

void GlbCopy::write(OutputFile& out) const {
  const std::uint64_t size = data_->size();
  out.write(glb_head(json_.dump(), (size + 3) / 4 * 4, out.name()));
  each_block(*data_, 0, size, [&](std::span<const std::byte> b) { out.write(b); });
  out.write(std::string((4 - size % 4) % 4, '\0'));
}

}  // namespace bp::detail
