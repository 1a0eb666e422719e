#include "tools/cli/help/completion.h"

#include <fmt/format.h>

namespace bp {

namespace {

/// What a shell completes a value with. Folders and files are told by the name of the value.
enum class Kind { none, words, file, folder };

Kind kind_of(const Declaration& d) {
  if (d.value_name.find("DIR") != std::string::npos) return Kind::folder;
  if (d.value_name.find("FILE") != std::string::npos) return Kind::file;
  return d.words.empty() ? Kind::none : Kind::words;
}

/// A flag that may carry a word, as `--progress [json]`, needs none.
bool needs_value(const Declaration& d) {
  return !d.value_name.empty() && d.value_name.front() != '[';
}

std::string words_of(const Declaration& d) {
  std::string all;
  for (const Word& word : d.words) all += (all.empty() ? "" : " ") + word.text;
  return all;
}

/// Without what would end a quoted text of a shell.
std::string quotable(std::string text, const std::string& without) {
  for (char& c : text) {
    if (without.find(c) != std::string::npos) c = ' ';
  }
  return text;
}

/// What bash completes after an option, and the names of all.
void add_bash_case(const Declaration& d, std::string& cases, std::string& names) {
  std::string pattern;
  for (const std::string& name : parts_of(d.names, ',')) {
    pattern += (pattern.empty() ? "" : "|") + name;
    if (name.starts_with("--")) names += (names.empty() ? "" : " ") + name;
  }
  const std::string words = "COMPREPLY=($(compgen -W '" + words_of(d) + "' -- \"$cur\"))";
  const Kind kind = kind_of(d);
  std::string action = "COMPREPLY=()";
  if (kind == Kind::words) action = words;
  if (kind == Kind::file) action = (d.words.empty() ? "" : words + "; ") + "_bp_files -f";
  if (kind == Kind::folder) action = "_bp_files -d";
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

std::string zsh(const ToolDeclaration& tool) {
  std::string specs;
  for (const Declaration& d : tool.options) {
    const std::string text = quotable(d.help, "'[]:\\`$\"");
    const Kind kind = kind_of(d);
    std::string value;
    if (!d.value_name.empty()) {
      const std::string name = quotable(d.value_name, "'[]:\\|");
      const std::string action = kind == Kind::words    ? "(" + words_of(d) + ")"
                                 : kind == Kind::file   ? "_files"
                                 : kind == Kind::folder ? "_files -/"
                                                        : " ";
      value = (needs_value(d) ? ":" : "::") + name + ":" + action;
    }
    for (const std::string& option : parts_of(d.names, ',')) {
      const std::string equals = needs_value(d) ? (option.starts_with("--") ? "=" : "+") : "";
      specs += fmt::format("  '{}{}[{}]{}' \\\n", option, equals, text, value);
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
    text += line + " -d '" + quotable(d.help, "'\\") + "'\n";
  }
  return text;
}

}  // namespace

std::string completion(const ToolDeclaration& tool, const std::string& shell) {
  return shell == "bash" ? bash(tool) : shell == "zsh" ? zsh(tool) : fish(tool);
}

}  // namespace bp
