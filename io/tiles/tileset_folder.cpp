#include "io/tiles/tileset_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <set>

#include "io/files/file.h"
#include "io/files/final_names.h"
#include "io/files/kept_files.h"
#include "io/files/paths.h"
#include "io/tiles/tileset_file.h"
#include "lib/core/error.h"

namespace bp {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTileset = "tileset.json";
constexpr const char* kPartial = "/.partial";
constexpr const char* kMoving = "/moving";
constexpr const char* kImages[] = {".png", ".jpg", ".jpeg", ".webp", ".tga", ".bmp", ".gif", ".ktx2"};

bool is_inside(const std::string& name) {
  return !name.empty() && name.find("..") == std::string::npos && name[0] != '/';
}

/// Returns whether the provenance in a tileset or a GLB tells that bplod made it.
bool was_made_here(const std::string& path) {
  constexpr std::size_t kHead = 65536;  // the asset comes first in all files of this suite
  try {
    const InputFile file(path, NamedBy::file);
    std::string head(kHead, '\0');
    head.resize(file.read_at(0, std::as_writable_bytes(std::span(head))));
    return head.find(R"("tool":"bplod")") != std::string::npos || head.find(R"("tool": "bplod")") != std::string::npos;
  } catch (const Error&) {
    return false;
  }
}

bool names_image(const std::string& name) {
  return std::any_of(std::begin(kImages), std::end(kImages),
                     [&](const char* ending) { return name.ends_with(ending); });
}

std::vector<std::string> contents_of(const std::string& tileset) {
  std::vector<std::string> uris;
  const Tileset read = read_old_tileset(tileset);
  std::copy_if(read.images.begin(), read.images.end(), std::back_inserter(uris), is_inside);
  for_each_tile(read, [&](const Tile& tile, const std::string&, const Transform&) {
    if (is_inside(tile.uri)) uris.push_back(tile.uri);
  });
  return uris;
}

/// Reads names, each followed by a zero: a name may hold any other character.
std::vector<std::string> names_from(const std::string& path) {
  std::vector<std::string> names;
  if (!is_regular_file(path)) return names;
  const std::string text = read_text(path, UINT32_MAX, NamedBy::file);
  for (std::size_t at = 0, end = 0; (end = text.find('\0', at)) != std::string::npos; at = end + 1) {
    names.push_back(text.substr(at, end - at));
    if (!is_inside(names.back())) names.pop_back();
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool holds(const std::string& path, const std::string& bytes) {
  std::error_code missing;
  if (fs::file_size(path, missing) != bytes.size() || missing) return false;
  try {
    return read_text(path, bytes.size(), NamedBy::file) == bytes;
  } catch (const Error&) {  // the existing file cannot be read: it is written anew
    return false;
  }
}

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

}  // namespace

TilesetFolder::TilesetFolder(const std::string& path, const std::vector<std::string>& names, bool overwrite)
    : path_(without_slash(path)),
      partial_(path_ + kPartial),
      files_(partial_ + "/files"),
      overwrite_(overwrite),
      made_(path_) {
  lock();
  try {
    begin(names);
  } catch (...) {
    leave();
    throw;
  }
}

TilesetFolder::~TilesetFolder() {
  leave();
}

void TilesetFolder::lock() {
  if (holds_kept(partial_))
    fail(ErrorCode::bad_argument, "{}: an input lies in it, and would be lost; move it, or name another folder",
         partial_);
  // Set before the folder exists: a signal may come at once.
  folder_ = PartialOutput(partial_, PartialOutput::Kind::folder);
  make_folder(partial_);
  lock_ = ::open(partial_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(lock_);
    fail(ErrorCode::failed, "{}: another process is at work on it", path_);
  }
  work_ = PartialOutput(files_, PartialOutput::Kind::tree);
}

void TilesetFolder::begin(const std::vector<std::string>& names) {
  // Without tileset.json there was no tileset before, and the files of the interrupted one are worthless.
  if (!fs::exists(path_ + "/" + kTileset)) moved_ = names_from(partial_ + kMoving);
  refuse_if_there(kTileset);
  for (const std::string& name : names) refuse_if_there(name);
  std::error_code error;
  fs::remove_all(files_, error);
  make_folder(files_);
}

/// Removes the folder OUT/.partial, unless it still holds the note of an interrupted commit.
void TilesetFolder::leave() {
  std::error_code ignored;
  fs::remove_all(files_, ignored);
  fs::remove(partial_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

/// Returns whether a file may be replaced: with --overwrite, or if an interrupted commit has placed it.
bool TilesetFolder::may_replace(const std::string& name) const {
  return overwrite_ || std::binary_search(moved_.begin(), moved_.end(), name);
}

void TilesetFolder::refuse_if_there(const std::string& name) const {
  const fs::path path = path_ + "/" + name;
  refuse_kept(path.string(), "give the tileset another folder or another name");
  if (may_replace(name) || !fs::exists(path) || (fs::is_directory(path) && fs::is_empty(path))) return;
  const auto below = std::lower_bound(moved_.begin(), moved_.end(), name + "/");
  if (below != moved_.end() && below->starts_with(name + "/")) return;
  fail(ErrorCode::bad_argument, {Remedy::overwrite}, "{}: exists", path.string());
}

void TilesetFolder::write(const std::string& name, const std::string& bytes) {
  const bool same = holds(path_ + "/" + name, bytes);
  if (!same) {
    refuse_if_there(name);
    make_folder(folder_of(files_ + "/" + name));
    OutputFile file(files_ + "/" + name, true, NamedBy::file);
    file.write(bytes);
    file.commit(OutputFile::Sync::content);  // it gets another name later
  }
  const std::lock_guard lock(mutex_);
  bytes_ += bytes.size();
  names_.push_back(name);
  if (!same) written_.push_back(name);
}

/// Returns the files of earlier tilesets. Files of another program's tileset are not removed, nor files that a tileset
/// of this suite names and this suite did not make.
std::vector<std::string> TilesetFolder::names_before() {
  std::vector<std::string> names = names_from(partial_ + kMoving);
  const std::string tileset = path_ + "/" + kTileset;
  if (!is_regular_file(tileset)) return names;
  try {
    const std::vector<std::string> contents = contents_of(tileset);
    if (!was_made_here(tileset)) return names;
    std::copy_if(contents.begin(), contents.end(), std::back_inserter(names),
                 [&](const std::string& name) { return names_image(name) || was_made_here(path_ + "/" + name); });
  } catch (const Error& e) {  // nothing is known about the old tileset then
    complaint_ = e.what();
  }
  return names;
}

void TilesetFolder::commit() {
  const std::vector<std::string> before = names_before(), moved_before = names_from(partial_ + kMoving);
  std::sort(names_.begin(), names_.end());
  note_moves(before, names_);
  try {
    move_files();
  } catch (...) {
    take_back(moved_before);
    throw;
  }
  remove_others(before);
  made_.keep();
  fs::remove(partial_ + kMoving);
}

void TilesetFolder::note_moves(const std::vector<std::string>& before, const std::vector<std::string>& after) const {
  OutputFile note(partial_ + kMoving, true, NamedBy::file);
  for (const std::vector<std::string>* names : {&before, &after}) {
    for (const std::string& name : *names) note.write(name + '\0');
  }
  note.commit();
}

void TilesetFolder::move_file(const std::string& name) {
  const bool replace = may_replace(name);
  place_file(files_ + "/" + name, path_ + "/" + name, replace);
  if (!replace) new_.push_back(name);
}

/// Moves the files. The tileset appears only when all files that it names are in place; then files that it does not
/// name are removed.
void TilesetFolder::move_files() {
  std::set<std::string> folders{path_};
  for (const std::string& name : written_) {
    if (name == kTileset) continue;
    const std::string folder = folder_of(path_ + "/" + name);
    if (folders.insert(folder).second) make_folder(folder);
    move_file(name);
  }
  for (const std::string& folder : folders) sync_folder(folder);
  if (std::find(written_.begin(), written_.end(), kTileset) == written_.end()) return;
  move_file(kTileset);
  sync_folder(path_);
}

/// Takes moved files back after a name was found taken. The note must again list only what may be replaced, or the next
/// run would replace files of others.
void TilesetFolder::take_back(const std::vector<std::string>& moved_before) {
  std::error_code ignored;
  for (const std::string& name : new_) {
    (void)remove_file(path_ + "/" + name);
    const fs::path folder = fs::path(name).parent_path();
    if (!folder.empty()) fs::remove(path_ / folder, ignored);  // removed only if empty
  }
  if (!moved_before.empty()) return note_moves(moved_before, {});
  fs::remove(partial_ + kMoving, ignored);
}

void TilesetFolder::remove_others(const std::vector<std::string>& before) const {
  for (const std::string& name : before) {
    if (std::binary_search(names_.begin(), names_.end(), name)) continue;
    (void)remove_file(path_ + "/" + name);
    std::error_code ignored;
    const fs::path folder = fs::path(name).parent_path();
    if (!folder.empty()) fs::remove(path_ / folder, ignored);  // removed only if empty
  }
}

}  // namespace bp
