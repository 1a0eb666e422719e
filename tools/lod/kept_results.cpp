#include "tools/lod/kept_results.h"

#include <filesystem>
#include <fstream>

#include "io/store/result_store.h"
#include "lib/store/source_digest.h"

namespace bp {

namespace {

/// A store that reads the results of a folder and adds none.
class LookUpStore final : public ResultStore {
 public:
  explicit LookUpStore(const std::string& folder) {
    if (std::filesystem::is_directory(folder)) results_ = open_result_store(folder);
  }
  bool get(const ResultKey& key, std::string& out) override { return results_ && results_->get(key, out); }
  void put(const ResultKey&, std::string_view) override {}

 private:
  std::unique_ptr<ResultStore> results_;
};

/// Tells whether this build's results are in a cache, and other builds'.
struct Owners {
  bool mine = false, others = false;
};

/// Finds the builds whose results a cache may hold. A file named after the digest of a program's sources tells that it
/// was here. `leave`: also leaves this build's file if possible, dated now, since old files may be deleted.
Owners owners_of(const std::string& folder, bool leave) {
  constexpr std::string_view kName = "made-by-";
  std::error_code error;
  bool mine = false, others = false;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    const bool tells = name.starts_with(kName);
    mine = mine || (tells && name.substr(kName.size()) == source_digest());
    // Results are in folders ab/, and some builds left no file of their own.
    others = others || tells || name.size() == 2;
  }
  if (leave) {
    const auto file = std::filesystem::path(folder) / (std::string(kName) + std::string(source_digest()));
    if (!mine) std::ofstream{file};
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
  }
  return {mine, others};
}

}  // namespace

std::unique_ptr<ResultStore> open_kept_results(const BuildOptions& o, std::string& fault) {
  if (o.cache.empty()) return nullptr;
  std::function<void(const std::string&)> on_failure;
  if (!o.tiles) on_failure = [&fault](const std::string& why) { fault = why; };
  std::unique_ptr<ResultStore> results = open_result_store(o.cache, on_failure);
  static_cast<void>(owners_of(o.cache, true));
  return results;
}

std::unique_ptr<ResultStore> look_up_kept_results(const std::string& path) {
  return std::make_unique<LookUpStore>(path);
}

bool has_own_results(const BuildOptions& options) {
  return !options.cache.empty() && owners_of(options.cache, false).mine;
}

std::string cache_note(const BuildOptions& options) {
  if (options.cache.empty()) return "";
  const Owners owners = owners_of(options.cache, false);
  if (owners.mine || !owners.others) return "";
  return options.cache + ": holds results of other builds of bplod, and none of this one: all is made anew";
}

}  // namespace bp
