#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "tools/cli/report.h"
#include "tools/view/commands.h"
#include "tools/view/files/shown_files.h"
#include "tools/view/tool_worker.h"

namespace bp {

/// The files that are shown beside a scene, and the answers of bpcheck about them. The page names a file by its number.
/// Thread-safe.
class Layers {
 public:
  /// Reads what --show names, without its triangles. `changed` is called on a thread of this object. Keeps a reference.
  /// Throws as shown_files().
  Layers(const ViewOptions& options, std::function<void()> changed);

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
  void prove(ToolPipe& pipe, std::size_t i);
  void set(std::size_t i, State state);

  const ViewOptions& options_;
  const std::vector<ShownFile> files_;
  const std::function<void()> changed_;
  mutable std::mutex mutex_;
  std::vector<State> states_;
  ToolWorker worker_;  // the last member: its tasks use the others
};

}  // namespace bp
