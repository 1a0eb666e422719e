#include "tools/view/access.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns 128 random bits as hexadecimal digits.
std::string random_text() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
    fail(ErrorCode::out_of_resource, "the system gives no random numbers");
  std::string text;
  for (const unsigned char b : bytes) text += fmt::format("{:02x}", b);
  return text;
}

/// Compares in the same time, wherever the texts differ.
bool equal(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= (unsigned char)(a[i] ^ b[i]);
  return difference == 0;
}

}  // namespace

Access::Access(int port)
    : hosts_{fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port)},
      cookie_name_(fmt::format("bpview_{}", port)),  // all ports of a host share their cookies
      token_(random_text()),
      secret_(random_text()) {}

std::string Access::token_for_once() {
  const std::lock_guard lock(mutex_);
  return once_.emplace_back(random_text());
}

std::string Access::cookie_for(const std::string& token) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(once_.begin(), once_.end(), [&](const std::string& t) { return equal(t, token); });
  if (found == once_.end() && !equal(token, token_)) return "";
  if (found != once_.end()) once_.erase(found);
  return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name_, secret_);
}

bool Access::has_cookie(const std::string& header) const {
  const std::string wanted = cookie_name_ + "=" + secret_;
  for (std::size_t at = 0; at < header.size();) {
    std::size_t end = std::min(header.find(';', at), header.size());
    std::string_view one(header.data() + at, end - at);
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (equal(one, wanted)) return true;
    at = end + 1;
  }
  return false;
}

bool Access::is_host(const std::string& host) const {
  return std::find(hosts_.begin(), hosts_.end(), host) != hosts_.end();
}

bool Access::is_origin(const std::string& origin) const {
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && is_host(origin.substr(kScheme.size()));
}

}  // namespace bp
