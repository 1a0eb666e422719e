#pragma once
#include <deque>
#include <memory>
#include <string>

#include "tools/view/proxy_job.h"

namespace bp {

/// The proxies that a session has made and had checked, so that they can be compared. Not thread-safe.
class MadeProxies {
 public:
  /// Keeps the last proxies whose files together have at most so many bytes, and kMost at most.
  explicit MadeProxies(std::uint64_t bytes) : bytes_(bytes) {}
  static constexpr std::size_t kMost = 60;

  /// Adds the proxy of a job, if it is ready, has a verdict and is not there.
  void add(const ProxyJob::Status& job);
  /// Returns a list: number, revision of the design, faces that were requested, and those of the verdict's level.
  [[nodiscard]] Json json() const;
  /// Returns the GLB with this number; throws bad_argument if it is not kept.
  [[nodiscard]] std::shared_ptr<const std::string> file(std::uint64_t number) const;

 private:
  struct Made {
    std::uint64_t number = 0;
    Json facts;
    std::shared_ptr<const std::string> file;
  };
  const std::uint64_t bytes_;
  std::uint64_t kept_bytes_ = 0;
  std::deque<Made> made_;
};

}  // namespace bp
