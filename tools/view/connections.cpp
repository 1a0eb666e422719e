#include "tools/view/connections.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

namespace bp {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr Clock::duration kStranger = 30s, kHurried = 200ms;  // for one request, with its answer
constexpr std::chrono::milliseconds kGlance{20};              // so often a waiting connection looks whether others wait

}  // namespace

/// The socket of a connection, as httplib reads and writes it.
class PatientServer::Connection final : public httplib::Stream {
 public:
  Connection(PatientServer& server, socket_t socket)
      : server_(server), socket_(socket), reading_(server.read_timeout_sec_), writing_(server.write_timeout_sec_) {}

  bool welcomed = false;
  /// Waits for a request. Returns false if there is none for long.
  bool begin_request() {
    began_ = Clock::now();
    return at_ < end_ || wait(POLLIN, std::chrono::seconds(server_.keep_alive_timeout_sec_));
  }
  /// Returns true if this is a stranger while others wait.
  [[nodiscard]] bool is_in_the_way() const { return !welcomed && server_.open_ > server_.threads_; }

  [[nodiscard]] bool is_readable() const override { return at_ < end_ || wait(POLLIN, reading_); }
  [[nodiscard]] bool is_writable() const override { return wait(POLLOUT, writing_); }
  ssize_t read(char* to, std::size_t size) override {
    if (at_ == end_) {
      if (!wait(POLLIN, reading_)) return -1;
      const ssize_t n = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
      if (n <= 0) return n;
      at_ = 0;
      end_ = std::size_t(n);
    }
    const std::size_t n = std::min(size, end_ - at_);
    std::memcpy(to, buffer_.data() + at_, n);
    at_ += n;
    return ssize_t(n);
  }
  /// Writes all, and at once only what there is room for, so that a slow reader is noticed.
  ssize_t write(const char* from, std::size_t size) override {
    for (std::size_t done = 0; done < size;) {
      if (!is_writable()) return -1;
      const ssize_t n = ::send(socket_, from + done, size - done, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (n < 0 && errno != EAGAIN && errno != EINTR) return -1;
      done += std::size_t(std::max(n, ssize_t(0)));
    }
    return ssize_t(size);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  [[nodiscard]] bool is_overdue(Clock::time_point now) const {
    return !welcomed && now - began_ > (is_in_the_way() ? kHurried : kStranger);
  }
  /// Waits until bytes come, or go. Returns false if nothing happens for so long, or if the connection is overdue.
  [[nodiscard]] bool wait(short events, std::chrono::seconds most) const {
    for (const Clock::time_point begin = Clock::now();;) {
      const Clock::time_point now = Clock::now();
      if (is_overdue(now) || now - begin > most || server_.svr_sock_ == INVALID_SOCKET) return false;
      pollfd one{socket_, events, 0};
      const int ready = ::poll(&one, 1, int(kGlance.count()));
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return false;
    }
  }

  PatientServer& server_;
  const socket_t socket_;
  const std::chrono::seconds reading_, writing_;
  Clock::time_point began_ = Clock::now();
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0, end_ = 0;  ///< of the bytes in the buffer that were not read yet
};

namespace {
thread_local PatientServer::Connection* at_work = nullptr;

/// Threads that take one connection after the other.
class Queue final : public httplib::ThreadPool {
 public:
  Queue(int threads, std::atomic<int>& open) : ThreadPool(std::size_t(threads)), open_(open) {}
  void enqueue(std::function<void()> connection) override {
    ++open_;
    ThreadPool::enqueue(std::move(connection));
  }

 private:
  std::atomic<int>& open_;
};
}  // namespace

PatientServer::PatientServer(int threads) : threads_(threads) {
  new_task_queue = [this] { return new Queue(threads_, open_); };
}

void PatientServer::welcome() {
  if (at_work != nullptr) at_work->welcomed = true;
}

bool PatientServer::process_and_close_socket(socket_t socket) {
  Connection connection(*this, socket);
  at_work = &connection;
  answer(connection);
  at_work = nullptr;
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  --open_;
  return true;
}

void PatientServer::answer(Connection& connection) {
  for (std::size_t left = keep_alive_max_count_; left > 0 && connection.begin_request(); --left) {
    bool closed = false;
    if (!process_request(connection, left == 1 || connection.is_in_the_way(), closed, nullptr) || closed) return;
  }
}

}  // namespace bp
