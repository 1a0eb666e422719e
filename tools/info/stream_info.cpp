#include "tools/info/stream_info.h"

#include <fmt/ranges.h>

#include "lib/check/counted.h"
#include "lib/grid/count_bits.h"
#include "tools/cli/length.h"
#include "tools/cli/names.h"

namespace bp {

namespace {

constexpr const char* kLayerNames[] = {"solid", "closing"};

const char* axis_name(int axis) {
  return axis == 0 ? "x" : axis == 1 ? "y" : "z";
}

int layer_count(const StreamHeader& h) {
  return h.has_closing ? 2 : 1;
}

double volume_world(const StreamHeader& h, std::uint64_t voxels) {
  return double(voxels) * h.frame.voxel * h.frame.voxel * h.frame.voxel;
}

std::string point(const Vec3d& p) {
  return fmt::format("{} {} {}", p[0], p[1], p[2]);
}

std::string coord(BrickCoord c) {
  return fmt::format("{} {} {}", c.x, c.y, c.z);
}

std::string scale_text(const ScaleField& s) {
  if (s.constant()) return fmt::format("{}", s.base);
  return fmt::format("{}, and {} place{} with a rule", s.base, s.rules.size(), s.rules.size() == 1 ? "" : "s");
}

/// Returns the bits of all voxels of the bricks, over the size of the file.
double ratio(const StreamTotals& t) {
  const std::uint64_t bricks = t.layers[0].bricks + t.layers[1].bricks;
  return double(bricks) * kBrickWords * 8 / double(t.bytes);
}

std::string layer_text(const StreamHeader& h, const StreamTotals& t, int layer) {
  const LayerTotals& l = t.layers[std::size_t(layer)];
  return fmt::format("{:<11} {}, volume {:.6g}, {} ({} full, {} mixed)\n", kLayerNames[layer],
                     counted(l.voxels, "voxel"), volume_world(h, l.voxels), counted(l.bricks, "brick"), l.full,
                     l.bricks - l.full);
}

Json scene_json(const SceneFiles& scene) {
  Json files = Json::array();
  for (const SceneFiles::File& file : scene.files) files.push_back({{"name", file.name}, {"bytes", file.bytes}});
  return {{"files", files}, {"format", scene.format}, {"triangles", scene.triangles}, {"hash", scene.hash}};
}

}  // namespace

std::string stream_text(const StreamHeader& h, const StreamTotals& t, const std::string& name) {
  const BrickCoord size = h.bricks.size();
  std::string s = fmt::format("{}: stream of voxels, {}\n", name, size_text(t.bytes));
  s += fmt::format("voxel       {}\n", h.frame.voxel);
  s += fmt::format("grid        {} x {} x {} bricks from {}; {} is up, slabs across {}\n", size.x, size.y, size.z,
                   coord(h.bricks.min), name_of(h.frame.up), axis_name(h.slab_axis));
  if (!h.bounds.empty())
    s += fmt::format("scene       {} to {}, diagonal {:.6g}\n", point(h.bounds.min), point(h.bounds.max),
                     h.bounds.diagonal());
  s += fmt::format("fill        {}\n", name_of(h.fill));
  if (h.has_closing) s += fmt::format("element     {}\n", name_of(h.element));
  if (h.has_closing || h.has_field) s += fmt::format("scale       {}\n", scale_text(h.scale));
  if (!h.orientation.empty())
    s += fmt::format("orientation {} rotation{}, cells of {} voxels\n", h.orientation.rotations.size(),
                     h.orientation.rotations.size() == 1 ? "" : "s", h.orientation.cell_vox);
  for (const Provenance& p : h.provenance) s += fmt::format("made by     {} {} {}\n", p.tool, p.version, p.options);
  for (const SceneFiles::File& file : h.scene.files)
    s += fmt::format("scene file  {}, {}\n", file.name, size_text(file.bytes));
  for (int layer = 0; layer < layer_count(h); ++layer) s += layer_text(h, t, layer);
  if (h.has_closing && t.layers[0].voxels > 0)
    s += fmt::format("grown       {:.4g} times\n", double(t.layers[1].voxels) / double(t.layers[0].voxels));
  s += fmt::format("compressed  {:.3g} to 1\n", ratio(t));
  return s + fmt::format("checksum    {}\n", t.checksum());
}

Json stream_json(const StreamHeader& h, const StreamTotals& t) {
  const auto list = [](BrickCoord c) { return Json::array({c.x, c.y, c.z}); };
  Json j{{"kind", "stream of voxels"}, {"bytes", t.bytes}, {"checksum", t.checksum()}};
  j["voxel"] = h.frame.voxel;
  j["origin_voxels"] = h.frame.origin;
  j["up"] = name_of(h.frame.up);
  if (!h.bounds.empty()) j["bounds"] = {{"min", h.bounds.min}, {"max", h.bounds.max}};
  j["bricks"] = {{"min", list(h.bricks.min)}, {"max", list(h.bricks.max)}};
  j["slab_axis"] = axis_name(h.slab_axis);
  j["fill"] = name_of(h.fill);
  if (h.has_closing) j["element"] = name_of(h.element);
  if (h.has_closing || h.has_field) j["scale"] = Json::parse(to_json(h.scale));
  if (!h.orientation.empty())
    j["orientation"] = {{"rotations", h.orientation.rotations.size()}, {"cell_voxels", h.orientation.cell_vox}};
  j["layers"] = Json::object();
  for (int layer = 0; layer < layer_count(h); ++layer) {
    const LayerTotals& l = t.layers[std::size_t(layer)];
    j["layers"][kLayerNames[layer]] = {{"voxels", l.voxels},
                                       {"volume", volume_world(h, l.voxels)},
                                       {"bricks", l.bricks},
                                       {"full", l.full},
                                       {"mixed", l.bricks - l.full}};
  }
  j["ratio"] = ratio(t);
  j["provenance"] = Json::array();
  for (const Provenance& p : h.provenance) {
    j["provenance"].push_back(
        {{"tool", p.tool}, {"version", p.version}, {"options", p.options}, {"input_hash", p.input_hash}});
  }
  if (!h.scene.files.empty()) j["scene"] = scene_json(h.scene);
  return j;
}

std::string dump_header(const StreamHeader& h) {
  const auto& o = h.frame.origin;
  std::string s = fmt::format("voxel {} origin {} {} {} up {}\n", h.frame.voxel, o[0], o[1], o[2], name_of(h.frame.up));
  if (!h.bounds.empty()) s += fmt::format("bounds {} to {}\n", point(h.bounds.min), point(h.bounds.max));
  s += fmt::format("bricks {} to {} slabs {}\n", coord(h.bricks.min), coord(h.bricks.max), axis_name(h.slab_axis));
  s += fmt::format("fill {}\n", name_of(h.fill));
  if (h.has_closing) s += fmt::format("element {}\n", name_of(h.element));
  if (h.has_closing || h.has_field) s += fmt::format("scale {}\n", to_json(h.scale));
  for (const Provenance& p : h.provenance)
    s += fmt::format("provenance {} {} [{}] {}\n", p.tool, p.version, p.options, p.input_hash);
  for (const SceneFiles::File& file : h.scene.files) s += fmt::format("scene file {} {} B\n", file.name, file.bytes);
  if (!h.scene.files.empty()) s += fmt::format("scene triangles {} {}\n", h.scene.triangles, h.scene.hash);
  return s;
}

std::string dump_brick(const Brick& brick) {
  const std::uint64_t voxels = count_bits(std::as_bytes(std::span(brick.bits)));
  return fmt::format("{} {} {} {}\n", coord(brick.coord), kLayerNames[int(brick.layer)],
                     brick.fill == BrickFill::full ? "full" : "mixed", voxels);
}

std::string dump_end(const StreamTotals& t) {
  return fmt::format("end solid {} closing {} checksum {}\n", t.layers[0].voxels, t.layers[1].voxels, t.checksum());
}

}  // namespace bp
