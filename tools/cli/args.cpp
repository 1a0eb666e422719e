#include "tools/cli/args.h"

#include <algorithm>
#include <deque>

#include "io/files/file.h"
#include "lib/core/error.h"
#include "lib/store/source_digest.h"
#include "tools/cli/names.h"
#include "tools/cli/nearest.h"

namespace bp {

namespace {

constexpr std::size_t kHelpColumn = 28, kHelpWidth = 80;

/// Which tools have an option, of those that not all of the pipe's tools have. A golden case (manuals) holds it against
/// the tools.
struct OptionOfTools {
  const char *option, *tools;
};
constexpr OptionOfTools kOptionsOfTools[] = {
    {"--azimuth", "bpcheck and bpinfo"},
    {"--cache", "bplod"},
    {"--checksum", "bpinfo"},
    {"--colors", "bplod"},
    {"--convex", "bpcheck"},
    {"--device", "bpvox, bpclose and bplod"},
    {"--dump", "bpinfo"},
    {"--edge-length", "bpmesh"},
    {"--element", "bpclose and bplod"},
    {"--elevation", "bpcheck and bpinfo"},
    {"--enclose", "bpmesh and bplod"},
    {"--error", "bpmesh and bplod"},
    {"--examples", "bpcheck"},
    {"--explain", "bplod"},
    {"--faces", "bpmesh and bplod"},
    {"--field", "bpclose"},
    {"--fill", "bpvox and bplod"},
    {"--format", "bpvox, bpmesh, bpcheck, bplod and bpinfo"},
    {"--hulls", "bplod"},
    {"--image", "bpcheck and bpinfo"},
    {"--image-size", "bpcheck and bpinfo"},
    {"--inner", "bpclose"},
    {"--inset", "bpmesh"},
    {"--inside", "bpcheck"},
    {"--json", "bpcheck and bpinfo"},
    {"--keep-cavities", "bpclose"},
    {"--least-part", "bpmesh"},
    {"--level", "bpinfo"},
    {"--levels", "bplod"},
    {"--look-at", "bpcheck and bpinfo"},
    {"--measure", "bpmesh"},
    {"--memory", "bpvox, bpclose, bpmesh, bpcheck and bplod"},
    {"--mode", "bpmesh and bplod"},
    {"--name", "bplod"},
    {"--no-distances", "bpcheck"},
    {"--no-edges", "bpinfo"},
    {"--no-tighten", "bpmesh and bplod"},
    {"--origin", "bpmesh, bpcheck and bplod"},
    {"--output", "bpvox, bpclose, bpmesh and bplod"},
    {"--profile", "bplod"},
    {"--progress", "bpvox, bpclose, bpmesh, bpcheck and bplod"},
    {"--quads", "bpmesh"},
    {"--quiet", "bpvox, bpclose, bpmesh, bpcheck and bplod"},
    {"--report", "bpvox, bpclose, bpmesh, bpcheck and bplod"},
    {"--resolution", "bpvox and bplod"},
    {"--resume", "bplod"},
    {"--samples", "bpcheck"},
    {"--scale", "bpclose and bplod"},
    {"--screen", "bplod"},
    {"--temp", "bpvox, bpclose, bpmesh, bpcheck and bplod"},
    {"--tile", "bpclose and bplod"},
    {"--tiles", "bplod"},
    {"--up", "bpvox, bpcheck, bplod and bpinfo"},
    {"--volume", "bpmesh"},
    {"--voxel", "bpvox and bplod"},
    {"--zoom", "bpcheck and bpinfo"},
};

/// "; --faces is an option of bpmesh and bplod", if another tool of the pipe has it; else nothing. `similar`: a slip
/// will do.
std::string has_another_tool(const std::string& name, bool similar) {
  std::vector<std::string> names;
  for (const OptionOfTools& o : kOptionsOfTools) names.push_back(o.option);
  const std::string meant = similar ? nearest_word(name, names) : name;
  for (const OptionOfTools& o : kOptionsOfTools) {
    if (o.option == meant) return fmt::format("; {} is an option of {}", meant, o.tools);
  }
  return "";
}

/// Words of `text`, as many to a line as fit, from `column` on; the first line is already begun.
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

/// One option of --help: its names, then its text in the right-hand column.
std::string help_entry(const std::string& left, const std::string& help) {
  std::string out = "  " + left;
  if (out.size() + 2 > kHelpColumn) out += "\n" + std::string(kHelpColumn, ' ');
  if (out.size() < kHelpColumn) out.append(kHelpColumn - out.size(), ' ');
  return out + wrapped(help, kHelpColumn);
}

/// "a|b|c", or "-s,--scale", in its parts.
std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// "-s,--scale" as people write it: "-s, --scale".
std::string spaced(const std::string& names) {
  std::string out;
  for (const char c : names) out += c == ',' ? std::string(", ") : std::string(1, c);
  return out;
}

}  // namespace

struct Args::State {
  std::string tool, about, example;
  std::deque<std::string> words;  ///< of the command line, those not parsed yet
  std::vector<Option> options, positionals;
  bool help = false, version = false;

  Option* look_up(const std::string& name);
  Option& find(const std::string& name, const std::string& word = "");
  void take(Option& option, const std::string& name, const std::string& text);
  void parse_long(const std::string& word);
  void parse_short(const std::string& word);
  void parse_value(Option& option, const std::string& name);
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
  state_->options.push_back(std::move(option));
}

void Args::positional(const std::string& name, std::string& value, const std::string& help) {
  const auto set = [&value](const std::string& text) { value = text; };
  state_->positionals.push_back({name, "[" + name + "]", help, value, set, Value::optional});
}

void Args::positional(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  const auto set = [&values](const std::string& text) { values.push_back(text); };
  const std::string shown_name = name + (name.find("...") == std::string::npos ? "..." : "");
  const Value needed = name.ends_with("...]") ? Value::optional : Value::required;
  state_->positionals.push_back({shown_name, shown_name, help, "", set, needed, true});
}

void Args::option(const std::string& names, const std::string& value_name, std::vector<std::string>& values,
                  const std::string& help) {
  const auto set = [&values](const std::string& text) { values.push_back(text); };
  add({names, value_name, help, "", set, Value::required, true});
}

void Args::option(const std::string& names, const std::string& value_name, Setter set, const std::string& help) {
  add({names, value_name, help, "", std::move(set)});
}

void Args::flag(const std::string& names, const std::function<void()>& set, const std::string& help) {
  add({names, "", help, "", [set](const std::string&) { set(); }, Value::none, true});
}

void Args::flag(const std::string& names, bool& value, const std::string& help) {
  flag(
      names, [&value] { value = true; }, help);  // given twice, it says the same thing
}

void Args::flag_with_word(const std::string& name, const std::vector<std::string>& words, Setter set,
                          const std::string& help) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : "|") + word;
  add({name, "[" + all + "]", help, "", std::move(set), Value::optional, true, words});
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

/// `word`: what was written, where that is more than the name: "-faces" for -f.
Args::Option& Args::State::find(const std::string& name, const std::string& word) {
  if (Option* const option = look_up(name)) return *option;
  std::vector<std::string> names;
  for (const Option& option : options) {
    const std::vector<std::string> own = parts_of(option.names, ',');
    names.insert(names.end(), own.begin(), own.end());
  }
  const std::string slip = word.empty() ? name : "-" + word;
  std::string hint = has_another_tool(slip, false);
  if (hint.empty()) hint = did_you_mean(slip, names);
  if (hint.empty()) hint = has_another_tool(slip, true);
  fail(ErrorCode::bad_argument, "there is no option {}{}", name, hint);
}

void Args::State::take(Option& option, const std::string& name, const std::string& text) {
  if (option.times++ > 0 && !option.repeatable) fail(ErrorCode::bad_argument, "{} is given twice", name);
  if (text.empty() && option.value == Value::required)
    fail(ErrorCode::bad_argument, "{} is empty; was a variable not set?", name);
  try {
    option.set(text);
  } catch (const Error& e) {
    fail(e.code(), "{}: {}", name, e.what());
  }
}

/// The option was met without a value attached: the next word is it, where one is wanted.
void Args::State::parse_value(Option& option, const std::string& name) {
  const bool fits =
      !words.empty() && (option.value == Value::required ||
                         std::find(option.words.begin(), option.words.end(), words.front()) != option.words.end());
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
  if (option.value == Value::optional &&
      std::find(option.words.begin(), option.words.end(), text) == option.words.end())
    fail(ErrorCode::bad_argument, "{}: '{}' is none of {}{}", name, text, option.value_name,
         did_you_mean(text, option.words));
  take(option, name, text);
}

/// `-n`, `-nVALUE`, or several flags in one word.
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
  if (next < texts.size()) fail(ErrorCode::bad_argument, "'{}' is one argument too many", texts[next]);
}

void Args::parse() {
  flag("-h,--help", state_->help, "print this and exit");
  flag("--version", state_->version, "print the version and exit");
  std::vector<std::string> texts;
  try {
    while (!state_->words.empty() && !state_->help) {
      const std::string word = state_->words.front();
      state_->words.pop_front();
      if (word == "--") {
        texts.insert(texts.end(), state_->words.begin(), state_->words.end());
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
    fail(e.code(), "{} (see {} --help)", e.what(), state_->tool);
  }
  print(state_->help ? help_text() : fmt::format("{} {}+{}\n", state_->tool, BP_VERSION, source_digest()));
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

std::string Args::help_text() const {
  std::string usage = "Usage: " + state_->tool + " [OPTION]...", entries;
  for (const Option& p : state_->positionals) usage += " " + p.value_name;
  for (const std::vector<Option>* list : {&state_->positionals, &state_->options}) {
    for (const Option& o : *list) {
      const bool named = list == &state_->options && !o.value_name.empty();
      const std::string left = spaced(o.names) + (named ? " " + o.value_name : "");
      entries += help_entry(left, o.help + (o.shown_default.empty() ? "" : " (default: " + o.shown_default + ")"));
    }
  }
  std::string text = usage + "\n" + wrapped(state_->about, 0) + "\n" + entries;
  if (!state_->example.empty()) text += "\nExample:\n  " + state_->example + "\n";
  return text;
}

}  // namespace bp
