#pragma once
#include <httplib.h>

#include <atomic>

namespace bp {

/// An HTTP server that strangers cannot keep from answering. A connection has a thread as long as it lasts, and is a
/// stranger's until one of its requests is welcomed. While more connections are open than there are threads, a stranger
/// has a moment for one request, and is ended then; else it has half a minute. So connections that send or read byte by
/// byte, or nothing, keep nobody waiting for long, however many they are.
class PatientServer final : public httplib::Server {
 public:
  explicit PatientServer(int threads);
  /// Tells that the request of this thread is one of the page's own. To be called by a handler.
  static void welcome();

  class Connection;

 private:
  bool process_and_close_socket(socket_t socket) override;
  void answer(Connection& connection);

  const int threads_;
  std::atomic<int> open_{0};  ///< connections: those that have a thread, and those that wait for one
};

}  // namespace bp
