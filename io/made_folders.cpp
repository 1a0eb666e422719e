#include "io/made_folders.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lib/core/error.h"

namespace bp {

MadeFolders::MadeFolders(const std::string& path) {
  for (std::size_t end = 0; end != std::string::npos;) {
    end = path.find('/', end + 1);
    const std::string folder = path.substr(0, end);
    if (::mkdir(folder.c_str(), 0777) == 0) {
      made_.emplace_back(folder, PartialOutput(folder, PartialOutput::Kind::folder));
      continue;
    }
    int error = errno;
    struct stat info {};
    if (::stat(folder.c_str(), &info) == 0) {
      if (S_ISDIR(info.st_mode)) continue;
      error = ENOTDIR;
    }
    remove();
    fail(ErrorCode::failed, "{}: cannot make this folder: {}", path, std::strerror(error));
  }
}

MadeFolders::~MadeFolders() {
  remove();
}

void MadeFolders::remove() {
  while (!made_.empty()) {
    ::rmdir(made_.back().first.c_str());
    made_.pop_back();
  }
}

}  // namespace bp
