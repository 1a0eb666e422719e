#pragma once
#include <mutex>
#include <string>
#include <vector>

namespace bp {

/// Decides who may talk to the server. A page proves itself once by a token, which the printed link has behind `#`,
/// where no server and no log sees it. From then on it proves itself by a cookie, which no script reads and no other
/// site sends.
class Access {
 public:
  explicit Access(int port);

  /// Returns the token for the link to print. It is valid as long as the server runs.
  [[nodiscard]] const std::string& token() const { return token_; }
  /// Returns a token that is valid once, for the link that a browser is started with: other users of the machine may
  /// see it.
  [[nodiscard]] std::string token_for_once();

  /// Returns the cookie to set, with its attributes; empty if the token is not valid.
  [[nodiscard]] std::string cookie_for(const std::string& token);
  /// Returns whether the header Cookie has the cookie.
  [[nodiscard]] bool has_cookie(const std::string& header) const;
  /// Returns whether a request was meant for this server. In DNS rebinding, someone makes a name point here so that a
  /// browser talks to this server; such a name is not on the list.
  [[nodiscard]] bool is_host(const std::string& host) const;
  [[nodiscard]] bool is_origin(const std::string& origin) const;

 private:
  std::vector<std::string> hosts_;
  const std::string cookie_name_, token_, secret_;
  std::mutex mutex_;
  std::vector<std::string> once_;
};

}  // namespace bp
