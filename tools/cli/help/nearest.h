#pragma once
#include <string>
#include <vector>

namespace bp {

/// Returns the word that a typing slip probably means: a word that begins with it, or the word with the fewest changes
/// (a letter added, left out, replaced, or two neighbours swapped), at most one for each three letters. Empty if there
/// is none.
[[nodiscard]] std::string nearest_word(const std::string& slip, const std::vector<std::string>& words);

/// Returns "; did you mean WORD?", or nothing.
[[nodiscard]] std::string did_you_mean(const std::string& slip, const std::vector<std::string>& words);

}  // namespace bp
