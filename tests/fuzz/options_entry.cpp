#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "tests/fuzz/choices.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/tool_runs.h"

namespace fuzz {

namespace {

using Words = std::vector<std::string>;

struct Option {
  std::string name, value;  ///< "--faces", "N[,N...]"; no value: a flag
};

/// Returns the options that --help all lists: every new option of a tool is tried from then on.
std::vector<Option> options_of(Workplace& place, const std::string& tool) {
  std::vector<Option> options;
  std::istringstream help(place.run(tool, {"--help", "all"}).output);
  for (std::string line; std::getline(help, line);) {
    const std::size_t at = line.find("--");
    if (at == std::string::npos || line.find_first_not_of(' ') != 2 || line[line.find_first_not_of(' ')] != '-')
      continue;
    std::istringstream words(line.substr(at));
    Option option;
    words >> option.name;
    if (line.size() > at + option.name.size() + 1 && line[at + option.name.size() + 1] != ' ') words >> option.value;
    options.push_back(option);
  }
  return options;
}

const char* const kCube =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\n"
    "f 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

/// Inputs, made once; names that begin with "in." are never written.
struct Inputs {
  Workplace place;
  std::map<std::string, std::vector<Option>> options;
  Inputs() {
    place.write("in.obj", kCube);
    (void)place.run("bpvox", {place.path("in.obj"), "--resolution", "8", "-o", place.path("in.bpv")}, {"in.bpv"});
    (void)place.run("bpclose", {place.path("in.bpv"), "--scale", "1vx", "-o", place.path("in.closed.bpv")},
                    {"in.closed.bpv"});
    (void)place.run("bpmesh", {place.path("in.bpv"), "--faces", "12", "-o", place.path("in.ply")}, {"in.ply"});
    place.write("in.json", R"({"base": 0.2})");
    for (const char* tool : {"bpvox", "bpscale", "bpclose", "bpmesh", "bpcheck", "bplod", "bpinfo"})
      options[tool] = options_of(place, tool);
  }
};

/// Returns true for numbers between instant work and impossible work: these mean minutes of honest work, and no
/// finding.
bool takes_long(const std::string& text) {
  char* end = nullptr;
  constexpr double kDiagonal = 14;  // voxels of the cube
  double value = std::fabs(std::strtod(text.c_str(), &end));
  if (*end == '%') value *= kDiagonal / 100;
  return (value > 64 && value < 0x1p31) || (value > 1e-11 && value < 0.02);
}

std::string any_value(Choices& c, const Option& option) {
  static const Words kSmall{"1",   "2",  "3",  "5",      "8",     "0.5",   "1.5", "0.3", "10%",
                            "2vx", "64", "12", "100,20", "1,2,3", "0,0,0", "1M",  "64M", "0.1,0.2"};
  if (option.value.find('|') != std::string::npos && !c.once_in(16)) {
    Words words;
    std::istringstream list(option.value);
    for (std::string word; std::getline(list, word, '|');) words.push_back(word);
    return c.of(words);
  }
  if (c.once_in(2)) return c.of(kSmall);
  const std::string text = extreme_text(c);
  return c.once_in(4) ? text + c.of<std::string>({"%", "vx", ",1", ",1,1", "M", "T", "..5"}) : text;
}

std::string value_of(Choices& c, const Option& option) {
  const std::string text = any_value(c, option);
  return takes_long(text) ? "4" : text;
}

bool is_path(const Option& option) {
  return option.value.find("FILE") != std::string::npos || option.value.find("DIR") != std::string::npos;
}

/// Returns the arguments that a tool needs to do anything, at a size that takes no time.
Words sound_words(Choices& c, const std::string& tool, const Workplace& place) {
  if (tool == "bpvox") return {place.path("in.obj"), "-o", place.path("out.bpv")};
  if (tool == "bpscale") return {place.path("in.json"), place.path("in.bpv"), "-o", place.path("out.bpv")};
  if (tool == "bpclose") return {place.path("in.bpv"), "-o", place.path("out.bpv")};
  if (tool == "bpmesh")
    return {place.path(c.of<std::string>({"in.closed.bpv", "in.bpv"})), "-o",
            place.path(c.of<std::string>({"out.ply", "out.glb", "out.obj", "out.stl"}))};
  if (tool == "bpcheck") return {place.path("in.obj"), place.path("in.ply")};
  if (tool == "bplod") return {place.path("in.obj"), "-o", place.path("out")};
  return {place.path(c.of<std::string>({"in.bpv", "in.ply", "in.obj"}))};
}

/// Without these, defaults make thousands of voxels of the cube.
void add_size(const std::string& tool, Words& words) {
  const auto add = [&](const std::string& option, const std::string& value, const Words& others) {
    for (const std::string& other : others) {
      if (std::find(words.begin(), words.end(), other) != words.end()) return;
    }
    words.push_back(option);
    words.push_back(value);
  };
  if (tool == "bpvox" || tool == "bplod") add("--resolution", "8", {"--voxel", "--resolution"});
  if (tool == "bpclose" || tool == "bplod") add("--scale", "1vx", {"--scale", "--field"});
  if (tool == "bpmesh") add("--faces", "12", {"--faces"});
  if (tool == "bplod") add("--levels", "1", {"--levels", "--faces", "--error"});
}

void add_option(Choices& c, const Option& option, const Workplace& place, Words& words) {
  static const Words kNever{"--threads", "--help", "--temp", "--output"};  // ours, or nothing to try
  if (std::find(kNever.begin(), kNever.end(), option.name) != kNever.end()) return;
  words.push_back(option.name);
  if (option.value.empty()) return;
  words.push_back(is_path(option)
                      ? place.path(c.of<std::string>({"out.x", "in.json", "in.obj", "out.png", "no/out.x", ""}))
                      : value_of(c, option));
}

}  // namespace

void options(const std::uint8_t* data, std::size_t size) {
  static Inputs inputs;
  Workplace& place = inputs.place;
  Choices c(data, size);
  static const Words kTools{"bpvox", "bpclose", "bpmesh", "bpcheck", "bpinfo"};
  const std::uint32_t rare = roll(data, size, 16);
  const std::string tool = rare == 0 ? "bplod" : rare == 1 ? "bpscale" : c.of(kTools);
  Words words = sound_words(c, tool, place);
  for (std::uint32_t count = 1 + c.below(3); count > 0; --count)
    add_option(c, c.of(inputs.options.at(tool)), place, words);
  add_size(tool, words);
  (void)place.run(tool, words,
                  {"out.bpv", "out.ply", "out.glb", "out.obj", "out.stl", "out.x", "out.png", "out", "no"});
  place.remove_outputs();
}

}  // namespace fuzz
