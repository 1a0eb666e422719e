#pragma once
#include <cstdint>
#include <string>

/// What a user should know of a mesh that has not the faces wanted.
namespace bp {

/// Of a mesh with clearly fewer faces than were asked for: merging edges ends there, so there never were as many.
/// Empty if there are about as many, or more. One line.
[[nodiscard]] std::string too_few_note(std::uint64_t faces, std::uint64_t asked);

}  // namespace bp
