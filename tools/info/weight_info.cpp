#include "tools/info/weight_info.h"

#include <fmt/format.h>

#include <filesystem>

#include "lib/check/counted.h"
#include "lib/core/box.h"
#include "lib/deform/coordinates.h"
#include "lib/store/hex.h"
#include "tools/cli/length.h"
#include "tools/cli/names.h"

namespace bp {

namespace {

Bounds3d bounds_of(const IndexedMesh& mesh) {
  Bounds3d bounds;
  for (const Vec3d& v : mesh.vertices) bounds.add(v);
  return bounds;
}

std::string hash_text(const WeightTotals& totals) {
  const auto [high, low] = totals.hash.words;
  return hex_of(high, low);
}

std::string scene_fault(const WeightInfo& info) {
  if (!info.scene_bytes) return "; is not there";
  return *info.scene_bytes == info.header.scene_bytes ? "" : "; has changed, and has to be bound again";
}

}  // namespace

WeightInfo weight_info(const std::string& path) {
  WeightReader reader(path);
  WeightInfo info;
  info.header = reader.header();
  info.columns = columns_of(info.header.kind, info.header.cage);
  info.bytes = InputFile(path).size();
  std::error_code missing;
  const std::uint64_t now = std::filesystem::file_size(find_scene(info.header, path), missing);
  if (!missing) info.scene_bytes = now;
  PackedWeights packed;
  for (WeightBlock block; reader.next(packed); ++info.blocks) reader.unpack(packed, block);
  info.totals = reader.totals();
  return info;
}

std::string weight_text(const WeightInfo& info, const std::string& name) {
  const WeightHeader& h = info.header;
  const Bounds3d bounds = bounds_of(h.cage);
  const auto point = [](const Vec3d& p) { return fmt::format("{} {} {}", p[0], p[1], p[2]); };
  std::string s = fmt::format("{}: weights of bpdeform, {}\n", name, size_text(info.bytes));
  s += fmt::format("coordinates {}\n", name_of(h.kind));
  s += fmt::format("scene file  {}, {}{}\n", h.scene, size_text(h.scene_bytes), scene_fault(info));
  s += fmt::format("vertices    {}, of which {} outside the cage; {} each\n", info.totals.points,
                   info.totals.outside == 1 ? "1 lies" : fmt::format("{} lie", info.totals.outside),
                   counted(info.columns, "weight"));
  s += fmt::format("cage        {} vertices, {}\n", h.cage.vertices.size(),
                   counted(h.cage.triangles.size(), "triangle"));
  s += fmt::format("bounds      {} to {}, diagonal {:.6g}; of the cage at rest\n", point(bounds.min), point(bounds.max),
                   bounds.diagonal());
  return s + fmt::format("checksum    {}; of the vertices at rest\n", hash_text(info.totals));
}

Json weight_json(const WeightInfo& info) {
  const WeightHeader& h = info.header;
  const Bounds3d bounds = bounds_of(h.cage);
  Json j{{"kind", "weights"}, {"bytes", info.bytes}, {"vertices_checksum", hash_text(info.totals)}};
  j["coordinates"] = name_of(h.kind);
  j["scene"] = {{"name", h.scene}, {"bytes", h.scene_bytes}};
  j["scene"]["bytes_now"] = info.scene_bytes ? Json(*info.scene_bytes) : Json(nullptr);
  j["vertices"] = info.totals.points;
  j["outside"] = info.totals.outside;
  j["weights_of_vertex"] = info.columns;
  j["blocks"] = info.blocks;
  j["cage"] = {{"vertices", h.cage.vertices.size()},
               {"triangles", h.cage.triangles.size()},
               {"bounds", {{"min", bounds.min}, {"max", bounds.max}}}};
  return j;
}

}  // namespace bp
