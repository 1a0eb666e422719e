#include "tools/cli/help/completion.h"

#include <fmt/format.h>

namespace bp {

namespace {

/// The kinds of names that a shell completes a value with, in addition to words. The value's name tells the kind.
enum class Kind { none, file, folder };

Kind kind_of(const Declaration& d) {
  if (d.value_name.find("DIR") != std::string::npos) return Kind::folder;
  return d.value_name.find("FILE") != std::string::npos ? Kind::file : Kind::none;
}

/// Returns whether an option needs a value. A flag that may carry a word, as `--progress [json]`, does not.
bool needs_value(const Declaration& d) {
  return !d.value_name.empty() && d.value_name.front() != '[';
}

std::string words_of(const Declaration& d) {
  std::string all;
  for (const Word& word : d.words) all += (all.empty() ? "" : " ") + word.text;
  return all;
}

/// Returns a text for the inside of single quotes, with a backslash before each of `marks`. `quote`: how the shell
/// writes a single quote there.
std::string quoted(const std::string& text, const std::string& marks, const std::string& quote) {
  std::string out;
  for (const char c : text) {
    if (marks.find(c) != std::string::npos) out += '\\';
    out += c == '\'' ? quote : std::string(1, c);
  }
  return out;
}

/// Adds an option to the script for bash: its name, and a case that completes its value.
void add_bash_case(const Declaration& d, std::string& cases, std::string& names) {
  std::string pattern;
  for (const std::string& name : parts_of(d.names, ',')) {
    pattern += (pattern.empty() ? "" : "|") + name;
    if (name.starts_with("--")) names += (names.empty() ? "" : " ") + name;
  }
  std::string action = "COMPREPLY=()";
  if (!d.words.empty()) action = "COMPREPLY=($(compgen -W '" + words_of(d) + "' -- \"$cur\"))";
  if (kind_of(d) != Kind::none) action += kind_of(d) == Kind::file ? "; _bp_files -f" : "; _bp_files -d";
  if (needs_value(d)) cases += fmt::format("    {}) {}; return ;;\n", pattern, action);
  if (!needs_value(d) && !d.words.empty())  // the word may be left out
    cases += fmt::format("    {}) {}; [[ -n $cur && ${{#COMPREPLY[@]}} -gt 0 ]] && return ;;\n", pattern, action);
}

std::string bash(const ToolDeclaration& tool) {
  std::string cases, names;
  for (const Declaration& d : tool.options) add_bash_case(d, cases, names);
  return fmt::format(R"(# Completion of {0} for bash; made by: {0} --help bash
_{0}() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} name
  _bp_files() {{
    compopt -o filenames 2> /dev/null
    while IFS= read -r name; do COMPREPLY+=("$name"); done < <(compgen "$1" -- "$cur")
  }}
  # bash splits --name=VALUE into three words
  if [[ $cur == = ]]; then cur=
  elif [[ $prev == = ]]; then prev=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  COMPREPLY=()
  case $prev in
{1}  esac
  if [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W '{2}' -- "$cur"))
  else
    _bp_files -f
  fi
}}
complete -F _{0} {0}
)",
                     tool.tool, cases, names);
}

/// Returns the action of zsh's _arguments that completes a value.
std::string zsh_action(const Declaration& d) {
  const Kind kind = kind_of(d);
  const std::string files = kind == Kind::file ? "_files" : kind == Kind::folder ? "_files -/" : "";
  if (d.words.empty()) return files.empty() ? " " : files;
  const std::string words = "(" + words_of(d) + ")";
  return files.empty() ? words : fmt::format(R"({{_alternative "words\:word\:{}" "files\:file\:{}"}})", words, files);
}

std::string zsh(const ToolDeclaration& tool) {
  std::string specs;
  for (const Declaration& d : tool.options) {
    std::string value;
    if (!d.value_name.empty()) {
      value = needs_value(d) ? ":" : "::";
      value += quoted(d.value_name, ":\\", "'\\''") + ":" + zsh_action(d);
    }
    for (const std::string& option : parts_of(d.names, ',')) {
      const std::string equals = needs_value(d) ? (option.starts_with("--") ? "=" : "+") : "";
      specs += fmt::format("  '{}{}[{}]{}' \\\n", option, equals, quoted(d.help, "[]:\\", "'\\''"), value);
    }
  }
  return fmt::format(
      "#compdef {0}\n# Completion of {0} for zsh; made by: {0} --help zsh\n_arguments -s \\\n{1}  "
      "'*:file:_files'\n",
      tool.tool, specs);
}

std::string fish(const ToolDeclaration& tool) {
  std::string text = fmt::format("# Completion of {0} for fish; made by: {0} --help fish\n", tool.tool);
  for (const Declaration& d : tool.options) {
    std::string line = "complete -c " + tool.tool;
    for (const std::string& name : parts_of(d.names, ','))
      line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    const Kind kind = kind_of(d);
    if (needs_value(d)) line += kind == Kind::file ? " -r -F" : " -x";
    if (kind == Kind::folder) line += " -a '(__fish_complete_directories)'";
    if (!d.words.empty()) line += " -a '" + words_of(d) + "'";
    text += line + " -d '" + quoted(d.help, "\\", "\\'") + "'\n";
  }
  return text;
}

}  // namespace

std::string completion(const ToolDeclaration& tool, const std::string& shell) {
  return shell == "bash" ? bash(tool) : shell == "zsh" ? zsh(tool) : fish(tool);
}

}  // namespace bp
