#include "io/files/uri.h"

#include <fmt/format.h>

namespace bp::detail {

namespace {

bool is_unreserved(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string("-._~/").find(c) != std::string::npos;
}

}  // namespace

std::string percent_encoded(const std::string& path) {
  std::string uri;
  for (const char c : path) uri += is_unreserved(c) ? std::string(1, c) : fmt::format("%{:02X}", (unsigned char)c);
  return uri;
}

std::string percent_decoded(const std::string& uri) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
  };
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      path += char(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

}  // namespace bp::detail
