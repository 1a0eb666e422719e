#pragma once
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "io/files/made_folders.h"
#include "io/files/partial_outputs.h"

namespace bp {

/// A folder with a tileset. Files are written to OUT/.partial, in the same file system, and move to their places when
/// all are complete, tileset.json last. An existing file with the same bytes is left alone. OUT/.partial/moving names
/// the files that move, and those that were there before: it marks an interrupted commit, which the next process that
/// writes OUT continues, and whose leftovers it removes.
class TilesetFolder {
 public:
  /// Makes OUT if it does not exist. Removes the files that an interrupted run left in OUT/.partial. Throws
  /// bad_argument if OUT has a tileset.json or one of `names`, `overwrite` is false, and they do not come from an
  /// interrupted commit; `failed` if another process is at work on OUT. Kept files (io/files/kept_files.h) are neither
  /// replaced nor removed: throws bad_argument if one of `names` is kept, here or in write(), or if a kept file lies in
  /// OUT/.partial.
  ///   names  files, or folders with files, that will surely be written: existing ones are then reported before the
  /// work
  TilesetFolder(const std::string& path, const std::vector<std::string>& names, bool overwrite);
  /// Removes everything that was not committed, even after a signal.
  ~TilesetFolder();
  TilesetFolder(const TilesetFolder&) = delete;
  TilesetFolder& operator=(const TilesetFolder&) = delete;

  /// Writes a file. `name` may hold one folder: "level/tile.glb". Throws bad_argument if OUT already has a different
  /// file of this name that may not be replaced. Thread-safe.
  void write(const std::string& name, const std::string& bytes);
  /// Moves the files into place, and removes tiles of the previous tileset that are not among them. If a name was taken
  /// meanwhile, new files do not stay.
  void commit();
  /// Returns why tiles of the previous tileset may still exist; empty: none does.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  void lock();
  void begin(const std::vector<std::string>& names);
  void leave();
  void refuse_if_there(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names_before();
  void note_moves(const std::vector<std::string>& before, const std::vector<std::string>& after) const;
  void move_files();
  void move_file(const std::string& name);
  void take_back(const std::vector<std::string>& moved_before);
  [[nodiscard]] bool may_replace(const std::string& name) const;
  void remove_others(const std::vector<std::string>& before) const;

  std::string path_, partial_, files_;
  bool overwrite_;
  MadeFolder made_;                 ///< made OUT
  PartialOutput work_, folder_;     ///< entries of the partial files and of their folder, for signal handlers
  int lock_ = -1;                   ///< lock on partial_; the system releases it however the process ends
  std::vector<std::string> moved_;  ///< files that an interrupted commit has moved; sorted
  std::mutex mutex_;
  std::vector<std::string> names_, written_;  ///< all files; those of them that were written
  std::vector<std::string> new_;              ///< files that were moved and replaced nothing
  std::uint64_t bytes_ = 0;
  std::string complaint_;
};

}  // namespace bp
