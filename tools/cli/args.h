#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/grid_frame.h"
#include "tools/cli/help/declaration.h"
#include "tools/cli/length.h"

/// Options of a tool, declared once: parsing, checks, --help and --version follow from the declarations. Opens no file.
/// The grammar is the usual one: `--name VALUE`, `--name=VALUE`, `-n VALUE`, `-nVALUE`; a value may begin with a dash;
/// `-` alone is an argument (stdin, stdout); after `--` everything is. Names are not abbreviated; what is given twice
/// or is not known is a usage error, so that a typing slip never runs for hours.
namespace bp {

/// Amount of memory or disk as an option value (`4G`).
struct Bytes {
  std::uint64_t count = 0;
};

class Args {
 public:
  /// --help or --version was printed: nothing is left to do. run_tool ends with status 0.
  struct Done {};
  using Setter = std::function<void(const std::string& text)>;  ///< throws bad_argument if `text` will not do
  /// A word of a choice, its meaning, and the text that help has for it (may be empty).
  template <class E>
  struct Choice {
    const char* word;
    E value;
    const char* help = "";
  };
  template <class E>
  using Choices = std::initializer_list<Choice<E>>;

  Args(std::string tool, int argc, const char* const* argv);
  ~Args();
  Args(const Args&) = delete;
  Args& operator=(const Args&) = delete;

  void about(const std::string& text);    ///< what the tool does, one or two sentences
  void example(const std::string& text);  ///< a whole command line, shown last by --help

  /// The options declared from here on belong to this group of help and manual. A group may be named again.
  void group(const std::string& name);
  /// The options, each by one of its names, that `--help` shows; `--help all` shows all.
  void often(std::initializer_list<const char*> names);
  /// An option that the line "Usage" shows; that it is given is for the tool to check.
  void needed(const char* name);
  /// The words that the option declared last takes, among other values.
  void words(std::vector<Word> words);
  /// An option of earlier versions; who gives it is told what replaces it.
  void removed(const std::string& name, const std::string& replacement);

  /// `value` keeps its default if the argument is absent.
  void positional(const std::string& name, std::string& value, const std::string& help);
  /// At least one; any number if the name is of the form [NAME...].
  void positional(const std::string& name, std::vector<std::string>& values, const std::string& help);

  /// names "-s,--scale"; T is string, int, int64_t, uint64_t, double, Length, Bytes, UpAxis, Vec3d, or an optional of
  /// one of them. The
  /// help shows the default, except of an empty string or optional. Whole numbers are not negative.
  template <class T>
  void option(const std::string& names, const std::string& value_name, T& value, const std::string& help) {
    add({{names, value_name, help, shown(value)}, [&value](const std::string& text) { parse_into(text, value); }});
  }
  /// One of a few words: option("--element", {{"cube", Element::cube}, {"ball", Element::ball}}, element, "...").
  template <class E>
  void option(const std::string& names, Choices<E> choices, E& value, const std::string& help) {
    std::vector<std::pair<std::string, E>> table;
    std::vector<Word> words;
    std::string joined, shown_default;
    for (const Choice<E>& choice : choices) {
      table.push_back({choice.word, choice.value});
      words.push_back({choice.word, choice.help});
      joined += (joined.empty() ? "" : "|") + words.back().text;
      if (choice.value == value) shown_default = choice.word;
    }
    const auto set = [&value, table, joined](const std::string& text) {
      for (const auto& [word, e] : table) {
        if (word == text) return void(value = e);
      }
      refuse_word(text, joined);
    };
    add({{names, joined, help, shown_default, "", words}, set});
  }
  /// Values of any other kind.
  void option(const std::string& names, const std::string& value_name, Setter set, const std::string& help);
  /// May be given several times.
  void option(const std::string& names, const std::string& value_name, std::vector<std::string>& values,
              const std::string& help);
  void flag(const std::string& names, bool& value, const std::string& help);
  void flag(const std::string& names, const std::function<void()>& set, const std::string& help);
  /// A flag that may carry one of `words`: `--progress`, `--progress json` or `--progress=json`. `set` gets "" or the
  /// word.
  void flag_with_word(const std::string& name, const std::vector<std::string>& words, Setter set,
                      const std::string& help);

  /// Throws bad_argument (with a one-line message) or Done. Call it once, after the declarations.
  void parse();

  /// After parse(): whether an option was on the command line. `name` is one of its names.
  [[nodiscard]] bool given(const std::string& name) const;
  /// After parse(). Throws bad_argument if one of `names` was given and `needed` was not: it would mean nothing.
  void needs(std::initializer_list<const char*> names, const char* needed) const;
  /// The same where `name` means nothing beside `other`.
  void excludes(const char* name, const char* other) const;

  [[nodiscard]] const std::string& tool() const;
  [[nodiscard]] ToolDeclaration declaration() const;

 private:
  enum class Value { required, optional, none };
  struct Option : Declaration {
    Setter set;
    Value value = Value::required;
    bool repeatable = false;
    int times = 0;  ///< given
    [[nodiscard]] bool has_word(const std::string& text) const {
      return std::any_of(words.begin(), words.end(), [&](const Word& word) { return word.text == text; });
    }
  };
  void add(Option option);
  [[noreturn]] static void refuse_word(const std::string& text, const std::string& words);

  static void parse_into(const std::string& text, std::string& value) { value = text; }
  static void parse_into(const std::string& text, double& value) { value = parse_number(text); }
  static void parse_into(const std::string& text, int& value) { value = int(parse_count(text, 0, INT32_MAX)); }
  static void parse_into(const std::string& text, std::int64_t& value) { value = parse_count(text, 0, INT64_MAX); }
  static void parse_into(const std::string& text, std::uint64_t& value) {
    value = std::uint64_t(parse_count(text, 0, INT64_MAX));
  }
  static void parse_into(const std::string& text, Length& value) { value = parse_length(text); }
  static void parse_into(const std::string& text, Bytes& value) { value.count = parse_size(text); }
  static void parse_into(const std::string& text, Vec3d& value) { value = parse_point(text); }
  static void parse_into(const std::string& text, UpAxis& value);
  template <class T>
  static void parse_into(const std::string& text, std::optional<T>& value) {
    T parsed{};
    parse_into(text, parsed);
    value = parsed;
  }

  static std::string shown(const std::string& value) { return value; }
  static std::string shown(double value);
  static std::string shown(int value) { return std::to_string(value); }
  static std::string shown(std::int64_t value) { return std::to_string(value); }
  static std::string shown(std::uint64_t value) { return std::to_string(value); }
  static std::string shown(const Length& value) { return value.text(); }
  static std::string shown(const Bytes& value) { return size_text(value.count); }
  static std::string shown(const Vec3d&) { return ""; }
  static std::string shown(UpAxis value);
  template <class T>
  static std::string shown(const std::optional<T>& value) {
    return value ? shown(*value) : "";
  }

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
