#pragma once
#include <cstddef>
#include <cstdint>

#include "tools/deform/apply.h"
#include "tools/deform/bind.h"

/// Finds the limit on memory at which all steps of a command fit. A step that is refused knows only its own needs, so
/// the next step would be refused in the next run. Used after a refusal: the files are counted once more.
namespace bp {

/// Returns bytes. Throws bad_input if a file is broken.
[[nodiscard]] std::uint64_t least_limit(const BindRequest& request);
/// cages: the files; frames: frames of the animation, 0 if there is none.
[[nodiscard]] std::uint64_t least_limit(const ApplyRequest& request, std::span<const std::string> cages,
                                        std::size_t frames);

}  // namespace bp
