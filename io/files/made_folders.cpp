#include "io/files/made_folders.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/files/file.h"
#include "lib/core/error.h"

namespace bp {

namespace {

/// Of mkdir(): 0 or errno. A folder that was made is known to `entry` before a signal can end the process.
int make(const std::string& folder, PartialOutput* entry) {
  const WhileMaking making;
  if (::mkdir(folder.c_str(), 0777) != 0) return errno;
  if (entry != nullptr) *entry = PartialOutput(folder, PartialOutput::Kind::folder);
  return 0;
}

/// Why it is no folder, after make() did not make one; 0: it is one.
int why_none(const std::string& folder, int error) {
  struct stat info {};
  if (::stat(folder.c_str(), &info) != 0) return error;
  return S_ISDIR(info.st_mode) ? 0 : ENOTDIR;
}

[[noreturn]] void fail_to_make(const std::string& path, int error) {
  fail(ErrorCode::failed, "{}: cannot make this folder: {}", path, std::strerror(error));
}

}  // namespace

void make_folder(const std::string& path) {
  int error = make(path, nullptr);
  if (error != 0) error = why_none(path, error);
  if (error != 0) fail_to_make(path, error);
}

MadeFolders::MadeFolders(const std::string& path) {
  for (std::size_t end = 0; end != std::string::npos;) {
    end = path.find('/', end + 1);
    const std::string folder = path.substr(0, end);
    PartialOutput entry;
    int error = make(folder, &entry);
    if (error == 0) {
      made_.emplace_back(folder, std::move(entry));
      continue;
    }
    error = why_none(folder, error);
    if (error == 0) continue;
    remove();
    fail_to_make(path, error);
  }
}

MadeFolders::~MadeFolders() {
  remove();
}

void MadeFolders::keep() {
  for (const auto& made : made_) sync_folder(folder_of(made.first));
  made_.clear();
}

void MadeFolders::remove() {
  while (!made_.empty()) {
    ::rmdir(made_.back().first.c_str());
    made_.pop_back();
  }
}

}  // namespace bp
