#pragma once
#include <cstdint>

namespace bp {

constexpr std::uint64_t kFacesPerRegion =
    2048;  ///< the most faces of a region (regions.h), if nothing else is asked for

}  // namespace bp
