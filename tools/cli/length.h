#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "lib/core/coords.h"
#include "lib/core/length.h"

/// Quantities as the command line writes them. Parsing is strict: a number, its unit, nothing else; no locale.
namespace bp {

/// Returns the integer in [lo, hi] that the whole of `text` spells. Throws bad_argument otherwise.
[[nodiscard]] std::int64_t parse_integer(std::string_view text, std::int64_t lo, std::int64_t hi);

/// Returns the count in [lo, hi] that `text` spells, which may be in thousands, millions or billions: `2k`, `1.5M`,
/// `1G`, powers of 1000.
[[nodiscard]] std::int64_t parse_count(std::string_view text, std::int64_t lo, std::int64_t hi);

/// Calls f for each item of a comma-separated list, in order.
void for_each_item(std::string_view text, const std::function<void(std::string_view)>& f);

/// Parses `X,Y,Z`. Throws bad_argument otherwise.
[[nodiscard]] Vec3d parse_point(std::string_view text);

/// Parses a number of bytes: `4096`, `512K`, `1.5G`, `4GiB`; units are powers of 1024. Throws bad_argument if it is no
/// size below 2^62.
[[nodiscard]] std::uint64_t parse_size(std::string_view text);
[[nodiscard]] std::string size_text(std::uint64_t bytes);  ///< for people: "1.5 GiB"

}  // namespace bp
