#include "io/scene/detail/exact/ac3d_layers.h"

#include <algorithm>
#include <string_view>

namespace bp {

namespace {

constexpr std::string_view kBlank = " \t\r";

/// Returns the text without blanks at its ends.
std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  const std::size_t last = text.find_last_not_of(kBlank);
  return text.substr(0, last == text.npos ? 0 : last + 1);
}

bool is_other_layer(std::string_view line) {
  constexpr std::string_view kTexture = "texture";
  line = trimmed(line);
  if (!line.starts_with(kTexture)) return false;
  line.remove_prefix(kTexture.size());
  if (line.empty() || kBlank.find(line.front()) == kBlank.npos) return false;
  line = trimmed(line);
  if (!line.starts_with('"')) return true;
  const std::size_t end = line.find('"', 1);
  const std::string_view layer = end == line.npos ? "" : trimmed(line.substr(end + 1));
  return layer == "tiled" || layer == "skids" || layer == "shad";
}

}  // namespace

void keep_base_layers(std::span<char> ac3d) {
  for (auto line = ac3d.begin(); line != ac3d.end();) {
    const auto end = std::find(line, ac3d.end(), '\n');
    // An unknown word is passed over. An empty line would end the object.
    if (is_other_layer({&*line, std::size_t(end - line)})) *std::find(line, end, 't') = '#';
    line = end == ac3d.end() ? end : end + 1;
  }
}

}  // namespace bp
