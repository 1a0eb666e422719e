#pragma once
#include <string>
#include <vector>

/// Files that are read are kept: while a KeepsInputs lives, this process neither replaces nor removes them, whatever
/// they are called. Another path, a symbolic link and a hard link name the same file. OutputFile, place_file() and
/// remove_file() (io/files/final_names.h) ask here. Thread-safe.
namespace bp {

/// A tool's main has one. Without one nothing is kept: a program may read a file with this library and write it later.
/// When the last of several ends, nothing is kept any more.
class KeepsInputs {
 public:
  KeepsInputs();
  ~KeepsInputs();
  KeepsInputs(const KeepsInputs&) = delete;
  KeepsInputs& operator=(const KeepsInputs&) = delete;
};

/// From now on this file is kept; "-" is stdin, if that is a file. A path that names nothing yet is kept as a name.
/// Costs a look at the file's inode. A scene is kept with its parts: keep_scene(), io/scene/scene_parts.h.
void keep_file(const std::string& path);
/// The files that a file names. Called once, and only when somebody asks whether a file is kept.
using PartsOfFile = std::vector<std::string> (*)(const std::string& path);
/// The file, and what `parts` finds in it.
void keep_file_and_parts(const std::string& path, PartsOfFile parts);

/// Throws bad_argument if `path` names a file that is kept: it says why, and gives `remedy`.
void refuse_kept(const std::string& path, const char* remedy = "give the output another name");
/// Whether `path` names a file that is kept.
[[nodiscard]] bool is_kept(const std::string& path);
/// Whether a file that is kept lies in this folder, or below.
[[nodiscard]] bool holds_kept(const std::string& folder);

}  // namespace bp
