#pragma once
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "io/files/made_folders.h"
#include "io/files/partial_outputs.h"

namespace bp {

/// A folder with a tileset in it. Files are written to OUT/.partial, in the same file system, and move to their places
/// when all are there, tileset.json last. A file that is there already, with the same bytes, is left alone.
/// OUT/.partial/moving names what moves, and what was there before: a commit that is interrupted is known by it, and
/// whoever writes OUT next goes on with it and takes away what is left over.
class TilesetFolder {
 public:
  /// Makes OUT if it is not there. Takes away the files that an interrupted run left in OUT/.partial. Throws
  /// bad_argument if OUT has a tileset.json or one of `names`, `overwrite` is false, and they are not of a commit that
  /// was interrupted; `failed` if another process is at work on OUT. Files that are kept (io/files/kept_files.h) are
  /// neither replaced nor taken away: bad_argument if one of `names` is one, here or in write(), or if one lies in
  /// OUT/.partial.
  ///   names  of files, or of folders with files, that will be written for certain: those that are there are not found
  ///          out after the work only
  TilesetFolder(const std::string& path, const std::vector<std::string>& names, bool overwrite);
  /// Without commit() nothing stays behind, also after a signal.
  ~TilesetFolder();
  TilesetFolder(const TilesetFolder&) = delete;
  TilesetFolder& operator=(const TilesetFolder&) = delete;

  /// `name` may hold one folder: "level/tile.glb". Throws bad_argument if OUT has another file of that name, and it is
  /// not to be replaced. Thread-safe.
  void write(const std::string& name, const std::string& bytes);
  /// The files appear; tiles of the tileset that was there before, and that are not among them, go. If a name is taken
  /// meanwhile, what is new does not stay.
  void commit();
  /// Why tiles of the tileset that was there before may still be there; empty: they are not.
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
  MadeFolder made_;                 ///< OUT
  PartialOutput work_, folder_;     ///< files_, and partial_: for signal handlers
  int lock_ = -1;                   ///< of partial_; the system lets go of it however the process ends
  std::vector<std::string> moved_;  ///< by a commit that was interrupted; sorted
  std::mutex mutex_;
  std::vector<std::string> names_, written_;  ///< all files; those that are not there already
  std::vector<std::string> new_;              ///< that were moved, and replaced nothing
  std::uint64_t bytes_ = 0;
  std::string complaint_;
};

}  // namespace bp
