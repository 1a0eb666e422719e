#pragma once
#include <cstddef>
#include <string>
#include <vector>

/// The declaration of a tool's command line, from which help, manuals and completion are made.
namespace bp {

/// A word that an option takes as its value.
struct Word {
  std::string text, help;  ///< help: may be empty
};

struct Declaration {
  std::string names;            ///< "-s,--scale"; the name of an argument
  std::string value_name = {};  ///< "LENGTH"; empty: a flag
  std::string help = {}, shown_default = {}, group = {};
  std::vector<Word> words = {};  ///< all values, or those of many that are words
  bool often = false;            ///< an option that most people need: `--help` shows it, not only `--help all`
  bool needed = false;           ///< every command line needs it: the line "Usage" shows it
};

struct ToolDeclaration {
  std::string tool, about, example;
  std::vector<Declaration> arguments, options;
};

/// Returns the parts of "a|b|c" or "-s,--scale".
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
