#include "lib/atlas/charts.h"

#include <algorithm>
#include <cmath>

#include "lib/atlas/detail/face_regions.h"
#include "lib/atlas/detail/flat_chart.h"

namespace bp {

std::vector<Chart> cut_charts(const LatticeMesh& mesh) {
  const FaceRegions regions(mesh);
  std::vector<Chart> charts;
  std::vector<std::vector<std::uint32_t>> waiting = regions.cut();
  std::reverse(waiting.begin(), waiting.end());
  while (!waiting.empty()) {
    std::vector<std::uint32_t> faces = std::move(waiting.back());
    waiting.pop_back();
    std::vector<std::uint32_t> left;
    charts.push_back(flat_chart(mesh, regions, std::move(faces), left));
    for (std::vector<std::uint32_t>& part : regions.joined(left)) waiting.push_back(std::move(part));
  }
  return charts;
}

}  // namespace bp
