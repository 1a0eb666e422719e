#pragma once
#include <string>
#include <vector>

/// Files that are read are kept: while a KeepsInputs lives, this process neither replaces nor removes them, by whatever
/// name. A second path, a symbolic link and a hard link lead to the same file. OutputFile, place_file() and
/// remove_file() (io/files/final_names.h) ask here. Thread-safe.
namespace bp {

/// Turns keeping on. A tool's main has one. Without one nothing is kept, since a program may read a file with this
/// library and write it later. When the last of several ends, nothing is kept any more.
class KeepsInputs {
 public:
  KeepsInputs();
  ~KeepsInputs();
  KeepsInputs(const KeepsInputs&) = delete;
  KeepsInputs& operator=(const KeepsInputs&) = delete;
};

/// Keeps this file from now on; "-" is stdin, if that is a file. A path that does not exist yet is kept as a name.
/// Cost: one look at the file's inode. For a scene with its parts: keep_scene(), io/scene/scene_parts.h.
void keep_file(const std::string& path);
/// Returns the files that a file names. Called once, and only when somebody asks whether a file is kept.
using PartsOfFile = std::vector<std::string> (*)(const std::string& path);
/// Keeps the file, and the files that `parts` finds in it.
void keep_file_and_parts(const std::string& path, PartsOfFile parts);

/// Notes a path that was looked for: if a file appears there, or other files in that folder, this process would have
/// read other files. For read_paths() while a KeepsInputs lives; nothing is kept.
void note_looked_for(const std::string& path);
/// Returns the paths on which it depends what this process has read: the kept files, those that they name and that are
/// not there, and those of note_looked_for(). Each once, as it was given, without stdin.
[[nodiscard]] std::vector<std::string> read_paths();

/// Throws bad_argument, with the reason and `remedy`, if `path` names a kept file.
void refuse_kept(const std::string& path, const char* remedy = "give the output another name");
/// Returns whether `path` names a kept file.
[[nodiscard]] bool is_kept(const std::string& path);
/// Returns whether this folder, or one below it, has a kept file.
[[nodiscard]] bool holds_kept(const std::string& folder);

}  // namespace bp
