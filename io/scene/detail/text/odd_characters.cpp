#include "io/scene/detail/text/odd_characters.h"

namespace bp {

namespace {

bool is_control(unsigned char c) {
  return c < ' ' && c != '\t' && c != '\n' && c != '\r';
}

/// Returns whether all is ASCII without odd characters. Looks at many bytes at once.
bool is_plain(std::string_view text) {
  unsigned char odd = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    odd |=
        static_cast<unsigned char>((byte >= 0x80) | ((byte < ' ') & (byte != '\t') & (byte != '\n') & (byte != '\r')));
  }
  return odd == 0;
}

/// Returns whether the last of three bytes ends a blank or a line end of Unicode, in UTF-8.
bool ends_blank(std::uint32_t bytes) {
  const std::uint32_t two = bytes & 0xFFFF;
  return two == 0xC285 || two == 0xC2A0 || bytes == 0xE19A80 || (bytes >= 0xE28080 && bytes <= 0xE2808A) ||
         bytes == 0xE280A8 || bytes == 0xE280A9 || bytes == 0xE280AF || bytes == 0xE2819F || bytes == 0xE38080 ||
         bytes == 0xEFBBBF;
}

}  // namespace

void OddCharacters::note() {
  lines_ += noted_ ? 0 : 1;
  noted_ = true;
}

void OddCharacters::add(unsigned char c) {
  if (ends_) note();
  ends_ = c == 0x1A;
  last_bytes_ = (last_bytes_ << 8 | c) & 0xFFFFFF;
  if (is_control(c) ? !ends_ : c >= 0x80 && ends_blank(last_bytes_)) note();
  if (c == '\n' || c == '\r') noted_ = false;
}

void OddCharacters::add(std::string_view part) {
  if (part.empty()) return;
  if (is_plain(part) && !ends_) {
    noted_ = false;  // a line is longer than the part, or ends in it
    last_bytes_ = 0;
    return;
  }
  for (const char c : part) add(static_cast<unsigned char>(c));
}

}  // namespace bp
