// bpinfo: what a brick stream or a mesh holds. Manual: docs/bpinfo.1.md
#include <cstdio>

#include "io/brick_stream.h"
#include "io/png_writer.h"
#include "io/scene_reader.h"
#include "lib/core/error.h"
#include "lib/grid/coarse_view.h"
#include "lib/image/render.h"
#include "tools/common/run_tool.h"
#include "tools/info/mesh_info.h"
#include "tools/info/stream_info.h"

namespace {

struct Options {
  bp::CommonOptions common;
  std::string in = "-", format, image;
  bp::UpAxis up = bp::UpAxis::y;
  bool json = false, checksum = false, dump = false;
};

Options parse(bp::Args& args) {
  Options o;
  args.about("Says what a brick stream or a mesh holds, and checks a stream to its end.");
  args.positional("INPUT", o.in, "brick stream, mesh or scene; - is stdin");
  args.flag("--json", o.json, "as JSON");
  args.flag(
      "--checksum", o.checksum,
      "print the checksum of the content only: of the voxels, or of the triangles as a set; it does not depend on "
      "order, tiles or compression");
  args.flag("--dump", o.dump, "print a stream as text, one line a brick");
  args.option("--image", "FILE", o.image, "draw what it holds into a PNG");
  args.option("--up", {{"y", bp::UpAxis::y}, {"z", bp::UpAxis::z}}, o.up, "axis that points up in the image of a mesh");
  args.option("--format", "NAME", o.format, "INPUT is a mesh of this format, whatever its name; needed for stdin");
  o.common.add_to(args, bp::CommonOptions::threads_part | bp::CommonOptions::overwrite_part);
  args.example("bpvox scene.glb --resolution 256 | bpinfo --image voxels.png");
  args.parse();
  if (int(o.json) + int(o.checksum) + int(o.dump) > 1)
    bp::fail(bp::ErrorCode::bad_argument, "--json, --checksum and --dump exclude each other");
  return o;
}

void print(const std::string& text) {
  bp::OutputFile out("-", false);
  out.write(text);
  out.commit();
}

/// stdin and pipes are brick streams, for they cannot be tried twice; files by their first bytes.
bool is_stream(const Options& o) {
  if (!o.format.empty()) return false;
  if (o.in == "-") return true;
  const bp::InputFile file(o.in);
  if (!file.seekable() || file.size() == 0) return true;
  std::array<std::byte, 4> magic{};
  (void)file.read_at(0, magic);
  return magic == std::array{std::byte(0x5b), std::byte(0x2a), std::byte(0x4d), std::byte(0x18)} ||
         o.in.ends_with(".bpv");
}

bp::Bounds3d bounds_of(const bp::StreamHeader& header) {
  bp::Bounds3d bounds;
  const bp::VoxelBox box = bp::voxels_of(header.bricks);
  const auto corner = [&](bp::VoxelCoord v) {
    const std::int64_t unit = bp::kLatticePerVoxel;
    return header.frame.world({v.x * unit, v.y * unit, v.z * unit});
  };
  bounds.add(corner(box.min));
  bounds.add(corner(box.max));
  return bounds;
}

void draw(std::vector<bp::View> views, const bp::RenderOptions& options, const Options& o) {
  bp::write_png(bp::render(views, options), o.image, o.common.overwrite);
}

void draw_stream(const bp::CoarseView& cells, const bp::StreamHeader& header, const bp::StreamTotals& totals,
                 const Options& o) {
  bp::RenderOptions options;
  options.up = header.frame.up;
  if (totals.layers[0].bricks + totals.layers[1].bricks == 0) options.bounds = bounds_of(header);
  const bp::Color colors[] = {{168, 182, 202}, {214, 178, 132}};
  std::vector<bp::TriangleD> surfaces[2];
  std::vector<bp::View> views;
  for (const bp::Layer layer : {bp::Layer::solid, bp::Layer::closing}) {
    if (layer == bp::Layer::closing && !header.has_closing) continue;
    const auto i = std::size_t(layer);
    surfaces[i] = cells.surface(layer, header.frame);
    bp::View view;
    view.triangles = surfaces[i];
    view.color = colors[i];
    view.label = fmt::format("{}: {} voxels of {:.4g}", i == 0 ? "solid" : "closing", totals.layers[i].voxels,
                             header.frame.voxel);
    if (cells.cell_voxels() > 1) view.label += fmt::format("\ndrawn in cells of {} voxels", cells.cell_voxels());
    views.push_back(std::move(view));
  }
  draw(std::move(views), options, o);
}

void show_stream(const Options& o) {
  bp::BrickReader source(o.in);
  bp::OutputFile out("-", false);
  bp::CoarseView cells(source.header().bricks);
  if (o.dump) out.write(bp::dump_header(source.header()));
  bp::Brick brick;
  while (source.read(brick)) {
    if (!o.image.empty()) cells.add(brick);
    if (o.dump) out.write(bp::dump_brick(brick));
  }
  const bp::StreamHeader& header = source.header();
  const bp::StreamTotals& totals = source.totals();
  if (!o.image.empty()) draw_stream(cells, header, totals, o);
  if (o.dump) {
    out.write(bp::dump_end(totals));
  } else if (o.checksum) {
    out.write(totals.checksum() + "\n");
  } else if (o.json) {
    out.write(bp::stream_json(header, totals).dump(2) + "\n");
  } else {
    out.write(bp::stream_text(header, totals, o.in == "-" ? "stdin" : o.in));
  }
  out.commit();
}

void draw_mesh(const bp::MeshInfo& info, bp::TriangleSource& source, const Options& o) {
  bp::RenderOptions options;
  options.bounds = info.totals.bounds;
  options.up = o.up;
  bp::View view;
  view.label = fmt::format("{} triangles", info.totals.triangles);
  if (info.triangles.size() == info.totals.triangles) {
    view.triangles = info.triangles;
    view.edges = info.triangles.size() <= 50000;  // more would only darken the picture
  } else {
    view.source = &source;
  }
  draw({view}, options, o);
}

void show_mesh(const Options& o) {
  if (o.dump) bp::fail(bp::ErrorCode::bad_argument, "{}: --dump is for brick streams, and this is none", o.in);
  bp::SceneOptions scene;
  scene.format = o.format;
  const auto source = bp::open_scene(o.in, scene);
  bp::MeshInfo info = bp::measure(*source);
  info.provenance = bp::mesh_provenance(o.in);
  if (!o.image.empty()) draw_mesh(info, *source, o);
  const std::string name = o.in == "-" ? "stdin" : o.in;
  if (o.checksum) return print(info.totals.checksum() + "\n");
  print(o.json ? bp::mesh_json(info).dump(2) + "\n" : bp::mesh_text(info, name));
}

void run(const Options& o) {
  if (is_stream(o)) {
    show_stream(o);
  } else {
    show_mesh(o);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpinfo", argc, argv, parse, run);
}
