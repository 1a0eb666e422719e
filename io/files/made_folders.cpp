#include "io/files/made_folders.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/files/paths.h"
#include "lib/core/error.h"

namespace bp {

namespace {

/// Makes a folder; returns 0 or errno of mkdir(). `entry` knows the folder before a signal can end the process.
int make(const std::string& folder, PartialOutput* entry) {
  const WhileMaking making;
  if (::mkdir(folder.c_str(), 0777) != 0) return errno;
  if (entry != nullptr) *entry = PartialOutput(folder, PartialOutput::Kind::folder);
  return 0;
}

/// Returns why there is no folder after make() failed with `error`; 0 if there is one.
int why_none(const std::string& folder, int error) {
  struct stat info {};
  if (::stat(folder.c_str(), &info) != 0) return error;
  return S_ISDIR(info.st_mode) ? 0 : ENOTDIR;
}

[[noreturn]] void fail_to_make(const std::string& path, int error) {
  std::string name = path;
  while (name.size() > 1 && name.ends_with('/')) name.pop_back();
  if (error == ENOENT) fail_for_folder(name);
  fail(ErrorCode::failed, "{}: cannot make this folder: {}", path, std::strerror(error));
}

}  // namespace

void fail_for_folder(const std::string& path) {
  const std::string folder = folder_of(path);
  if (why_none(folder, ENOENT) == 0) fail(ErrorCode::failed, "{}: {} takes no files", path, folder);
  fail(ErrorCode::bad_argument, "{}: there is no folder {}; make it (mkdir -p), or name another output", path, folder);
}

void make_folder(const std::string& path) {
  int error = make(path, nullptr);
  if (error != 0) error = why_none(path, error);
  if (error != 0) fail_to_make(path, error);
}

MadeFolder::MadeFolder(const std::string& path) : path_(path) {
  int error = make(path, &entry_);
  made_ = error == 0;
  if (!made_) error = why_none(path, error);
  if (error != 0) fail_to_make(path, error);
}

MadeFolder::~MadeFolder() {
  if (made_) ::rmdir(path_.c_str());
}

void MadeFolder::keep() {
  if (made_) sync_folder(folder_of(path_));
  made_ = false;
  entry_ = {};
}

}  // namespace bp
