#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace bp {

/// The value of --faces, "20000,5000,1000": of each level, finest first. Throws bad_argument if a number is none or is
/// 0, or if the list does not fall; where commas seem to group the digits of one number, it says what they are for.
[[nodiscard]] std::vector<std::uint64_t> parse_face_list(const std::string& text);

/// "50%,10%,2%": shares of the scene's triangles, finest first, as numbers above 0 and at most 100. Throws bad_argument
/// if one is no percentage, or if the list does not fall.
[[nodiscard]] std::vector<double> parse_face_shares(const std::string& text);

}  // namespace bp
