#include "tools/cli/args.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <span>

#include "io/files/file.h"
#include "lib/core/error.h"
#include "lib/store/source_digest.h"
#include "tools/cli/help/completion.h"
#include "tools/cli/help/help.h"
#include "tools/cli/help/nearest.h"
#include "tools/cli/names.h"

namespace bp {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : "|") + word;
  return all;
}

std::vector<std::string> texts_of(const std::vector<Word>& words) {
  std::vector<std::string> texts;
  for (const Word& word : words) texts.push_back(word.text);
  return texts;
}

std::string help_of(const std::string& word, const ToolDeclaration& tool) {
  if (word == "all") return full_help(tool);
  if (word == "markdown") return markdown_help(tool);
  return word.empty() ? short_help(tool) : completion(tool, word);
}

bool is_there(const std::string& path) {
  std::error_code none;
  return std::filesystem::exists(path, none);
}

/// Returns whether a name that does not exist looks like an output: a stream or a folder.
bool is_like_output(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  return path != "-" && (name.extension().empty() || name.extension() == ".bpv") && !is_there(path);
}

}  // namespace

struct Args::State {
  std::string tool, about, example;
  std::deque<std::string> words;  ///< words of the command line that are not parsed yet
  std::string current;            ///< the word that is parsed now
  std::vector<Option> options, positionals;
  std::map<std::string, std::string> removed;  ///< options of earlier versions, and what replaces them
  std::string group;                           ///< group of the options that are declared next
  std::optional<std::string> help;             ///< the word of --help
  bool version = false;

  Option* look_up(const std::string& name);
  Option& find(const std::string& name, const std::string& word = "");
  void take(Option& option, const std::string& name, const std::string& text);
  void parse_long(const std::string& word);
  void parse_short(const std::string& word);
  void parse_value(Option& option, const std::string& name);
  void check_names(std::span<const std::string> names);
  void parse_positionals(const std::vector<std::string>& texts);
};

Args::Args(std::string tool, int argc, const char* const* argv) : state_(new State) {
  state_->tool = std::move(tool);
  state_->words.assign(argv + std::min(argc, 1), argv + argc);
}

Args::~Args() = default;

const std::string& Args::tool() const {
  return state_->tool;
}

void Args::about(const std::string& text) {
  state_->about = text;
}

void Args::example(const std::string& text) {
  state_->example = text;
}

void Args::add(Option option) {
  option.group = state_->group;
  state_->options.push_back(std::move(option));
}

void Args::group(const std::string& name) {
  state_->group = name;
}

void Args::often(std::initializer_list<const char*> names) {
  for (const char* const name : names) state_->find(name).often = true;
}

void Args::needed(const char* name) {
  state_->find(name).needed = true;
}

void Args::words(std::vector<Word> words) {
  state_->options.back().words = std::move(words);
}

void Args::removed(const std::string& name, const std::string& replacement) {
  state_->removed[name] = replacement;
}

void Args::positional(const std::string& name, std::string& value, const std::string& help) {
  const auto set = [&value](const std::string& text) { value = text; };
  state_->positionals.push_back({{name, "[" + name + "]", help, value}, set, Value::optional});
}

void Args::positional(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  const auto set = [&values](const std::string& text) { values.push_back(text); };
  const std::string shown_name = name + (name.find("...") == std::string::npos ? "..." : "");
  const Value needed = name.ends_with("...]") ? Value::optional : Value::required;
  state_->positionals.push_back({{shown_name, shown_name, help}, set, needed, true});
}

void Args::option(const std::string& names, const std::string& value_name, std::vector<std::string>& values,
                  const std::string& help) {
  const auto set = [&values](const std::string& text) { values.push_back(text); };
  add({{names, value_name, help}, set, Value::required, true});
}

void Args::option(const std::string& names, const std::string& value_name, Setter set, const std::string& help) {
  add({{names, value_name, help}, std::move(set)});
}

void Args::flag(const std::string& names, const std::function<void()>& set, const std::string& help) {
  add({{names, "", help}, [set](const std::string&) { set(); }, Value::none, true});
}

void Args::flag(const std::string& names, bool& value, const std::string& help) {
  flag(
      names, [&value] { value = true; }, help);  // may be given twice
}

void Args::flag_with_word(const std::string& name, const std::vector<std::string>& words, Setter set,
                          const std::string& help) {
  add({{name, "[" + joined(words) + "]", help}, std::move(set), Value::optional, true});
  for (const std::string& word : words) state_->options.back().words.push_back({word, ""});
}

void Args::refuse_word(const std::string& text, const std::string& words) {
  fail(ErrorCode::bad_argument, "'{}' is none of {}{}", text, words, did_you_mean(text, parts_of(words, '|')));
}

std::string Args::shown(UpAxis value) {
  return name_of(value);
}

void Args::parse_into(const std::string& text, UpAxis& value) {
  const std::optional<UpAxis> up = up_axis_named(text);
  if (!up) refuse_word(text, "x|y|z|-x|-y|-z");
  value = *up;
}

std::string Args::shown(double value) {
  return fmt::format("{}", value);
}

Args::Option* Args::State::look_up(const std::string& name) {
  for (Option& option : options) {
    const std::string names = "," + option.names + ",";
    if (names.find("," + name + ",") != std::string::npos) return &option;
  }
  return nullptr;
}

/// Finds an option. `word`: the text on the command line, if it is longer than the name: "-faces" for -f.
Args::Option& Args::State::find(const std::string& name, const std::string& word) {
  if (Option* const option = look_up(name)) return *option;
  if (const auto gone = removed.find(name); gone != removed.end())
    fail(ErrorCode::bad_argument, "there is no option {} any more; {}", name, gone->second);
  std::vector<std::string> names;
  for (const Option& option : options) {
    const std::vector<std::string> own = parts_of(option.names, ',');
    names.insert(names.end(), own.begin(), own.end());
  }
  const std::string slip = word.empty() ? name : "-" + word;
  std::string hint = is_there(current) ? "; did you mean the file ./" + current + "?" : "";
  if (hint.empty()) hint = did_you_mean(slip, names);
  fail(ErrorCode::bad_argument, "there is no option {}{}", name, hint);
}

void Args::State::take(Option& option, const std::string& name, const std::string& text) {
  if (option.times++ > 0 && !option.repeatable) fail(ErrorCode::bad_argument, "{} is given twice", name);
  if (text.empty() && option.value == Value::required)
    fail(ErrorCode::bad_argument, "{} is empty; was a variable not set?", name);
  if (!text.empty() && option.value == Value::optional && !option.words.empty() && !option.has_word(text)) {
    const std::string allowed = joined(texts_of(option.words));
    fail(ErrorCode::bad_argument, "{}: '{}' is none of [{}]{}", name, text, allowed,
         did_you_mean(text, parts_of(allowed, '|')));
  }
  try {
    option.set(text);
  } catch (const Error& e) {
    fail_as(e, "{}: {}", name, e.what());
  }
}

/// Parses the value of an option that was given without an attached one: the next word, if the option takes it.
void Args::State::parse_value(Option& option, const std::string& name) {
  const bool fits = !words.empty() && (option.value == Value::required || option.has_word(words.front()));
  if (!fits) {
    if (option.value == Value::required) fail(ErrorCode::bad_argument, "{} needs a value", name);
    return take(option, name, "");
  }
  const std::string text = words.front();
  words.pop_front();
  take(option, name, text);
}

void Args::State::parse_long(const std::string& word) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  Option& option = find(name);
  if (equals == std::string::npos) return parse_value(option, name);
  const std::string text = word.substr(equals + 1);
  if (option.value == Value::none) fail(ErrorCode::bad_argument, "{} takes no value", name);
  take(option, name, text);
}

/// Parses `-n`, `-nVALUE`, or several flags in one word.
void Args::State::parse_short(const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  if (name.size() > 2 && look_up("-" + name) != nullptr)  // "-output" hardly means the file "utput"
    fail(ErrorCode::bad_argument, "there is no option {}; did you mean -{}?", name, name);
  for (std::size_t i = 1; i < word.size(); ++i) {
    const std::string letter{'-', word[i]};
    Option& option = find(letter, i == 1 && word.size() > 2 ? word : "");
    if (option.value == Value::none) {
      take(option, letter, "");
      continue;
    }
    if (i + 1 == word.size()) return parse_value(option, letter);
    return take(option, letter, word.substr(i + 1));
  }
}

/// Checks the words after `--`. A single one may be named like an option; among several, such a word is an option in
/// the wrong place.
void Args::State::check_names(std::span<const std::string> names) {
  for (const std::string& name : names) {
    if (names.size() > 1 && look_up(name.substr(0, name.find('='))) != nullptr && !is_there(name))
      fail(ErrorCode::bad_argument, "{0}: what follows -- is taken for names of files; put {0} before --", name);
  }
}

void Args::State::parse_positionals(const std::vector<std::string>& texts) {
  if (std::find(texts.begin(), texts.end(), "") != texts.end())
    fail(ErrorCode::bad_argument, "an argument is empty; was a variable not set?");
  std::size_t next = 0;
  for (Option& positional : positionals) {
    while (next < texts.size() && (positional.times == 0 || positional.repeatable))
      take(positional, positional.names, texts[next++]);
    if (positional.times == 0 && positional.value == Value::required)
      fail(ErrorCode::bad_argument, "{} is missing", positional.names);
  }
  const Option* const output = look_up("--output");
  const bool wants_output = output != nullptr && output->times == 0;
  if (next < texts.size())
    fail(ErrorCode::bad_argument, "'{}' is one argument too many{}", texts[next],
         wants_output ? "; did you mean -o " + texts[next] + "?" : "");
  if (wants_output && texts.size() > 1 && is_like_output(texts.back()))
    fail(ErrorCode::bad_argument, "there is no file {0}; did you mean -o {0}?", texts.back());
}

void Args::parse() {
  group("Help");
  flag_with_word(
      "-h,--help", {"all", "markdown", "bash", "zsh", "fish"}, [this](const std::string& word) { state_->help = word; },
      "print the options that most people need; all: every option; markdown: as in the manual; bash, zsh, fish: "
      "completion");
  flag("--version", state_->version, "print the version");
  std::vector<std::string> texts;
  try {
    while (!state_->words.empty() && !state_->help) {
      const std::string word = state_->words.front();
      state_->words.pop_front();
      state_->current = word;
      if (word == "--") {
        const std::vector<std::string> names(state_->words.begin(), state_->words.end());
        state_->check_names(names);
        texts.insert(texts.end(), names.begin(), names.end());
        break;
      }
      if (word.size() < 2 || word[0] != '-') {
        texts.push_back(word);
      } else {
        word[1] == '-' ? state_->parse_long(word) : state_->parse_short(word);
      }
    }
    if (!state_->help && !state_->version) return state_->parse_positionals(texts);
  } catch (const Error& e) {
    fail_as(e, "{} (see {} --help)", e.what(), state_->tool);
  }
  print(state_->help ? help_of(*state_->help, declaration())
                     : fmt::format("{} {}+{}\n", state_->tool, BP_VERSION, source_digest()));
  throw Done{};
}

bool Args::given(const std::string& name) const {
  return state_->find(name).times > 0;
}

void Args::needs(std::initializer_list<const char*> names, const char* needed) const {
  for (const char* const name : names) {
    if (given(name) && !given(needed))
      fail(ErrorCode::bad_argument, "{} means nothing without {}; leave it out", name, needed);
  }
}

void Args::excludes(const char* name, const char* other) const {
  if (given(name) && given(other)) fail(ErrorCode::bad_argument, "{} means nothing with {}; leave it out", name, other);
}

ToolDeclaration Args::declaration() const {
  ToolDeclaration tool{state_->tool, state_->about, state_->example, {}, {}};
  tool.arguments.assign(state_->positionals.begin(), state_->positionals.end());
  tool.options.assign(state_->options.begin(), state_->options.end());
  return tool;
}

}  // namespace bp
