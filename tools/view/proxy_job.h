#pragma once
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "tools/cli/report.h"
#include "tools/view/commands.h"

namespace bp {

/// Makes proxies of a design, and has them checked: by the tools themselves, so that the file is what the command line
/// makes. A new request ends the one at work.
class ProxyJob {
 public:
  enum class Step { none, meshing, checking, ready, failed, stopped };
  struct Status {
    Step step = Step::none;
    std::uint64_t revision = 0, faces = 0;    ///< of the design, and asked for
    std::shared_ptr<const std::string> file;  ///< GLB; there while it is checked, too
    std::uint64_t number = 0;                 ///< of the file: rises with each
    Json verdict;                             ///< of bpcheck: answer, why, triangles, farthest; null: not known
    std::string notes;                        ///< what the tools said, a line each
    double mesh_seconds = 0, check_seconds = 0;
  };

  /// `stream`: the voxels of the scene, as bpvox wrote them. changed: called on a thread of this object. Keeps
  /// references.
  ProxyJob(const ViewOptions& options, const MemoryFile& stream, std::function<void()> changed);
  ~ProxyJob();
  ProxyJob(const ProxyJob&) = delete;
  ProxyJob& operator=(const ProxyJob&) = delete;

  void request(std::string rules, std::uint64_t revision, std::uint64_t faces);
  void stop();  ///< ends what is at work
  [[nodiscard]] Status status() const;

 private:
  struct Request {
    std::string rules;
    std::uint64_t revision = 0, faces = 0;
  };
  void work();
  void make(const Request& request);
  /// False if the tools were stopped or failed: then that is known.
  bool run(const std::vector<ToolCommand>& commands, const std::vector<const MemoryFile*>& inputs,
           const MemoryFile& out, bool is_check);
  void set(const std::function<void(Status&)>& change);

  const ViewOptions& options_;
  const MemoryFile& stream_;
  const std::function<void()> changed_;
  ToolPipe pipe_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::unique_ptr<Request> next_;
  bool ends_ = false;
  Status status_;
  std::thread thread_;  // last: it begins when all else is there
};

}  // namespace bp
