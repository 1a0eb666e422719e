#pragma once
#include <string>
#include <vector>

namespace bp {

/// The word that a typing slip is likely to mean: the one that begins with it, or that needs the fewest changes (a
/// letter added, left out, replaced, or two neighbours swapped), at most one for each three letters. Empty: none.
[[nodiscard]] std::string nearest_word(const std::string& slip, const std::vector<std::string>& words);

/// "; did you mean WORD?", or nothing.
[[nodiscard]] std::string did_you_mean(const std::string& slip, const std::vector<std::string>& words);

}  // namespace bp
