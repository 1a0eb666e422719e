#include "tools/lod/level_list.h"

#include <fmt/format.h>

#include <cmath>

namespace bp {

namespace {

Json json_of(const TriedWay& tried) {
  Json json{{"way", tried.way}, {"scale", tried.scale_world}, {"faces", tried.faces}, {"volume", tried.volume}};
  if (!std::isnan(tried.error_world)) json["error"] = tried.error_world;
  return json;
}

}  // namespace

LevelRow row_of(const LevelFacts& level, const std::string& file, std::uint64_t bytes) {
  LevelRow row{file, 1, level.faces, bytes, level.error_world, level.scale_world, level.voxel};
  row.more = {{"attempts", level.attempts},
              {"volume", level.volume},
              {"voxels", level.voxels},
              {"faces_dense", level.faces_dense},
              {"stopped_by", level.stopped_by}};
  row.more["tried"] = Json::array();
  for (const TriedWay& tried : level.tried) row.more["tried"].push_back(json_of(tried));
  return row;
}

Json json_of(const LevelRow& row) {
  Json json{{"file", row.file},         {"bytes", row.bytes},       {"tiles", row.tiles}, {"faces", row.faces},
            {"error", row.error_world}, {"scale", row.scale_world}, {"voxel", row.voxel}};
  json.update(row.more);
  return json;
}

Json json_of(const FoundJobs& found) {
  return {{"what", found.what}, {"jobs", found.jobs}, {"kept", found.kept}};
}

std::string listing(const std::vector<LevelRow>& rows) {
  std::string text = "file\tfaces\terror\tscale\tvoxel\tbytes\n";
  for (const LevelRow& row : rows) {
    const std::string error = std::isnan(row.error_world) ? "-" : fmt::format("{:.4g}", row.error_world);
    text += fmt::format("{}\t{}\t{}\t{:.4g}\t{:.4g}\t{}\n", row.file, row.faces, error, row.scale_world, row.voxel,
                        row.bytes);
  }
  return text;
}

std::string listing(const std::vector<FoundJobs>& found) {
  std::string text = "jobs\tdone\tkept\n";
  for (const FoundJobs& f : found) text += fmt::format("{}\t{}\t{}\n", f.what, f.jobs, f.kept);
  return text;
}

}  // namespace bp
