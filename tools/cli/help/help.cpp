#include "tools/cli/help/help.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <regex>

namespace bp {

namespace {

constexpr std::size_t kHelpColumn = 28, kWordColumn = 8, kHelpWidth = 80;

/// Returns the words of `text` broken into lines, from `column` on; the first line is already begun.
std::string wrapped(const std::string& text, std::size_t column) {
  std::string out;
  std::size_t at = column;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (at + end - begin > kHelpWidth && at > column) {
      out.back() = '\n';  // the blank after the last word
      out.append(column, ' ');
      at = column;
    }
    out.append(text, begin, end - begin) += ' ';
    at += end - begin + 1;
    begin = end + 1;
  }
  if (!out.empty()) out.back() = '\n';
  return out;
}

/// Returns "-s,--scale" and its value as people write it: "-s, --scale LENGTH".
std::string signature(const Declaration& d) {
  std::string out;
  for (const char c : d.names) out += c == ',' ? std::string(", ") : std::string(1, c);
  return out + (d.value_name.empty() ? "" : " " + d.value_name);
}

std::string text_of(const Declaration& d) {
  return d.help + (d.shown_default.empty() ? "" : " (default: " + d.shown_default + ")");
}

/// Returns whether some word has a help text.
bool has_word_help(const Declaration& d) {
  return std::any_of(d.words.begin(), d.words.end(), [](const Word& word) { return !word.help.empty(); });
}

/// Returns the lines of an option: names on the left, text in the right-hand column; below it a line for each word that
/// has a text.
std::string entry(const Declaration& d) {
  std::string out = "  " + signature(d);
  if (out.size() + 2 > kHelpColumn) out += "\n" + std::string(kHelpColumn, ' ');
  if (out.size() < kHelpColumn) out.append(kHelpColumn - out.size(), ' ');
  out += wrapped(text_of(d), kHelpColumn);
  if (!has_word_help(d)) return out;
  std::size_t longest = 0;
  for (const Word& word : d.words) longest = std::max(longest, word.text.size());
  for (const Word& word : d.words) {
    const std::size_t column = kWordColumn + longest + 2;
    out += std::string(kWordColumn, ' ') + fmt::format("{:{}}", word.text, longest + 2) + wrapped(word.help, column);
  }
  return out;
}

/// Calls f(group, its options) for each group in the order of declaration; options without a group come last.
void for_each_group(const std::vector<Declaration>& options,
                    const std::function<void(const std::string&, const std::vector<Declaration>&)>& f) {
  std::vector<std::string> groups;
  for (const Declaration& d : options) {
    if (std::find(groups.begin(), groups.end(), d.group) == groups.end()) groups.push_back(d.group);
  }
  std::stable_partition(groups.begin(), groups.end(), [](const std::string& group) { return !group.empty(); });
  for (const std::string& group : groups) {
    std::vector<Declaration> its;
    std::copy_if(options.begin(), options.end(), std::back_inserter(its),
                 [&](const Declaration& d) { return d.group == group; });
    f(group.empty() ? "Others" : group, its);
  }
}

std::string help_of(const ToolDeclaration& tool, const std::vector<Declaration>& options) {
  std::string text = "Usage: " + tool.tool;
  for (const Declaration& d : tool.options)
    if (d.needed) text += " " + parts_of(d.names, ',').front() + " " + d.value_name;
  text += " [OPTION]...";
  for (const Declaration& d : tool.arguments) text.append(" ").append(d.value_name);
  text += "\n" + wrapped(tool.about, 0) + "\n";
  for (Declaration d : tool.arguments) {
    d.value_name.clear();
    text += entry(d);
  }
  for_each_group(options, [&](const std::string& group, const std::vector<Declaration>& its) {
    text += group + ":\n";
    for (const Declaration& d : its) text += entry(d);
  });
  if (!tool.example.empty()) text += "Example:\n  " + tool.example + "\n";
  return text;
}

/// Returns the text up to the first semicolon, colon or bracket.
std::string first_clause(const std::string& text) {
  return text.substr(0, std::min({text.find("; "), text.find(": "), text.find(" (")}));
}

/// Returns the text with the names of options as code: "`--temp`".
std::string with_code(const std::string& text) {
  static const std::regex option("(^|[ (])(--[a-z][a-z-]*)");
  return std::regex_replace(text, option, "$1`$2`");
}

}  // namespace

std::string short_help(const ToolDeclaration& tool) {
  std::vector<Declaration> often;
  std::copy_if(tool.options.begin(), tool.options.end(), std::back_inserter(often),
               [](const Declaration& d) { return d.often; });
  if (often.empty()) return full_help(tool);
  for (Declaration& d : often) {
    d.help = first_clause(d.help);
    for (Word& word : d.words) word.help = first_clause(word.help);
  }
  const std::size_t others = tool.options.size() - often.size();
  return help_of(tool, often) +
         fmt::format("{0} more options: {1} --help all. The manual: man {1}.\n", others, tool.tool);
}

std::string full_help(const ToolDeclaration& tool) {
  return help_of(tool, tool.options);
}

std::string markdown_help(const ToolDeclaration& tool) {
  std::string text;
  const auto add = [&](const Declaration& d, const std::string& left) {
    text += fmt::format("- `{}`: {}\n", left, with_code(text_of(d)));
    for (const Word& word : d.words) {
      if (!word.help.empty()) text += fmt::format("  - `{}`: {}\n", word.text, with_code(word.help));
    }
  };
  for (const Declaration& d : tool.arguments) add(d, d.names);
  for_each_group(tool.options, [&](const std::string& group, const std::vector<Declaration>& its) {
    text += fmt::format("\n## {}\n\n", group);
    for (const Declaration& d : its) add(d, signature(d));
  });
  return text;
}

}  // namespace bp
