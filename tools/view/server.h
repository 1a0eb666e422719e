#pragma once
#include <memory>
#include <string>

#include "tools/view/session.h"

namespace bp {

/// Answers the page over HTTP, at 127.0.0.1 only (docs/bpview.1.md, "Who gets in").
class Server {
 public:
  /// `port` 0: a free one. Throws out_of_resource if the port is not available. Keeps a reference.
  Server(Session& session, std::uint64_t port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] std::string link() const;           ///< to print
  [[nodiscard]] std::string link_for_once() const;  ///< to start a browser with
  void run();                                       ///< serves until stop()
  void stop();                                      ///< may be called on any thread

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
