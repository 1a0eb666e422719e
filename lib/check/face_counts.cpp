#include "lib/check/face_counts.h"

#include <fmt/format.h>

#include "lib/check/counted.h"
#include "lib/core/triangle_source.h"

namespace bp {

void FaceCounts::count(std::uint64_t triangles_of_face, int by) {
  std::uint64_t& n = triangles_of_face == 1 ? triangles : triangles_of_face == 2 ? quads : polygons;
  n += std::uint64_t(std::int64_t(by));
}

void FaceCounts::add(std::span<const std::uint8_t> inner_edges, std::uint64_t plain) {
  cut += inner_edges.size() + plain;
  // A face is counted by its triangles so far, and anew with each further one, so that no end needs to be awaited.
  for (const std::uint8_t edges : inner_edges) {
    const bool goes_on = (edges & kSamePolygonBefore) != 0 && open_ > 0;
    if (goes_on) count(open_, -1);
    const std::uint64_t seen = goes_on ? open_ + 1 : 1;
    count(seen, 1);
    open_ = (edges & kSamePolygonAfter) != 0 ? seen : 0;
  }
  if (plain == 0) return;
  triangles += plain;
  open_ = 0;
}

std::string FaceCounts::text() const {
  const std::string all = counted(cut, "triangle");
  if (quads + polygons == 0) return all;
  std::string faces;
  const auto say = [&](std::uint64_t n, const char* what) {
    if (n > 0) faces += (faces.empty() ? "" : " and ") + counted(n, what);
  };
  say(polygons, "larger polygon");
  say(quads, "quad");
  say(triangles, "triangle");
  return fmt::format("{}, {}{}", faces, all, triangles > 0 ? " when cut" : "");
}

}  // namespace bp
