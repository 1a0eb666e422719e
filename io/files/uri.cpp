#include "io/files/uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace bp {

namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_unreserved(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || std::string_view("-._~/").find(c) != std::string_view::npos;
}
bool is_control(char c) {
  return static_cast<unsigned char>(c) < ' ' || c == '\x7F';
}

int digit(char c) {
  return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
}

/// Decodes %XX; nothing if a % has no two hexadecimal digits, or stands for a character that separates or ends names.
std::optional<std::string> percent_decoded(const std::string& text) {
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size() || digit(text[i + 1]) < 0 || digit(text[i + 2]) < 0) return {};
      c = char(16 * digit(text[i + 1]) + digit(text[i + 2]));
      if (c == '/' || c == '\\' || is_control(c)) return {};
      i += 2;
    }
    path += c;
  }
  return path;
}

/// Returns whether the URI begins with a scheme, or with the letter of a drive.
bool has_scheme(const std::string& uri) {
  const std::size_t end = uri.find_first_of(":/?#");
  return end != std::string::npos && uri[end] == ':';
}

/// Returns the text without control characters, which could look like more of a message.
std::string shown(const std::string& uri) {
  std::string text;
  for (const char c : uri) text += is_control(c) ? fmt::format("%{:02X}", (unsigned char)c) : std::string(1, c);
  return text;
}

UriFile fault(std::string what) {
  return {"", std::move(what)};
}

}  // namespace

UriFile file_of_uri(const std::string& uri, const std::string& folder) {
  if (uri.find("://") < uri.find_first_of("?#")) return fault("lies on the network; download it");
  if (uri.starts_with("data:")) return fault("is embedded, which is not read");
  const bool plain = std::none_of(uri.begin(), uri.end(), [](char c) { return c == '\\' || is_control(c); });
  if (!plain || uri.starts_with(' ') || uri.ends_with(' ') || uri.starts_with('/') || has_scheme(uri))
    return fault(
        fmt::format("is named \"{}\", and programs disagree on which file that is; name one beside it", shown(uri)));
  const std::optional<std::string> name = percent_decoded(uri.substr(0, uri.find_first_of("?#")));
  // Viewers take a folder and ".." away before they ask for the file, be the folder there or not.
  const std::string path = std::filesystem::path(name.value_or("")).lexically_normal().string();
  if (path.empty() || path.ends_with('/') || path.ends_with('.'))
    return fault(fmt::format("is named \"{}\", which is no file", shown(uri)));
  return {folder.empty() ? path : folder + "/" + path, ""};
}

namespace detail {

std::string percent_encoded(const std::string& path) {
  std::string uri;
  for (const char c : path) uri += is_unreserved(c) ? std::string(1, c) : fmt::format("%{:02X}", (unsigned char)c);
  return uri;
}

}  // namespace detail

}  // namespace bp
