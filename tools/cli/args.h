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

/// The options of a tool, declared once: parsing, checks, --help and --version follow from the declarations. Opens no
/// file. The grammar is the usual one: `--name VALUE`, `--name=VALUE`, `-n VALUE`, `-nVALUE`; a value may begin with a
/// dash; `-` alone is an argument (stdin, stdout); after `--` every word is an argument. Names are not abbreviated. An
/// option that is unknown or given twice is a usage error, so that a typing slip never runs for hours.
namespace bp {

/// Amount of memory or disk as an option value (`4G`).
struct Bytes {
  std::uint64_t count = 0;
};

class Args {
 public:
  /// Thrown when --help or --version was printed: nothing is left to do. run_tool ends with status 0.
  struct Done {};
  using Setter = std::function<void(const std::string& text)>;  ///< throws bad_argument if `text` will not do
  /// A word of a choice, its meaning, and its help text (may be empty).
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
  /// The options that `--help` shows, each by one of its names; `--help all` shows all.
  void often(std::initializer_list<const char*> names);
  /// The line "Usage" shows this option. The tool itself checks that it is given.
  void needed(const char* name);
  /// Words that the option declared last takes in addition to other values.
  void words(std::vector<Word> words);
  /// Declares an option of earlier versions; a user who gives it is told what replaces it.
  void removed(const std::string& name, const std::string& replacement);

  /// Declares an argument. `value` keeps its default if the argument is absent.
  void positional(const std::string& name, std::string& value, const std::string& help);
  /// Declares arguments: at least one, or any number if the name has the form [NAME...].
  void positional(const std::string& name, std::vector<std::string>& values, const std::string& help);

  /// Declares an option; names "-s,--scale". T is string, int, int64_t, uint64_t, double, Length, Bytes, UpAxis, Vec3d,
  /// or an optional of one of them. The help shows the default, except an empty string or optional. Whole numbers
  /// cannot be negative.
  template <class T>
  void option(const std::string& names, const std::string& value_name, T& value, const std::string& help) {
    add({{names, value_name, help, shown(value)}, [&value](const std::string& text) { parse_into(text, value); }});
  }
  /// Declares an option with a choice of words: option("--element", {{"cube", Element::cube}, {"ball", Element::ball}},
  /// element, "...").
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
  /// Declares an option with values of any other kind.
  void option(const std::string& names, const std::string& value_name, Setter set, const std::string& help);
  /// Declares an option that may be given several times.
  void option(const std::string& names, const std::string& value_name, std::vector<std::string>& values,
              const std::string& help);
  void flag(const std::string& names, bool& value, const std::string& help);
  void flag(const std::string& names, const std::function<void()>& set, const std::string& help);
  /// Declares a flag that may carry one of `words`: `--progress`, `--progress json` or `--progress=json`. `set` gets ""
  /// or the word.
  void flag_with_word(const std::string& name, const std::vector<std::string>& words, Setter set,
                      const std::string& help);

  /// Parses the command line. Throws bad_argument (with a one-line message) or Done. To be called once, after the
  /// declarations.
  void parse();

  /// Returns whether an option was on the command line. `name`: one of its names. To be called after parse().
  [[nodiscard]] bool given(const std::string& name) const;
  /// Throws bad_argument if one of `names` was given without `needed`: it would have no effect. To be called after
  /// parse().
  void needs(std::initializer_list<const char*> names, const char* needed) const;
  /// Throws bad_argument if `name` was given together with `other`: it would have no effect.
  void excludes(const char* name, const char* other) const;

  [[nodiscard]] const std::string& tool() const;
  [[nodiscard]] ToolDeclaration declaration() const;

 private:
  enum class Value { required, optional, none };
  struct Option : Declaration {
    Setter set;
    Value value = Value::required;
    bool repeatable = false;
    int times = 0;  ///< how often it was given
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
