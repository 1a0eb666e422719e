#pragma once
#include <string>

namespace bp::api {

/// Returns a message of the tools as users of the library know it. Members are named as options are: --keep-cavities,
/// and bpclose --keep-cavities, is keep_cavities. Advice that only a user of the tools can follow becomes other words.
[[nodiscard]] std::string in_words_of_library(const std::string& text);

}  // namespace bp::api
