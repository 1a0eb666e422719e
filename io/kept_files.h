#pragma once
#include <string>

/// The files that this process reads. None of them is ever replaced, removed or written over by it, whatever it is
/// called: another path, a symbolic link and a hard link name the same file. OutputFile, place_file() and
/// remove_file() (io/final_names.h) ask here. Thread-safe.
namespace bp {

/// From now on this file is kept; "-" is stdin, if that is a file. Of a scene, also the files that it names
/// (parts_of_scene()). A path that names nothing yet is kept as a name. Costs a look at the file's inode.
void keep_scene(const std::string& path);
/// The file alone, for what opens it: a reader of buffers, of materials.
void keep_file(const std::string& path);

/// Throws bad_argument if `path` names a file that is kept: it says why, and gives `remedy`.
void refuse_kept(const std::string& path, const char* remedy = "give the output another name");
/// Nothing is kept any more: another run begins in this process, as in tests.
void forget_kept();
/// Whether `path` names a file that is kept.
[[nodiscard]] bool is_kept(const std::string& path);
/// Whether a file that is kept lies in this folder, or below.
[[nodiscard]] bool holds_kept(const std::string& folder);

}  // namespace bp
