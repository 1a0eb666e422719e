#pragma once
#include <optional>
#include <string>

#include "io/deform/weight_file.h"
#include "tools/cli/report.h"

/// What bpinfo says of a file of weights.
namespace bp {

struct WeightInfo {
  WeightHeader header;
  WeightTotals totals;
  std::uint64_t blocks = 0, bytes = 0;
  std::size_t columns = 0;                   ///< weights of a vertex
  std::optional<std::uint64_t> scene_bytes;  ///< of the scene's file now; none: it is not there
};

/// Reads the file to its end, and checks each block. Throws as WeightReader does.
[[nodiscard]] WeightInfo weight_info(const std::string& path);

[[nodiscard]] std::string weight_text(const WeightInfo& info, const std::string& name);
[[nodiscard]] Json weight_json(const WeightInfo& info);

}  // namespace bp
