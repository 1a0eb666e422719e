#include "io/files/beside.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "io/files/file.h"
#include "io/files/kept_files.h"
#include "io/files/lower.h"

namespace bp {

namespace {

bool is_whole_path(const std::string& name) {
  return name.starts_with('/');
}

/// Returns whether the name begins with a drive, as "C:/a.png" of another machine. Here such a name is in no folder.
bool has_drive(const std::string& name) {
  return name.size() > 2 && name[1] == ':' && name[2] == '/';
}

std::string in_folder(const std::string& folder, const std::string& name) {
  return folder.empty() || is_whole_path(name) ? name : folder.ends_with('/') ? folder + name : folder + "/" + name;
}

/// Returns the name without quotes around it, and with slashes in place of backslashes.
std::string cleaned(std::string name) {
  const bool quoted = name.size() > 2 && name.front() == name.back() && (name[0] == '"' || name[0] == '\'');
  if (quoted) name = name.substr(1, name.size() - 2);
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

/// Returns the entry of a folder that has this name in letters of any case; empty if there is none.
std::string entry_like(const std::string& folder, const std::string& name) {
  const std::string wanted = lower(name);
  std::string found;
  std::error_code unreadable;
  note_looked_for(folder.empty() ? "." : folder);
  for (std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, unreadable), end;
       !unreadable && entry != end; entry.increment(unreadable)) {
    std::string one = entry->path().filename().string();
    if (lower(one) == wanted && (found.empty() || one < found)) found = std::move(one);
  }
  return found;
}

/// Returns an existing path whose parts equal those of `name` but for the case of letters; empty if there is none.
std::string path_like(const std::string& folder, const std::string& name) {
  std::string path = is_whole_path(name) ? "/" : folder;
  std::istringstream parts(name);
  for (std::string part; std::getline(parts, part, '/');) {
    if (part.empty()) continue;
    std::error_code unknown;
    const std::string exact = in_folder(path, part);
    const std::string entry = std::filesystem::exists(exact, unknown) ? part : entry_like(path, part);
    if (entry.empty()) return "";
    path = in_folder(path, entry);
  }
  return is_regular_file(path) ? path : "";
}

}  // namespace

std::string find_beside(const std::string& folder, const std::string& name) {
  const std::string plain = cleaned(name), bare = plain.substr(plain.find_last_of('/') + 1);
  const std::string path = in_folder(folder, plain), near = in_folder(folder, bare);
  for (const std::string& one : {in_folder(folder, name), path, near}) {
    if (is_regular_file(one)) return one;
    note_looked_for(one);
  }
  for (const std::string& one : {plain, bare}) {
    if (const std::string found = path_like(folder, one); !found.empty()) return found;
  }
  return has_drive(plain) ? near : path;
}

}  // namespace bp
