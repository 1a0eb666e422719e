#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "tools/cli/report.h"
#include "tools/view/commands.h"
#include "tools/view/files/shown_files.h"

namespace bp {

/// The files that are shown beside a scene, and the answers of bpcheck about them. The page names a file by its number.
/// Thread-safe.
class Layers {
 public:
  /// Reads what --show names, without its triangles. `changed` is called on a thread of this object. Keeps a reference.
  /// Throws as shown_files().
  Layers(const ViewOptions& options, std::function<void()> changed);
  ~Layers();
  Layers(const Layers&) = delete;
  Layers& operator=(const Layers&) = delete;

  [[nodiscard]] std::size_t size() const { return files_.size(); }
  [[nodiscard]] const ShownFile& file(std::size_t i) const;  ///< throws bad_argument if there is no such file
  [[nodiscard]] Json json() const;
  /// Begins to prove what a file claims; if it claims nothing, that it encloses the scene. Throws bad_argument for
  /// voxels.
  void check(std::size_t i);

 private:
  enum class Step { none, waiting, checking, done, failed };
  struct State {
    Step step = Step::none;
    std::shared_ptr<const Json> verdict;  ///< null: none yet
    std::string notes;
  };
  void work();
  void prove(std::size_t i);
  void set(std::size_t i, State state);

  const ViewOptions& options_;
  const std::vector<ShownFile> files_;
  const std::function<void()> changed_;
  ToolPipe pipe_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::size_t> waiting_;
  std::vector<State> states_;
  bool ends_ = false;
  std::thread thread_;  // the last member: the thread begins when all others exist
};

}  // namespace bp
