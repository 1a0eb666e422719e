#pragma once
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace bp {

/// A folder with a tileset in it. Files are written below a folder beside it, OUT.partial, and move to their places
/// when all are there: with the whole folder, if there was none before, else one by one, tileset.json last. A file that
/// is there already, with the same bytes, is left alone.
class TilesetFolder {
 public:
  /// Takes away the files that an interrupted run left in OUT.partial, and, unless `resume`, its results. Throws
  /// bad_argument if OUT has a tileset.json or one of `names`, `overwrite` is false, and there is nothing to resume;
  /// `failed` if another process is at work on OUT.
  ///   names  of files, or of folders with files, that will be written for certain: those that are there are not found
  ///          out after the work only
  TilesetFolder(std::string path, const std::vector<std::string>& names, bool overwrite, bool resume);
  ~TilesetFolder();  ///< without commit() nothing stays behind but, to resume, the results
  TilesetFolder(const TilesetFolder&) = delete;
  TilesetFolder& operator=(const TilesetFolder&) = delete;

  /// Where results wait to be gone on with; removed by commit().
  [[nodiscard]] std::string results() const { return results_of(path_); }
  [[nodiscard]] static std::string results_of(std::string path);
  /// `name` may hold one folder: "level/tile.glb". Throws bad_argument if OUT has another file of that name, and it is
  /// not to be replaced. Thread-safe.
  void write(const std::string& name, const std::string& bytes);
  /// The files appear; tiles of the tileset that was there before, and that are not among them, go.
  void commit();
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  void lock();
  void refuse_if_there(const std::string& name) const;
  void move_files();
  std::string path_, partial_, files_;
  bool resume_, there_ = false;
  bool replaces_;  ///< files of any tool may be overwritten
  int lock_ = -1;  ///< of OUT.partial; the system lets go of it however the process ends
  std::mutex mutex_;
  std::vector<std::string> names_, written_;  ///< all files; those that are not there already
  std::uint64_t bytes_ = 0;
};

}  // namespace bp
