#include "io/files/kept_files.h"

#include <sys/stat.h>

#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "io/files/paths.h"
#include "lib/core/error.h"

namespace bp {

namespace {

struct Identity {
  dev_t device = 0;
  ino_t inode = 0;
  friend auto operator<=>(const Identity&, const Identity&) = default;
};

/// Returns the identity of a regular file; none for other files, since writing to a device or a pipe replaces nothing.
std::optional<Identity> identity_of(const std::string& path) {
  struct stat info {};
  const bool there = path == "-" ? ::fstat(0, &info) == 0 : ::stat(path.c_str(), &info) == 0;
  if (!there || !S_ISREG(info.st_mode)) return {};
  return Identity{info.st_dev, info.st_ino};
}

class KeptFiles {
 public:
  /// A kept file: its name as it was given, and the scene that names it, if it is not an input itself.
  struct Entry {
    std::string path, owner;
  };

  void begin() {
    const std::scoped_lock lock(mutex_);
    ++scopes_;
  }

  void end() {
    const std::scoped_lock lock(mutex_);
    if (--scopes_ > 0) return;
    names_.clear();
    identities_.clear();
    unread_.clear();
    const std::scoped_lock looking(looked_for_mutex_);
    looked_for_.clear();
  }

  void add(const std::string& path, PartsOfFile parts) {
    const std::scoped_lock lock(mutex_);
    if (scopes_ == 0) return;
    add_entry({path, ""});
    if (parts && path != "-") unread_.push_back({path, parts});
  }

  /// Also called by what read_parts() calls.
  void look_for(const std::string& path) {
    const std::scoped_lock lock(looked_for_mutex_);
    if (scopes_ > 0 && !path.empty() && path != "-") looked_for_.insert(path);
  }

  std::vector<std::string> paths() {
    const std::scoped_lock lock(mutex_);
    read_parts();
    const std::scoped_lock looking(looked_for_mutex_);
    std::set<std::string> all = looked_for_;
    for (const auto& [whole, entry] : names_) all.insert(entry.path);
    return {all.begin(), all.end()};
  }

  std::optional<Entry> find(const std::string& path) {
    const std::scoped_lock lock(mutex_);
    const std::optional<Identity> id = identity_of(path);
    if (id) read_parts();  // a missing file is no part of a scene
    const auto named = names_.find(whole_path(path));
    if (named != names_.end()) return named->second;
    return id ? find_identity(*id) : std::nullopt;
  }

  bool any_below(const std::string& folder) {
    const std::scoped_lock lock(mutex_);
    read_parts();
    const std::string prefix = whole_path(folder) + "/";
    const auto next = names_.lower_bound(prefix);
    return next != names_.end() && next->first.starts_with(prefix);
  }

 private:
  void add_entry(const Entry& entry) {
    if (entry.path != "-") names_.try_emplace(whole_path(entry.path), entry);
    if (const auto id = identity_of(entry.path)) identities_.insert_or_assign(*id, entry);
  }

  /// Returns the kept file with this inode. The inode of a removed file may be used again, so the kept name must still
  /// lead to it.
  std::optional<Entry> find_identity(const Identity& id) {
    const auto found = identities_.find(id);
    if (found == identities_.end() || identity_of(found->second.path) != id) return {};
    return found->second;
  }

  void read_parts() {
    for (const auto& [owner, parts] : std::exchange(unread_, {})) {
      for (const std::string& part : parts(owner)) add_entry({part, owner});
    }
  }

  std::mutex mutex_;
  std::atomic<int> scopes_ = 0;         ///< number of living KeepsInputs
  std::map<std::string, Entry> names_;  ///< by whole path
  std::map<Identity, Entry> identities_;
  std::mutex looked_for_mutex_;
  std::set<std::string> looked_for_;
  std::vector<std::pair<std::string, PartsOfFile>> unread_;  ///< files whose parts were not asked for yet
};

KeptFiles& kept_files() {
  static KeptFiles files;
  return files;
}

}  // namespace

KeepsInputs::KeepsInputs() {
  kept_files().begin();
}

KeepsInputs::~KeepsInputs() {
  kept_files().end();
}

void keep_file(const std::string& path) {
  kept_files().add(path, nullptr);
}

void keep_file_and_parts(const std::string& path, PartsOfFile parts) {
  kept_files().add(path, parts);
}

void note_looked_for(const std::string& path) {
  kept_files().look_for(path);
}

std::vector<std::string> read_paths() {
  return kept_files().paths();
}

void refuse_kept(const std::string& path, const char* remedy) {
  const auto entry = kept_files().find(path);
  if (!entry) return;
  if (!entry->owner.empty())
    fail(ErrorCode::bad_argument, "{}: belongs to the input {}, and would be lost; {}", path,
         entry->owner.substr(entry->owner.rfind('/') + 1), remedy);
  fail(ErrorCode::bad_argument, "{}: is an input, and would be lost; {}", path, remedy);
}

bool is_kept(const std::string& path) {
  return kept_files().find(path).has_value();
}

bool holds_kept(const std::string& folder) {
  return kept_files().any_below(folder);
}

}  // namespace bp
