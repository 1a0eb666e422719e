#include "tools/lod/tileset_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include "io/file.h"
#include "io/tileset_file.h"
#include "lib/core/error.h"

namespace bp {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTileset = "tileset.json";
constexpr const char* kPartial = ".partial";

/// Contents of the tileset in `folder`, if it is one of ours or at least readable.
std::vector<std::string> contents_of(const std::string& folder) {
  std::vector<std::string> uris;
  try {
    for_each_tile(read_tileset(folder + "/" + kTileset), [&](const Tile& tile, const std::string&, const Transform&) {
      if (!tile.uri.empty() && tile.uri.find("..") == std::string::npos && tile.uri[0] != '/') uris.push_back(tile.uri);
    });
  } catch (const Error&) {  // then nothing is known to be ours
    return {};
  }
  return uris;
}

bool holds(const std::string& path, const std::string& bytes) {
  std::error_code missing;
  if (fs::file_size(path, missing) != bytes.size() || missing) return false;
  try {
    return read_text(path, bytes.size()) == bytes;
  } catch (const Error&) {  // not to be read: then it is written
    return false;
  }
}

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

}  // namespace

std::string TilesetFolder::results_of(std::string path) {
  return without_slash(std::move(path)) + kPartial + "/results";
}

TilesetFolder::TilesetFolder(std::string path, const std::vector<std::string>& names, bool overwrite, bool resume)
    : path_(without_slash(std::move(path))), partial_(path_ + kPartial), resume_(resume) {
  files_ = partial_ + "/files";
  replaces_ = overwrite || (resume && fs::exists(partial_));  // interrupted, perhaps while the files were moved
  refuse_if_there(kTileset);
  for (const std::string& name : names) refuse_if_there(name);
  lock();
  std::error_code error;
  if (!resume) fs::remove_all(results(), error);
  fs::remove_all(files_, error);
  fs::create_directories(files_, error);
  if (error) fail(ErrorCode::failed, "{}: cannot make this folder: {}", files_, error.message());
  there_ = fs::exists(path_);
}

void TilesetFolder::refuse_if_there(const std::string& name) const {
  const fs::path path = path_ + "/" + name;
  if (replaces_ || !fs::exists(path) || (fs::is_directory(path) && fs::is_empty(path))) return;
  fail(ErrorCode::bad_argument, "{}: exists; add --overwrite to replace it", path.string());
}

void TilesetFolder::lock() {
  std::error_code error;
  fs::create_directories(partial_, error);
  if (error) fail(ErrorCode::failed, "{}: cannot make this folder: {}", partial_, error.message());
  lock_ = ::open(partial_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(lock_);
    fail(ErrorCode::failed, "{}: another process is at work on it", path_);
  }
}

TilesetFolder::~TilesetFolder() {
  std::error_code ignored;
  fs::remove_all(resume_ ? files_ : partial_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

void TilesetFolder::write(const std::string& name, const std::string& bytes) {
  const bool same = there_ && holds(path_ + "/" + name, bytes);
  if (!same) {
    refuse_if_there(name);
    fs::create_directories(fs::path(files_ + "/" + name).parent_path());
    OutputFile file(files_ + "/" + name, true);
    file.write(bytes);
    file.commit();
  }
  const std::lock_guard lock(mutex_);
  bytes_ += bytes.size();
  names_.push_back(name);
  if (!same) written_.push_back(name);
}

void TilesetFolder::commit() {
  if (there_) {
    move_files();
  } else {
    fs::rename(files_, path_);
  }
  resume_ = false;
  fs::remove_all(partial_);
}

/// Into a folder that is there.
void TilesetFolder::move_files() {
  const std::vector<std::string> before = contents_of(path_);
  std::partition(written_.begin(), written_.end(), [](const std::string& name) { return name != kTileset; });
  for (const std::string& name : written_) {
    fs::create_directories(fs::path(path_ + "/" + name).parent_path());
    fs::rename(files_ + "/" + name, path_ + "/" + name);
  }
  std::sort(names_.begin(), names_.end());
  for (const std::string& name : before) {
    if (std::binary_search(names_.begin(), names_.end(), name)) continue;
    std::error_code ignored;
    fs::remove(path_ + "/" + name, ignored);
    const fs::path folder = fs::path(name).parent_path();
    if (!folder.empty()) fs::remove(path_ / folder, ignored);  // if it is empty now
  }
}

}  // namespace bp
