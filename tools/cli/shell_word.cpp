#include "tools/cli/shell_word.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace bp {

std::string shell_word(const std::string& name) {
  if (name.starts_with('-') && name.size() > 1) return shell_word("./" + name);
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c > 127 || std::strchr("_./+-,:@%=", c) != nullptr;
  });
  if (plain && !name.empty()) return name;
  std::string word = "'";
  for (const char c : name) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

}  // namespace bp
