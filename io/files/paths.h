#pragma once
#include <string>

/// Questions about paths.
namespace bp {

/// Returns the same path for all names of a file, symbolic links included; the path as given if that cannot be told.
[[nodiscard]] std::string whole_path(const std::string& path);
/// Makes files that were made, renamed or removed in a folder survive a crash of the machine, if its file system can do
/// that.
void sync_folder(const std::string& path);
/// Returns whether a path leads to a regular file; false if that cannot be told. Other files are not opened: a pipe
/// would be waited for, or lose its first bytes, and a device has no end.
[[nodiscard]] bool is_regular_file(const std::string& path);
/// Returns the first 64 KiB of a file; empty if it cannot be read, or is no regular file.
[[nodiscard]] std::string head_of(const std::string& path);
/// Returns the folder of a path; "." if the path has none.
[[nodiscard]] std::string folder_of(const std::string& path);

}  // namespace bp
