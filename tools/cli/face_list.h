#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace bp {

/// Parses the value of --faces, "20000,5000,1000": the faces of each level, finest first. Throws bad_argument if a
/// number is 0 or no number, or if the list does not fall. If commas seem to group the digits of one number, the
/// message says what they are for.
[[nodiscard]] std::vector<std::uint64_t> parse_face_list(const std::string& text);

/// Parses "50%,10%,2%": shares of the scene's triangles, finest first, as numbers above 0 and at most 100. Throws
/// bad_argument if one is no percentage, or if the list does not fall.
[[nodiscard]] std::vector<double> parse_face_shares(const std::string& text);

}  // namespace bp
