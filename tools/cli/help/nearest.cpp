#include "tools/cli/help/nearest.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace bp {

namespace {

/// Returns the number of changes that make `b` of `a`: the optimal string alignment distance.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string lowered(std::string text) {
  for (char& c : text) c = char(std::tolower((unsigned char)c));
  return text;
}

/// A word of other programs, and the word of an option that does the same here.
struct Synonym {
  std::string_view foreign, own;
};

constexpr std::array<Synonym, 20> kSynonyms = {
    {{"unreal", "collision"},  {"unity", "collision"},    {"godot", "collision"},  {"collider", "collision"},
     {"physics", "collision"}, {"hulls", "collision"},    {"glb", "gltf"},         {"lod", "gltf"},
     {"lods", "gltf"},         {"hlod", "gltf"},          {"nanite", "gltf"},      {"imposter", "gltf"},
     {"impostor", "gltf"},     {"cesium", "3dtiles"},     {"cesiumjs", "3dtiles"}, {"tileset", "3dtiles"},
     {"culling", "occluder"},  {"occlusion", "occluder"}, {"deform", "cage"},      {"lattice", "cage"}}};

/// Returns the word among `words` that means here what `text` means in other programs; empty if there is none.
std::string synonym(const std::string& text, const std::vector<std::string>& words) {
  for (const Synonym& s : kSynonyms)
    if (s.foreign == text && std::find(words.begin(), words.end(), s.own) != words.end()) return std::string(s.own);
  return "";
}

/// Returns a word that holds the text, as "3dtiles" does "tiles", or lies in it; names of options are compared without
/// their dashes.
std::string containing(const std::string& text, const std::vector<std::string>& words) {
  constexpr std::size_t kFewest = 4;
  const auto letters = [](const std::string& word) {
    return word.substr(std::min(word.find_first_not_of('-'), word.size()));
  };
  const std::string slip = letters(text);
  for (const std::string& word : words) {
    const std::string own = letters(word);
    if (own.size() >= kFewest && slip.size() >= kFewest &&
        (own.find(slip) != std::string::npos || slip.find(own) != std::string::npos))
      return word;
  }
  return "";
}

}  // namespace

std::string nearest_word(const std::string& slip, const std::vector<std::string>& words) {
  constexpr std::size_t kLongest = 64, kLettersPerChange = 3;
  const std::string text = lowered(slip);
  const std::size_t dashes = std::min(text.find_first_not_of('-'), text.size()), letters = text.size() - dashes;
  if (letters < 2 || text.size() > kLongest) return "";
  std::string nearest = synonym(text, words);
  if (!nearest.empty()) return nearest;
  std::size_t least = letters / kLettersPerChange + 1;  // changes must be fewer
  for (const std::string& word : words) {
    if (word.starts_with(text)) return word;
    const std::size_t changes = distance(text, word);
    if (changes >= least) continue;
    least = changes;
    nearest = word;
  }
  return nearest.empty() ? containing(text, words) : nearest;
}

std::string did_you_mean(const std::string& slip, const std::vector<std::string>& words) {
  const std::string word = nearest_word(slip, words);
  return word.empty() ? "" : "; did you mean " + word + "?";
}

}  // namespace bp
