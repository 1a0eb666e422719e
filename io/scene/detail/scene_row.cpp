#include <algorithm>

#include "io/files/file.h"
#include "io/scene/detail/foreign_format.h"
#include "io/scene/raw_source.h"
#include "io/scene/scene_format.h"
#include "io/scene/scene_reader.h"
#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns the limit on memory at which the description of a scene fits. 0: it fits in next to nothing, or the file
/// cannot be opened for another reason.
std::uint64_t limit_to_open(const std::string& path, const SceneOptions& options) {
  try {
    (void)open_scene(path, without_memory(options));
  } catch (const Error& e) {
    return e.memory_bytes();
  }
  return 0;
}

/// Files in a row. Only one is open at a time, so that vertices and file handles of the others take nothing. stdin,
/// which cannot be opened again, stays open.
class SceneRow final : public TriangleSource {
 public:
  SceneRow(std::vector<std::string> paths, const SceneOptions& options) : paths_(std::move(paths)), options_(options) {
    for (const std::string& path : paths_) {
      if (path == "-") continue;
      const InputFile probe(path);  // a missing file, or one that is not read, is reported before hours of reading
      if (options_.format.empty() && scene_format_of(path).empty()) refuse_foreign(path);
    }
  }
  bool read(std::vector<TriangleD>& out) override {
    out.clear();
    return read_next([&](TriangleSource& scene) { return scene.read(out); });
  }
  bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) override {
    out.clear();
    colors.clear();
    return read_next([&](TriangleSource& scene) { return scene.read_colored(out, colors); });
  }
  bool read_textured(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                     std::vector<TriangleTexture>& textures) override {
    out.clear();
    colors.clear();
    textures.clear();
    return read_next([&](TriangleSource& scene) { return scene.read_textured(out, colors, textures); });
  }
  bool read_faces(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                  std::vector<std::uint8_t>& inner_edges) override {
    out.clear();
    colors.clear();
    inner_edges.clear();
    return read_next([&](TriangleSource& scene) { return scene.read_faces(out, colors, inner_edges); });
  }
  [[nodiscard]] bool has_colors() const override { return has_colors_; }
  [[nodiscard]] bool has_textures() const override { return has_textures_; }
  void rewind() override {
    scene_.reset();
    entered_ = false;
    next_ = 0;
    counts_ = finished_ = {};
  }
  [[nodiscard]] const SceneCounts& counts() const override { return counts_; }
  [[nodiscard]] std::string name() const override {
    return paths_.size() == 1 ? paths_[0] : fmt::format("{} scenes", paths_.size());
  }
  [[nodiscard]] std::optional<UpAxis> up() const override { return up_; }  // the first one told

 private:
  template <class Read>
  bool read_next(const Read& read) {
    for (; next_ < paths_.size(); leave()) {
      TriangleSource& scene = enter();
      const bool more = read(scene);
      if (!up_) up_ = scene.up();
      has_colors_ = has_colors_ || scene.has_colors();
      has_textures_ = has_textures_ || scene.has_textures();
      counts_ = finished_;
      counts_.add(scene.counts());
      if (more) return true;
      check_not_empty(scene);
    }
    return false;
  }
  /// Refuses a file that has no triangle with an area: it is probably a failed export, even if other files have
  /// triangles. If only some parts or the walls are asked for, a file may have none of them.
  void check_not_empty(const TriangleSource& scene) const {
    if (!options_.parts.empty() || options_.walls_only || scene.counts().has_area()) return;
    const SceneCounts& c = scene.counts();
    fail(ErrorCode::bad_input,
         "{}: no triangles ({} degenerate, {} non-finite, {} bad faces); each scene needs at least one with an area",
         scene.name(), c.degenerate, c.non_finite, c.bad_faces);
  }
  TriangleSource& enter() {
    const bool piped = paths_[next_] == "-";
    std::unique_ptr<TriangleSource>& slot = piped ? stdin_ : scene_;
    if (!slot) {
      slot = open(paths_[next_]);
    } else if (!entered_) {
      slot->rewind();
    }
    entered_ = true;
    return *slot;
  }
  /// Opens a file. If one does not fit, those after it are asked, too, so that the limit in the error suffices for
  /// each.
  [[nodiscard]] std::unique_ptr<TriangleSource> open(const std::string& path) const {
    try {
      return open_scene(path, options_);
    } catch (const Error& e) {
      std::uint64_t least = e.memory_bytes();
      if (least == 0) throw;
      for (std::size_t i = next_ + 1; i < paths_.size(); ++i) {
        if (paths_[i] != "-") least = std::max(least, limit_to_open(paths_[i], options_));
      }
      throw Error(e.code(), e.what(), e.remedies(), least);
    }
  }
  void leave() {
    finished_ = counts_;
    scene_.reset();
    entered_ = false;
    ++next_;
  }

  std::vector<std::string> paths_;
  SceneOptions options_;
  std::size_t next_ = 0;
  bool entered_ = false, has_colors_ = false, has_textures_ = false;
  std::unique_ptr<TriangleSource> scene_, stdin_;
  SceneCounts finished_, counts_;
  std::optional<UpAxis> up_;
};

}  // namespace

std::unique_ptr<TriangleSource> open_scenes(std::vector<std::string> paths, const SceneOptions& options) {
  if (paths.empty()) fail(ErrorCode::bad_argument, "no scene was named; name a file, or - for stdin");
  check_stdin_once(paths);
  if (paths.size() == 1) return open_scene(paths[0], options);
  return std::make_unique<SceneRow>(std::move(paths), options);
}

}  // namespace bp
