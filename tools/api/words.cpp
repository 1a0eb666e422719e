#include "tools/api/words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <string_view>
#include <utility>

namespace bp::api {

namespace {

/// Advice to users of the tools, and to those of the library.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kAdvice{
    {{"run bpvox again", "voxelize it again"},
     {"give bpvox a file that stays", "make the scene of a file that stays"},
     {"name the file with --enclose", "keep the files of a scene where they are"},
     {"; --faces 50% asks for half of those", ""},
     {"; bpclose ", "; a closing "},
     {"bpinfo on the stream of bpvox ", "bpinfo on the saved grid "},
     {"bpmesh makes a mesh of it", "load it as a grid"}}};

/// Tools whose options are members of the library's structs.
constexpr std::array<std::string_view, 5> kWrapped{"bpvox ", "bpscale ", "bpclose ", "bpmesh ", "bplod "};

bool is_lower(char c) {
  return std::islower(static_cast<unsigned char>(c)) != 0;
}

std::string with_own_advice(std::string text) {
  for (const auto& [of_tools, of_library] : kAdvice) {
    for (std::size_t at = 0; (at = text.find(of_tools, at)) != std::string::npos; at += of_library.size())
      text.replace(at, of_tools.size(), of_library);
  }
  return text;
}

/// Returns the number of characters that name an option at the beginning of `text`: --keep-cavities; else 0.
std::size_t option_at(std::string_view text) {
  if (text.size() < 3 || text.substr(0, 2) != "--" || !is_lower(text[2])) return 0;
  const auto* const end = std::find_if(text.begin() + 2, text.end(), [](char c) { return !is_lower(c) && c != '-'; });
  return std::size_t(end - text.begin());
}

/// Returns the number of characters of a tool's name, with the blank behind it, if an option follows; else 0.
std::size_t wrapped_tool_at(std::string_view text) {
  for (const std::string_view tool : kWrapped) {
    if (text.substr(0, tool.size()) == tool && option_at(text.substr(tool.size())) > 0) return tool.size();
  }
  return 0;
}

}  // namespace

std::string in_words_of_library(const std::string& text) {
  const std::string advice = with_own_advice(text);
  std::string_view left = advice;
  std::string out;
  while (!left.empty()) {
    const bool begins = out.empty() || std::isalnum(static_cast<unsigned char>(out.back())) == 0;
    if (begins) left.remove_prefix(wrapped_tool_at(left));
    const bool of_other_tool = out.ends_with("bpinfo ") || out.ends_with("bpcheck ") || out.ends_with("bpdeform ");
    const std::size_t option = begins ? option_at(left) : 0;
    if (option == 0 || of_other_tool) {
      out += left.front();
      left.remove_prefix(1);
      continue;
    }
    std::string member(left.substr(2, option - 2));
    std::replace(member.begin(), member.end(), '-', '_');
    out += member;
    left.remove_prefix(option);
  }
  return out;
}

}  // namespace bp::api
