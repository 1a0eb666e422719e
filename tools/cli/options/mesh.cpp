#include "tools/cli/options/mesh.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "lib/core/error.h"
#include "tools/cli/names.h"

namespace bp {

namespace {

using Kind = EncloseOption::Kind;

constexpr Args::Choice<MeshMode> kBounding = {"bounding", MeshMode::bounding, "the proxy encloses the scene"};
constexpr Args::Choice<MeshMode> kInside = {
    "inside", MeshMode::inside,
    "the proxy lies strictly inside the scene; the default for a stream of bpvox --fill inside, which it needs"};
constexpr Args::Choice<MeshMode> kFit = {"fit", MeshMode::fit, "the proxy follows the scene and need not enclose it"};
constexpr const char* kModeHelp = "where the proxy lies";
constexpr const char* kEncloseHelp = "what stays inside while the proxy is made tighter";

/// Returns the kind for a word of --enclose; Kind::files if it is no such word.
Kind kind_of(const std::string& word) {
  if (word == "auto") return Kind::automatic;
  if (word == "scene") return Kind::scene;
  if (word == "input") return Kind::input;
  return word == "closing" ? Kind::closing : Kind::files;
}

void add_origin(ProxyOptions& o, Args& args) {
  args.option(
      "--origin", "auto|off|X,Y,Z", [&o](const std::string& text) { o.origin = parse_origin(text); },
      "subtract this point from every vertex, for programs that compute with 32-bit floats (default: subtract nothing, "
      "and note where it is needed)");
  args.words({{"auto", "a round point near the scene, if the scene is far from 0,0,0"},
              {"off", "subtract nothing, without a note"}});
}

std::vector<Word> enclose_words() {
  return {{"auto", "as scene where the scene's files can be read again, else as input"},
          {"scene", "the scene's triangles"},
          {"input", "the scene's voxels"},
          {"closing", "the whole closing: the loosest proxy, of regular shape"}};
}

}  // namespace

std::string EncloseOption::text() const {
  constexpr const char* kNames[] = {"auto", "scene", "input", "closing"};
  if (kind != Kind::files) return kNames[std::size_t(kind)];
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(file_name(file));
  return fmt::format("{}", fmt::join(names, ","));
}

std::optional<Enclose> EncloseOption::what() const {
  if (kind == Kind::scene) return Enclose::scene;
  if (kind == Kind::input) return Enclose::input;
  return kind == Kind::closing ? std::optional(Enclose::closing) : std::nullopt;
}

EncloseOption parse_enclose(const std::vector<std::string>& given) {
  EncloseOption option;
  if (given.empty()) return option;
  option.kind = kind_of(given.front());
  const bool mixed = std::any_of(given.begin(), given.end(), [&](const std::string& word) {
    return kind_of(word) != (given.size() > 1 ? Kind::files : option.kind);
  });
  if (mixed)
    fail(ErrorCode::bad_argument,
         "--enclose takes one of auto, scene, input and closing, or scene files, not a mixture");
  if (option.kind == Kind::files) option.files = given;
  return option;
}

void ProxyOptions::add_of_stream(Args& args) {
  args.group("Proxy");
  args.option("--mode", {kBounding, kInside, kFit}, mode, kModeHelp);
  args.option("--enclose", "WORD|FILE", enclose_words_,
              std::string(kEncloseHelp) + "; repeat it for several FILEs (default: auto)");
  std::vector<Word> words = enclose_words();
  words[0].help += "; an --error counts from the closing";
  args.words(words);
  add_origin(*this, args);
}

void ProxyOptions::add_of_scene(Args& args) {
  args.group("Proxy");
  args.option("--mode",
              {{kBounding.word, LevelMode::bounding, kBounding.help},
               {kFit.word, LevelMode::fit, kFit.help},
               {"visual", LevelMode::visual, "the scene's own triangles, or fewer, or a fit: nothing is enclosed"}},
              level_mode_, kModeHelp);
  std::vector<Word> words = enclose_words();
  args.option("--enclose",
              {{"auto", Kind::automatic, words[0].help.c_str()},
               {"scene", Kind::scene, words[1].help.c_str()},
               {"input", Kind::input, words[2].help.c_str()},
               {"closing", Kind::closing, words[3].help.c_str()}},
              enclose.kind, kEncloseHelp);
  add_origin(*this, args);
}

void ProxyOptions::check() {
  visual = level_mode_ == LevelMode::visual;
  if (level_mode_ != LevelMode::bounding) mode = MeshMode::fit;
  if (!enclose_words_.empty()) enclose = parse_enclose(enclose_words_);  // those of a stream
}

}  // namespace bp
