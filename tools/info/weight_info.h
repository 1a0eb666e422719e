#pragma once
#include <optional>
#include <string>

#include "io/deform/weight_file.h"
#include "tools/cli/report.h"

/// The facts that bpinfo prints about a file of weights.
namespace bp {

struct WeightInfo {
  WeightHeader header;
  WeightTotals totals;
  std::uint64_t blocks = 0, bytes = 0;
  std::size_t columns = 0;                   ///< largest number of weights of a vertex
  std::optional<std::uint64_t> scene_bytes;  ///< size of the scene's file now; none if it is missing
};

/// Reads the file to its end, and checks each block. Throws as WeightReader.
[[nodiscard]] WeightInfo weight_info(const std::string& path);

[[nodiscard]] std::string weight_text(const WeightInfo& info, const std::string& name);
[[nodiscard]] Json weight_json(const WeightInfo& info);

}  // namespace bp
