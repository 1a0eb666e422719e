#pragma once
#include <mutex>
#include <string>
#include <vector>

namespace bp {

/// Who may talk to the server. A page proves itself once by a token, which the printed link has behind `#`, where no
/// server and no log sees it; from then on by a cookie, which no script reads and no other site sends.
class Access {
 public:
  explicit Access(int port);

  /// For the link to print. It is valid as long as the server.
  [[nodiscard]] const std::string& token() const { return token_; }
  /// For the link that a browser is started with, where other users of the machine may see it: valid once.
  [[nodiscard]] std::string token_for_once();

  /// The cookie to set, with its attributes; empty if the token is not valid.
  [[nodiscard]] std::string cookie_for(const std::string& token);
  /// Of the header Cookie.
  [[nodiscard]] bool has_cookie(const std::string& header) const;
  /// Whether a request was meant for this server. A name that someone made to point here, to have a browser talk to it
  /// (DNS rebinding), is none of the list.
  [[nodiscard]] bool is_host(const std::string& host) const;
  [[nodiscard]] bool is_origin(const std::string& origin) const;

 private:
  std::vector<std::string> hosts_;
  const std::string cookie_name_, token_, secret_;
  std::mutex mutex_;
  std::vector<std::string> once_;
};

}  // namespace bp
