#include "tools/info/mesh_info.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include "io/file.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::size_t kHeadBytes = 65536;  // comments stand at the start
constexpr std::size_t kMaxJsonBytes = 64u << 20;

std::uint64_t count_positions(const std::vector<TriangleD>& triangles) {
  std::vector<Vec3d> points;
  points.reserve(triangles.size() * 3);
  for (const TriangleD& t : triangles) points.insert(points.end(), t.begin(), t.end());
  std::sort(points.begin(), points.end());
  return std::uint64_t(std::unique(points.begin(), points.end()) - points.begin());
}

/// Up to `n` bytes from `offset`.
std::string bytes_at(const InputFile& file, std::uint64_t offset, std::size_t n) {
  std::string bytes(n, '\0');
  bytes.resize(file.read_at(offset, std::as_writable_bytes(std::span(bytes))));
  return bytes;
}

std::vector<std::string> from_comments(const std::string& head) {
  std::vector<std::string> steps;
  std::istringstream lines(head);
  for (std::string line; std::getline(lines, line);) {
    for (const std::string start : {"comment provenance: ", "# provenance: "}) {
      if (line.compare(0, start.size(), start) == 0) steps.push_back(line.substr(start.size()));
    }
  }
  return steps;
}

std::vector<std::string> gltf_provenance(const Json& document) {
  const Json none = Json::array();
  const Json* steps = &document;
  for (const char* key : {"asset", "extras", "provenance"}) {
    if (!steps->is_object() || !steps->contains(key)) return {};
    steps = &steps->at(key);
  }
  std::vector<std::string> lines;
  for (const Json& step : steps->is_array() ? *steps : none) {
    std::string line;
    for (const char* key : {"tool", "version", "options"}) {
      if (!step.is_object() || !step.contains(key) || !step.at(key).is_string()) return {};
      if (!line.empty()) line += ' ';
      line += step.at(key).get<std::string>();
    }
    if (step.contains("input") && step.at("input").is_string()) line += " input " + step.at("input").get<std::string>();
    lines.push_back(line);
  }
  return lines;
}

/// The most that a node has, itself included.
std::size_t gltf_levels(const Json& document) {
  static const Json::json_pointer ids("/extensions/MSFT_lod/ids");
  std::size_t most = 1;
  if (!document.is_object() || !document.contains("nodes")) return most;
  for (const Json& node : document.at("nodes")) {
    if (node.is_object() && node.contains(ids)) most = std::max(most, node.at(ids).size() + 1);
  }
  return most;
}

MeshExtras from_gltf(const std::string& text) {
  const Json document = Json::parse(text, nullptr, false);
  return {gltf_provenance(document), gltf_levels(document)};
}

}  // namespace

MeshInfo measure(TriangleSource& source) {
  MeshInfo info;
  std::vector<TriangleD> batch;
  std::vector<TriangleColors> colors;
  std::vector<std::uint8_t> inner_edges;
  while (source.read_faces(batch, colors, inner_edges)) {
    info.totals.add(batch);
    if (info.totals.triangles <= MeshInfo::kMaxKept) {
      info.triangles.insert(info.triangles.end(), batch.begin(), batch.end());
      info.colors.insert(info.colors.end(), colors.begin(), colors.end());
      info.inner_edges.insert(info.inner_edges.end(), inner_edges.begin(), inner_edges.end());
    } else {
      info.triangles = {};
      info.colors = {};
      info.inner_edges = {};
    }
  }
  if (!source.has_colors()) info.colors = {};
  info.counts = source.counts();
  if (info.triangles.size() == info.totals.triangles) info.vertices = count_positions(info.triangles);
  return info;
}

MeshExtras mesh_extras(const std::string& path) {
  if (path == "-") return {};
  const InputFile file(path);
  if (!file.seekable()) return {};
  const std::string head = bytes_at(file, 0, kHeadBytes);
  if (head.compare(0, 4, "glTF") == 0 && head.size() >= 20) {
    std::uint32_t json_bytes;
    std::memcpy(&json_bytes, head.data() + 12, 4);
    return json_bytes > kMaxJsonBytes ? MeshExtras{} : from_gltf(bytes_at(file, 20, json_bytes));
  }
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && head[first] == '{')
    return file.size() > kMaxJsonBytes ? MeshExtras{} : from_gltf(bytes_at(file, 0, file.size()));
  return {from_comments(head), 1};
}

std::string level_text(std::size_t level, std::size_t levels) {
  if (levels == 1) return "";
  return level == 0 ? fmt::format("finest of {} levels", levels)
                    : fmt::format("level {} of 0 to {}", level, levels - 1);
}

std::string mesh_text(const MeshInfo& info, const std::string& name) {
  const TriangleTotals& t = info.totals;
  const auto point = [](const Vec3d& p) { return fmt::format("{} {} {}", p[0], p[1], p[2]); };
  std::string s = fmt::format("{}: mesh\n", name);
  s += fmt::format("triangles   {}\n", t.triangles);
  if (info.vertices) s += fmt::format("vertices    {}\n", *info.vertices);
  const SceneCounts& c = info.counts;
  if (c.instances > 1) s += fmt::format("instances   {}\n", c.instances);
  if (c.degenerate + c.non_finite + c.bad_faces > 0) {
    s += fmt::format("skipped     {} degenerate, {} not finite, {} broken\n", c.degenerate, c.non_finite, c.bad_faces);
  }
  if (!t.bounds.empty()) {
    s += fmt::format("bounds      {} to {}, diagonal {:.6g}\n", point(t.bounds.min), point(t.bounds.max),
                     t.bounds.diagonal());
    s += fmt::format("area        {:.6g}\nvolume      {:.6g}\n", t.area, t.volume);
  }
  if (info.extras.levels > 1)
    s += fmt::format("levels      {}, of which this is {}\n", info.extras.levels,
                     info.level == 0 ? "the finest" : fmt::format("level {}", info.level));
  for (const std::string& step : info.extras.provenance) s += fmt::format("made by     {}\n", step);
  return s + fmt::format("checksum    {}\n", t.checksum());
}

Json mesh_json(const MeshInfo& info) {
  const TriangleTotals& t = info.totals;
  const SceneCounts& c = info.counts;
  Json j{{"kind", "mesh"}, {"checksum", t.checksum()}, {"triangles", t.triangles}};
  if (info.vertices) j["vertices"] = *info.vertices;
  j["instances"] = c.instances;
  j["skipped"] = {{"degenerate", c.degenerate}, {"non_finite", c.non_finite}, {"bad_faces", c.bad_faces}};
  if (!t.bounds.empty()) {
    j["bounds"] = {{"min", t.bounds.min}, {"max", t.bounds.max}};
    j["area"] = t.area;
    j["volume"] = t.volume;
  }
  j["levels"] = info.extras.levels;
  j["level"] = info.level;
  j["provenance"] = info.extras.provenance;
  return j;
}

}  // namespace bp
