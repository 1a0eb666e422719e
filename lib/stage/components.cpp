#include "lib/stage/components.h"

#include <algorithm>
#include <set>

#include "lib/check/surface.h"

namespace bp {

std::uint64_t drop_inverted_components(LatticeMesh& mesh) {
  IndexedMesh indexed;
  for (const LatticeCoord& p : mesh.vertices) indexed.vertices.push_back(mesh.frame.world(p));
  indexed.triangles = mesh.triangles;
  CheckReport report;
  WeldedMesh welded = weld(indexed, 0, report);
  check_topology(welded, 0, report);
  const Finding inverted = inverted_components(welded, Surface(welded), welded.triangles.size());
  if (inverted.count == 0) return 0;
  std::set<std::uint32_t> dropped;
  for (const Example& e : inverted.examples) {
    const auto at = std::find(welded.number.begin(), welded.number.end(), e.index);
    dropped.insert(welded.component[std::size_t(at - welded.number.begin())]);
  }
  std::vector<std::array<std::uint32_t, 3>> left;
  for (std::size_t i = 0; i < welded.triangles.size(); ++i) {
    if (dropped.count(welded.component[i]) == 0) left.push_back(mesh.triangles[welded.number[i]]);
  }
  const std::uint64_t taken = mesh.triangles.size() - left.size();
  mesh.triangles = std::move(left);
  mesh.quads.clear();  // they named triangles by number
  return taken;
}

}  // namespace bp
