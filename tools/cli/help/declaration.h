#pragma once
#include <cstddef>
#include <string>
#include <vector>

/// What a tool declares of its command line: help, manuals and completion are made of it.
namespace bp {

/// A word that an option takes as its value.
struct Word {
  std::string text, help;  ///< help: may be empty
};

struct Declaration {
  std::string names;            ///< "-s,--scale"; of an argument its name
  std::string value_name = {};  ///< "LENGTH"; empty: a flag
  std::string help = {}, shown_default = {}, group = {};
  std::vector<Word> words = {};  ///< all values, or those of many that have a name
  bool often = false;            ///< most people need it: `--help` shows it, and not only `--help all`
  bool needed = false;           ///< no command line is without it: the line "Usage" shows it
};

struct ToolDeclaration {
  std::string tool, about, example;
  std::vector<Declaration> arguments, options;
};

/// "a|b|c", or "-s,--scale", in its parts.
[[nodiscard]] inline std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end =
        text.find(separator, begin) == std::string::npos ? text.size() : text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace bp
