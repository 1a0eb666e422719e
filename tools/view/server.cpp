#include "tools/view/server.h"

#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <mutex>

#include "lib/core/error.h"
#include "tools/cli/advice.h"
#include "tools/view/access.h"
#include "tools/view/connections.h"
#include "tools/view/geometry/wire.h"
#include "tools/view/page_files.h"

namespace bp {

namespace {

using Request = httplib::Request;
using Response = httplib::Response;
using Handled = httplib::Server::HandlerResponse;

constexpr std::size_t kMostBody = 1 << 20;  ///< bytes; a stroke of 10,000 points has less
constexpr int kThreads = 24;                ///< each holds one connection
constexpr int kMostListeners = 8;
constexpr int kReadSeconds = 5, kWriteSeconds = 20, kIdleSeconds = 2;
constexpr std::chrono::seconds kPing{10};
constexpr const char *kBytes = "application/octet-stream", *kJson = "application/json";
constexpr std::size_t kAtATime = 1 << 18;  ///< bytes of a scene that are handed over together

const httplib::Headers& headers() {
  static const httplib::Headers all{
      {"Content-Security-Policy", "default-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Referrer-Policy", "no-referrer"},
      {"Cache-Control", "no-store"},
  };
  return all;
}

void refuse(Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(Json{{"error", text}}.dump(), kJson);
  response.set_header("Connection", "close");  // the body of the request was not read
}

int status_of(ErrorCode code) {
  if (code == ErrorCode::bad_input || code == ErrorCode::bad_argument) return 400;
  return code == ErrorCode::out_of_resource ? 413 : 500;  // 413: a file has more than this server shows
}

/// Calls `make`, which sets the content. Refused input is an answer, not a failure of the server.
template <class Make>
void answer(Response& response, const Make& make) {
  try {
    make();
  } catch (const Error& e) {
    response.status = status_of(e.code());
    response.set_content(Json{{"error", advised(e)}}.dump(-1, ' ', false, Json::error_handler_t::replace), kJson);
  }
}

/// Returns a number of the request's address; 0 if it is missing. Throws bad_argument if it is no number.
std::uint64_t number_in(const Request& request, const char* key) {
  const std::string text = request.get_param_value(key);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (!text.empty() && (error != std::errc() || end != text.data() + text.size()))
    fail(ErrorCode::bad_argument, "{}: is no number", key);
  return number;
}

/// Returns a point of the request's address: x, y and z. Throws bad_argument if one is missing or no finite number.
Vec3d point_in(const Request& request) {
  Vec3d point{};
  for (const std::size_t i : {0, 1, 2}) {
    const std::string text = request.get_param_value(std::string(1, "xyz"[i]));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), point[i]);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(point[i]))
      fail(ErrorCode::bad_argument, "{}: is no coordinate", "xyz"[i]);
  }
  return point;
}

/// Binds the port that is wanted, or any free one. Returns the port, or -1. Connections inherit the options of this
/// socket.
int bound(httplib::Server& http, int wanted) {
  http.set_tcp_nodelay(true);                    // else each small answer waits 40 ms for the client's acknowledgement
  http.set_socket_options([](socket_t socket) {  // httplib would share the port with others
    const int yes = 1;
    (void)::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  if (wanted == 0) return http.bind_to_any_port("127.0.0.1");
  return http.bind_to_port("127.0.0.1", wanted) ? wanted : -1;
}

const char* const kNoPage = R"(<!doctype html><html lang="en"><meta charset="utf-8"><title>bpview</title>
<h1>bpview has no page</h1>
<p>This bpview was built where npm was missing, or had no network. Install npm, run the build again, and start bpview anew.</p>
</html>
)";

}  // namespace

struct Server::State {
  State(Session& of, int wanted);
  Handled check(const Request& request, Response& response);
  void add_geometry();
  void add_routes();
  void add_page();
  void listen(const Request& request, Response& response);
  void send_scene(Response& response);
  void send_surface(std::uint64_t after, Response& response);
  [[nodiscard]] bool is_open(const Request& request) const;
  /// Handles a step of the design or the like.
  httplib::Server::Handler doing(const std::function<void(const std::string& body)>& act);

  Session& session;
  PatientServer http{kThreads};
  const int port;
  Access access;
  std::atomic<int> listeners{0};
  std::mutex meshes;  ///< held while a mesh is made, or the scene read
};

Server::State::State(Session& of, int wanted) : session(of), port(bound(http, wanted)), access(port) {
  if (port <= 0) fail(ErrorCode::out_of_resource, "no port of 127.0.0.1 can be had, or --port names one that is taken");
  http.set_payload_max_length(kMostBody);
  http.set_read_timeout(kReadSeconds);
  http.set_write_timeout(kWriteSeconds);
  http.set_keep_alive_max_count(1000);
  http.set_keep_alive_timeout(kIdleSeconds);
  http.set_default_headers(headers());
  http.set_pre_routing_handler([this](const Request& q, Response& r) { return check(q, r); });
  http.set_exception_handler([](const Request&, Response& response, const std::exception_ptr&) {
    refuse(response, 500, "unexpected failure");
  });
  add_page();
  add_geometry();
  add_routes();
}

/// Returns whether a request needs no cookie: the page itself, which holds no secret, and the exchange of the token.
bool Server::State::is_open(const Request& request) const {
  if (request.path == "/session" || request.path == "/") return true;
  for (const PageFile& file : page_files()) {
    if (request.path == file.path) return true;
  }
  return false;
}

Handled Server::State::check(const Request& request, Response& response) {
  const auto stop = [&](int status, const char* text) {
    refuse(response, status, text);
    return Handled::Handled;
  };
  if (request.get_header_value_count("Host") != 1 || !access.is_host(request.get_header_value("Host")))
    return stop(421, "this server has another name");
  if (request.method != "GET" && request.method != "POST") return stop(405, "GET and POST only");
  if (request.method == "POST" && !access.is_origin(request.get_header_value("Origin")))
    return stop(403, "another site may not change the design");
  if (const std::string site = request.get_header_value("Sec-Fetch-Site");
      !is_open(request) && !site.empty() && site != "same-origin")
    return stop(403, "another site may not read the design");
  const bool own = access.has_cookie(request.get_header_value("Cookie"));
  if (!is_open(request) && !own) return stop(401, "open the link that bpview printed");
  if (own) PatientServer::welcome();
  return Handled::Unhandled;
}

void Server::State::add_page() {
  for (const PageFile& file : page_files()) {
    const auto send = [&file](const Request&, Response& response) {
      response.set_header("Content-Encoding", "gzip");
      response.set_content(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size(), file.type);
    };
    http.Get(file.path, send);
    if (std::string_view(file.path) == "/index.html") http.Get("/", send);
  }
  if (page_files().empty()) {
    http.Get("/", [](const Request&, Response& response) { response.set_content(kNoPage, "text/html"); });
  }
}

httplib::Server::Handler Server::State::doing(const std::function<void(const std::string& body)>& act) {
  return [act](const Request& request, Response& response) {
    answer(response, [&] {
      act(request.body);
      response.set_content("{}", kJson);
    });
  };
}

void Server::State::add_geometry() {
  // One is made at a time, since each takes memory meanwhile.
  const auto made = [this](const char* path, const char* type, const auto& make) {
    http.Get(path, [this, type, make](const Request& request, Response& response) {
      answer(response, [&] {
        const std::lock_guard one(meshes);
        response.set_content(make(request), type);
      });
    });
  };
  http.Get("/api/scene", [this](const Request&, Response& response) { send_scene(response); });
  http.Get("/api/surface", [this](const Request& request, Response& response) {
    answer(response, [&] { send_surface(number_in(request, "after"), response); });
  });
  made("/api/proxy", kBytes, [this](const Request& request) {
    return session.proxy(number_in(request, "number"), number_in(request, "distances") == 1);
  });
  made("/api/layer", kBytes, [this](const Request& request) {
    return session.layer(number_in(request, "file"), number_in(request, "level"), number_in(request, "distances") == 1);
  });
  made("/api/parts", kJson, [this](const Request&) { return session.scene().part_names(); });
  made("/api/part", kJson, [this](const Request& request) { return session.scene().part_at(point_in(request)); });
}

void Server::State::add_routes() {
  http.Post("/session", [this](const Request& request, Response& response) {
    const std::string cookie = access.cookie_for(request.body);
    if (cookie.empty()) return refuse(response, 403, "the link is not valid; open the one that bpview printed");
    response.set_header("Set-Cookie", cookie);
    response.set_content("{}", kJson);
  });
  const auto json = [this](const char* path, const auto& make) {
    http.Get(path, [make](const Request&, Response& response) { response.set_content(make(), kJson); });
  };
  json("/api/state", [this] { return session.state(); });
  json("/api/rules", [this] { return session.rules(); });
  http.Get("/api/events", [this](const Request& request, Response& response) { listen(request, response); });
  http.Post("/api/edit", [this](const Request& request, Response& response) {
    answer(response, [&] { response.set_content(Json{{"revision", session.edit(request.body)}}.dump(), kJson); });
  });
  http.Post("/api/save", doing([this](const std::string& body) { session.save(body); }));
  http.Post("/api/check", doing([this](const std::string& body) { session.check(body); }));
  http.Post("/api/mesh", doing([this](const std::string&) { session.mesh(); }));
  http.Post("/api/stop", doing([this](const std::string&) { session.stop(); }));
}

/// Sends the scene from where it is: a copy for each page would take its memory again.
void Server::State::send_scene(Response& response) {
  const std::string& bytes = session.scene().bytes();
  if (bytes.empty()) return response.set_content("", kBytes);
  response.set_content_provider(bytes.size(), kBytes,
                                [&bytes](std::size_t at, std::size_t left, httplib::DataSink& sink) {
                                  return sink.write(bytes.data() + at, std::min(left, kAtATime));
                                });
}

/// Sends a surface in the parts in which it is made.
void Server::State::send_surface(std::uint64_t after, Response& response) {
  const auto parts = std::make_shared<SurfaceParts>(session.surface(after));
  response.set_chunked_content_provider(kBytes, [parts](std::size_t, httplib::DataSink& sink) {
    try {
      const std::string some = parts->next();
      if (!some.empty()) return sink.write(some.data(), some.size());
      sink.done();
      return true;
    } catch (const std::exception&) {
      return false;  // the page sees an answer without an end
    }
  });
}

/// Sends events: the state, whenever it changes, and a comment now and then, so that the server notices a page that is
/// gone.
void Server::State::listen(const Request&, Response& response) {
  if (++listeners > kMostListeners) {
    --listeners;
    return refuse(response, 503, "too many pages are open");
  }
  auto seen = std::make_shared<std::uint64_t>(0);
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, seen](std::size_t, httplib::DataSink& sink) {
        const std::uint64_t number = session.events().wait(*seen, kPing);
        if (session.events().ended()) {
          sink.done();
          return true;
        }
        const std::string text = number == *seen ? ":\n\n" : "data: " + session.state() + "\n\n";
        *seen = number;
        return sink.write(text.data(), text.size());
      },
      [this](bool) { --listeners; });
}

Server::Server(Session& session, std::uint64_t port) : state_(std::make_unique<State>(session, int(port))) {}

Server::~Server() = default;

std::string Server::link() const {
  return fmt::format("http://127.0.0.1:{}/#{}", state_->port, state_->access.token());
}

std::string Server::link_for_once() const {
  return fmt::format("http://127.0.0.1:{}/#{}", state_->port, state_->access.token_for_once());
}

void Server::run() {
  if (!state_->http.listen_after_bind()) fail(ErrorCode::failed, "the server ended unexpectedly");
}

void Server::stop() {
  state_->session.events().end();
  state_->http.stop();
}

}  // namespace bp
