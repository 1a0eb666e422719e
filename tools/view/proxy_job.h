#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "tools/cli/report.h"
#include "tools/view/commands.h"
#include "tools/view/tool_worker.h"

namespace bp {

/// Makes proxies of a design and has them checked. The tools themselves do it, so the file is that of the command line.
/// A new request ends the one at work.
class ProxyJob {
 public:
  enum class Step { none, meshing, checking, ready, failed, stopped };
  struct Status {
    Step step = Step::none;
    std::uint64_t revision = 0, faces = 0;    ///< revision of the design, and faces that were requested
    std::shared_ptr<const std::string> file;  ///< GLB; present while it is checked, too
    std::uint64_t number = 0;                 ///< number of the file; rises with each file
    Json verdict;                             ///< as brief_verdict() has it; null: not known
    std::string notes;                        ///< messages of the tools, one a line
    double mesh_seconds = 0, check_seconds = 0;
  };

  /// `stream`: the voxels of the scene, as bpvox wrote them. `changed` is called on a thread of this object. Keeps
  /// references.
  ProxyJob(const ViewOptions& options, const MemoryFile& stream, std::function<void()> changed);

  void request(std::string rules, std::uint64_t revision, std::uint64_t faces);
  void stop();  ///< ends the work that is going on
  [[nodiscard]] Status status() const;

 private:
  struct Request {
    std::string rules;
    std::uint64_t revision = 0, faces = 0;
  };
  void make(ToolPipe& pipe, const Request& request);
  /// Returns false if the tools were stopped or failed. The status tells which.
  bool run(ToolPipe& pipe, const std::vector<ToolCommand>& commands, const std::vector<const MemoryFile*>& inputs,
           const MemoryFile& out, bool is_check);
  void set(const std::function<void(Status&)>& change);

  const ViewOptions& options_;
  const MemoryFile& stream_;
  const std::function<void()> changed_;
  mutable std::mutex mutex_;
  Status status_;
  ToolWorker worker_;  // the last member: its tasks use the others
};

}  // namespace bp
