#include "io/tiles/tile_content.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "io/gltf/gltf_document.h"
#include "lib/core/error.h"

// OGC 22-025r4, section 8; b3dm: OGC 18-053r2.

namespace bp {

namespace {

/// The content of a b3dm after its head and tables. Files that its glTF names lie in the tile's folder.
class TilePart final : public SceneFile {
 public:
  TilePart(SceneFilePtr file, std::uint64_t begin, std::uint64_t end)
      : file_(std::move(file)), begin_(begin), end_(end) {}
  std::size_t read_at(std::uint64_t offset, std::span<std::byte> buffer) const override {
    if (offset >= size()) return 0;
    return file_->read_at(begin_ + offset,
                          buffer.first(std::size_t(std::min<std::uint64_t>(buffer.size(), size() - offset))));
  }
  [[nodiscard]] std::uint64_t size() const override { return end_ - begin_; }
  [[nodiscard]] std::string name() const override { return file_->name(); }
  [[nodiscard]] std::string path() const override { return file_->path(); }

 private:
  SceneFilePtr file_;
  std::uint64_t begin_, end_;
};

struct B3dmHead {
  char magic[4];
  std::uint32_t version, bytes, features, feature_bytes, batches, batch_bytes;
};

/// The glTF in a b3dm.
class B3dm {
 public:
  B3dm(const SceneFilePtr& file, const SceneOptions& options) : file_(file) {
    const std::size_t got = file->read_at(0, std::as_writable_bytes(std::span(&head_, 1)));
    if (got < sizeof head_ || head_.bytes > file->size() || begin() > head_.bytes)
      fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: promises more bytes than it has; the file is truncated",
           file->name());
    if (head_.version != 1) unread_.push_back(fmt::format("it is a b3dm of version {}", head_.version));
    if (head_.features > 0) read_features(read_json(part_of(file, sizeof head_, head_.features), options).json);
  }

  [[nodiscard]] SceneFilePtr gltf() const { return std::make_shared<TilePart>(file_, begin(), head_.bytes); }
  /// Returns the move by RTC_CENTER.
  [[nodiscard]] Affine move() const {
    Affine moved;
    for (std::size_t i = 0; i < 3; ++i) moved.m[i][3] = centre_[i];
    return moved;
  }
  [[nodiscard]] const std::vector<std::string>& unread() const { return unread_; }

 private:
  [[nodiscard]] std::uint64_t begin() const {
    return std::uint64_t(sizeof head_) + head_.features + head_.feature_bytes + head_.batches + head_.batch_bytes;
  }
  void read_features(const GltfJson& json) {
    const GltfObject table(json, file_->name(), "");
    for (const auto& [key, value] : json.items()) {
      if (key != "BATCH_LENGTH" && key != "RTC_CENTER" && key != "extras")
        unread_.push_back("its feature table has " + key + ", which is not followed here");
    }
    if (!table.has("RTC_CENTER")) return;
    if (json["RTC_CENTER"].is_array()) {
      centre_ = table.numbers<3>("RTC_CENTER", {0, 0, 0});
      return;
    }
    std::array<float, 3> floats{};
    const std::uint64_t at = table.object("RTC_CENTER").number("byteOffset");
    if (at + sizeof floats > head_.feature_bytes) table.broken("has no bytes for its RTC_CENTER");
    file_->read_at(sizeof head_ + head_.features + at, std::as_writable_bytes(std::span(floats)));
    std::copy(floats.begin(), floats.end(), centre_.begin());
  }

  const SceneFilePtr file_;
  B3dmHead head_{};
  std::array<double, 3> centre_{};
  std::vector<std::string> unread_;
};

}  // namespace

TileContentFile open_tile_content(const SceneFilePtr& file, const SceneOptions& options, const ContentPlace& place) {
  std::string magic(4, '\0');
  magic.resize(file->read_at(0, std::as_writable_bytes(std::span(magic))));
  if (magic == "b3dm") {
    const B3dm b3dm(file, options);
    RawSourcePtr triangles = open_gltf(b3dm.gltf(), options, ContentPlace{place.tile * b3dm.move(), place.up});
    UnreadParts unread = triangles->unread();
    unread.moves.insert(unread.moves.end(), b3dm.unread().begin(), b3dm.unread().end());
    return {std::move(triangles), std::move(unread)};
  }
  if (magic != "glTF" && !magic.starts_with('{'))
    throw Unfit(fmt::format("{}: a content that is neither glTF nor b3dm, and no other is read", file->name()));
  RawSourcePtr triangles = open_gltf(file, options, place);
  UnreadParts unread = triangles->unread();
  return {std::move(triangles), std::move(unread)};
}

TileMesh read_tile_content(const std::string& path, const SceneOptions& options, const ContentPlace& place) {
  const TileContentFile content =
      open_tile_content(open_scene_file(path, temp_dir_of(options), NamedBy::file), options, place);
  TileMesh out;
  out.mesh = mesh_of(path, *content.triangles, options, out.counts);
  out.unread = content.unread;
  return out;
}

}  // namespace bp
