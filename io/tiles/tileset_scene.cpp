#include <algorithm>
#include <mutex>

#include "io/gltf/gltf_document.h"
#include "io/tiles/tile_content.h"
#include "io/tiles/tileset_contents.h"
#include "lib/core/error.h"

// Opens a tileset of 3D Tiles (OGC 22-025r4) as a scene.

namespace bp {

namespace {

constexpr std::uint64_t kMostUri = 64;  ///< bytes of a content's name in nearly all tilesets

/// A file that is open only while it is needed: a tileset has thousands, and their images may be needed at any time.
class RestingFile final : public SceneFile {
 public:
  RestingFile(std::string path, std::string temp_dir)
      : path_(std::move(path)), temp_dir_(std::move(temp_dir)), file_(open()), size_(file_->size()) {}

  std::size_t read_at(std::uint64_t offset, std::span<std::byte> buffer) const override {
    return file()->read_at(offset, buffer);
  }
  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] std::string name() const override { return path_; }
  [[nodiscard]] std::string path() const override { return path_; }

  /// Closes the file. From now on, each reading opens it again.
  void rest() {
    const std::lock_guard lock(mutex_);
    file_.reset();
  }

 private:
  [[nodiscard]] SceneFilePtr open() const { return open_scene_file(path_, temp_dir_, NamedBy::file); }
  [[nodiscard]] SceneFilePtr file() const {
    const std::lock_guard lock(mutex_);
    return file_ ? file_ : open();
  }

  const std::string path_, temp_dir_;
  mutable std::mutex mutex_;
  SceneFilePtr file_;
  const std::uint64_t size_;
};

class TilesetSource final : public RawSource {
 public:
  TilesetSource(TilesetContents contents, const SceneOptions& options)
      : contents_(std::move(contents)), options_(options) {
    for (const ContentFile& file : contents_.files) list_bytes_ += sizeof(ContentFile) + file.path.size();
    MemoryShare& left = options_.document;  // without the list of contents
    if (left.bytes > 0) left.bytes = std::max<std::uint64_t>(1, left.bytes - std::min(left.bytes, list_bytes_));
  }

  bool read(std::vector<TriangleD>& out) override {
    RawBatch batch;
    const bool more = next(batch);
    out.swap(batch.triangles);
    return more;
  }
  /// Completes the batch: the content may be closed before its triangles are used.
  bool next(RawBatch& batch) override {
    for (; at_ < contents_.files.size(); leave()) {
      if (!content_) enter();
      if (!content_->next(batch)) continue;
      content_->complete(batch);
      bad_faces_ += batch.bad_faces;
      batch.bad_faces = 0;
      return true;
    }
    batch.triangles.clear();
    return false;
  }
  void rewind() override {
    rest();
    at_ = 0;
    bad_faces_ = instances_ = animations_ = posed_ = differing_ = 0;
    rounding_ = {};
    unfollowed_ = {};
  }
  [[nodiscard]] bool has_colors() const override { return has_colors_; }
  [[nodiscard]] bool has_textures() const override { return has_textures_; }
  [[nodiscard]] std::uint64_t instances() const override { return instances_; }
  [[nodiscard]] std::size_t animations() const override { return animations_; }
  [[nodiscard]] std::uint64_t posed() const override { return posed_; }
  [[nodiscard]] std::uint64_t differing() const override { return differing_; }
  [[nodiscard]] Rounding rounding() const override { return rounding_; }
  [[nodiscard]] Unfollowed unfollowed() const override { return unfollowed_; }
  [[nodiscard]] std::optional<UpAxis> up() const override { return contents_.up; }

 private:
  void enter() {
    file_ = std::make_shared<RestingFile>(contents_.files[at_].path, temp_dir_of(options_));
    content_ = open_content();
    has_colors_ = has_colors_ || content_->has_colors();
    has_textures_ = has_textures_ || content_->has_textures();
  }
  /// Opens a content. If one does not fit, those after it are asked, too, so that the limit in the error suffices for
  /// each.
  [[nodiscard]] RawSourcePtr open_content() const {
    try {
      return open_tile_content(file_, options_, contents_.files[at_].place).triangles;
    } catch (const Error& e) {
      if (e.memory_bytes() == 0) throw;
      throw Error(e.code(), e.what(), e.remedies(), std::max(e.memory_bytes(), limit_for_the_rest()));
    }
  }
  [[nodiscard]] std::uint64_t limit_for_the_rest() const {
    const SceneOptions nothing = without_memory(options_);
    std::uint64_t least = 0;
    for (std::size_t i = at_ + 1; i < contents_.files.size(); ++i) {
      const ContentFile& file = contents_.files[i];
      if (file.path == contents_.files[i - 1].path) continue;
      try {
        (void)open_tile_content(open_scene_file(file.path, temp_dir_of(options_), NamedBy::file), nothing, file.place);
      } catch (const Error& e) {
        least = std::max(least, e.memory_bytes());
      }
    }
    const MemoryShare& share = options_.document;
    return least == 0 ? 0 : MemoryLimit{least, share.limit.fixed_bytes}.with(list_bytes_, share.share);
  }
  void leave() {
    bad_faces_ += content_->bad_faces();
    instances_ += content_->instances();
    animations_ += content_->animations();
    posed_ += content_->posed();
    differing_ += content_->differing();
    rounding_.add(content_->rounding());
    unfollowed_.add(content_->unfollowed());
    rest();
    ++at_;
  }
  void rest() {
    content_.reset();
    if (file_) file_->rest();
    file_.reset();
  }

  const TilesetContents contents_;
  SceneOptions options_;
  std::uint64_t list_bytes_ = 0;  // bytes of contents_
  std::size_t at_ = 0;
  std::shared_ptr<RestingFile> file_;
  RawSourcePtr content_;
  bool has_colors_ = false, has_textures_ = false;
  std::uint64_t instances_ = 0, animations_ = 0, posed_ = 0, differing_ = 0;
  Rounding rounding_;
  Unfollowed unfollowed_;
};

}  // namespace

RawSourcePtr open_contents(TilesetContents contents, const SceneOptions& options) {
  return std::make_unique<TilesetSource>(std::move(contents), options);
}

RawSourcePtr open_tileset(SceneFilePtr file, const SceneOptions& options) {
  const MadeOfJson contents{"\"uri\"", sizeof(ContentFile) + file->path().size() + kMostUri};
  const CountedJson tileset = read_json(file, options, 0, {}, contents);
  const GltfJson& json = tileset.json;
  if (!json.is_object() || !(json.contains("root") || json.contains("geometricError")))
    return open_gltf(std::move(file), options);  // opened under another name
  if (file->path().empty())
    fail(ErrorCode::bad_input, "{}: a tileset names files beside it, which a pipe does not have", file->name());
  return open_contents(contents_of(tileset, file->path(), options), options);
}

}  // namespace bp
