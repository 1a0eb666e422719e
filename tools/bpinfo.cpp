// bpinfo: what a brick stream or a mesh holds. Manual: docs/bpinfo.1.md
#include <cstdio>
#include <optional>

#include "io/brick_stream.h"
#include "io/png_writer.h"
#include "io/scene_reader.h"
#include "lib/core/error.h"
#include "lib/grid/coarse_view.h"
#include "lib/image/render.h"
#include "tools/common/inputs.h"
#include "tools/common/run_tool.h"
#include "tools/info/mesh_info.h"
#include "tools/info/stream_info.h"
#include "tools/info/tileset_info.h"

namespace {

struct Options {
  bp::CommonOptions common;
  std::vector<std::string> in;
  std::string format, image;
  std::optional<bp::UpAxis> up;
  bool json = false, checksum = false, dump = false, no_edges = false;
  int image_size = 720;
  double azimuth = 35, elevation = 22;
};

Options parse(bp::Args& args) {
  Options o;
  args.about("Says what brick streams, meshes or tilesets hold, and checks a stream to its end.");
  args.positional("[INPUT...]", o.in, "brick streams, meshes or scenes, tilesets (*.json); - is stdin (default: -)");
  args.flag("--json", o.json, "as JSON");
  args.flag(
      "--checksum", o.checksum,
      "print the checksum of the content only: of the voxels, or of the triangles as a set; it does not depend on "
      "order, tiles or compression");
  args.flag("--dump", o.dump, "print a stream as text, one line a brick");
  args.option("--image", "FILE", o.image, "draw what they hold into a PNG, side by side at one scale");
  args.option("--image-size", "PIXELS", o.image_size, "side of a panel of the image");
  args.flag("--no-edges", o.no_edges, "leave out the edges of meshes of few triangles");
  args.option("--up", "y|z", o.up,
              "axis that points up in the image of meshes (default: y, or that of the first INPUT that tells)");
  args.option("--azimuth", "DEGREES", o.azimuth, "where the viewer stands, from the front to the right");
  args.option("--elevation", "DEGREES", o.elevation, "how far above the horizon the viewer stands");
  args.option("--format", "NAME", o.format,
              "inputs are meshes, and this is the format of stdin, or of files whose names do not tell");
  o.common.add_to(args, bp::CommonOptions::threads_part | bp::CommonOptions::overwrite_part);
  args.example("bpinfo scene.glb closed.bpv proxy.glb --image all.png");
  args.parse();
  if (o.in.empty()) o.in = {"-"};
  bp::check_scene_format(o.format, o.in);
  bp::check_stdin_once(o.in);
  bp::keep_inputs(o.in);
  bp::check_panel_size(o.image_size);
  if (int(o.json) + int(o.checksum) + int(o.dump) > 1)
    bp::fail(bp::ErrorCode::bad_argument, "--json, --checksum and --dump exclude each other");
  args.needs({"--image-size", "--no-edges", "--up", "--azimuth", "--elevation"}, "--image");
  if (o.in.size() > 1 && (o.json || o.dump)) bp::fail(bp::ErrorCode::bad_argument, "--json and --dump take one INPUT");
  return o;
}

/// stdin and pipes are brick streams, for they cannot be tried twice; files by their first bytes.
bool is_stream(const Options& o, const std::string& in) {
  if (!o.format.empty()) return false;
  if (in == "-") return true;
  const bp::InputFile file(in);
  if (!file.seekable() || file.size() == 0) return true;
  std::array<std::byte, 4> magic{};
  (void)file.read_at(0, magic);
  return magic == std::array{std::byte(0x5b), std::byte(0x2a), std::byte(0x4d), std::byte(0x18)} ||
         in.ends_with(".bpv");
}

std::string shown_name(const std::string& in) {
  return in == "-" ? "stdin" : in.substr(in.rfind('/') + 1);
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

/// One panel of the image, and what it draws.
struct Panel {
  std::vector<bp::TriangleD> triangles;
  std::vector<bp::TriangleColors> colors;
  std::unique_ptr<bp::TriangleSource> source;  // of a mesh too large to keep
  bp::Bounds3d bounds;
  bp::View view;
};

/// The panels, left to right, at one scale.
class Picture {
 public:
  /// Opens the file: a name that cannot be written fails before the work.
  explicit Picture(const Options& o) : o_(o) {
    bp::check_png_name(o.image);
    if (!o.image.empty()) file_ = bp::open_output(o.image, o.common.overwrite);
  }
  [[nodiscard]] bool wanted() const { return file_ != nullptr; }
  [[nodiscard]] bool several() const { return o_.in.size() > 1; }

  /// The layers of a stream; of one among several inputs only the last.
  void add_stream(const bp::CoarseView& cells, const bp::StreamHeader& header, const bp::StreamTotals& totals) {
    if (!up_) up_ = header.frame.up;
    if (totals.layers[0].bricks + totals.layers[1].bricks == 0) bounds_.merge(bounds_of(header));
    const bool closing = header.has_closing;
    if (!closing || !several()) add_layer(bp::Layer::solid, cells, header, totals);
    if (closing) add_layer(bp::Layer::closing, cells, header, totals);
  }

  void add_mesh(bp::MeshInfo& info, std::unique_ptr<bp::TriangleSource> source, const std::string& in) {
    auto panel = std::make_unique<Panel>();
    if (!up_) up_ = source->up();
    bounds_.merge(info.totals.bounds);
    panel->bounds = info.totals.bounds;
    panel->view.label = fmt::format("{} triangles", info.totals.triangles);
    if (info.extras.levels > 1) panel->view.label += fmt::format(", finest of {} levels", info.extras.levels);
    if (several()) panel->view.label.insert(0, shown_name(in) + "\n");
    if (info.triangles.size() == info.totals.triangles) {
      panel->triangles = std::move(info.triangles);
      panel->view.triangles = panel->triangles;
      panel->colors = std::move(info.colors);
      panel->view.colors = panel->colors;
      panel->view.edges = !o_.no_edges && panel->triangles.size() <= (several() ? kEdgesOfMany : kEdges);
      if (several() && panel->view.edges) panel->view.color = {238, 192, 130};
    } else {
      panel->source = std::move(source);
      panel->view.source_colors = panel->source->has_colors();
      panel->view.source = panel->source.get();
    }
    panels_.push_back(std::move(panel));
  }

  /// Returns what the user should know of the picture; empty if there is nothing.
  [[nodiscard]] std::string write() {
    const bool apart = are_far_apart();
    if (apart) draw_by_themselves();
    std::vector<bp::View> views;
    for (const auto& panel : panels_) views.push_back(panel->view);
    bp::RenderOptions options;
    options.panel_width = options.panel_height = o_.image_size;
    options.azimuth = o_.azimuth, options.elevation = o_.elevation;
    options.bounds = bounds_;
    options.up = o_.up ? *o_.up : up_.value_or(bp::UpAxis::y);
    file_->write(bp::encode_png(bp::render(views, options)));
    file_->commit();
    if (!apart) return "";
    return "the inputs lie far apart: each is drawn by itself, not at one scale. The place of a tile's content is in "
           "tileset.json";
  }

 private:
  static constexpr double kFarApart = 4;                              // largest inputs between them
  static constexpr std::size_t kEdges = 50000, kEdgesOfMany = 20000;  // more would only darken the picture

  /// At one scale, hardly anything would be seen of any of them.
  [[nodiscard]] bool are_far_apart() const {
    double largest = 0;
    for (const auto& panel : panels_) {
      if (!panel->bounds.empty()) largest = std::max(largest, panel->bounds.diagonal());
    }
    return largest > 0 && bounds_.diagonal() > kFarApart * largest;
  }

  void draw_by_themselves() {
    for (const auto& panel : panels_) {
      panel->view.bounds = panel->bounds;
      panel->view.label += "\ndrawn by itself";
    }
  }

  void add_layer(bp::Layer layer, const bp::CoarseView& cells, const bp::StreamHeader& header,
                 const bp::StreamTotals& totals) {
    constexpr bp::Color kColors[] = {{168, 182, 202}, {214, 178, 132}};
    const auto i = std::size_t(layer);
    auto panel = std::make_unique<Panel>();
    panel->triangles = cells.surface(layer, header.frame);
    for (const bp::TriangleD& t : panel->triangles) {
      for (const bp::Vec3d& p : t) panel->bounds.add(p);
    }
    bounds_.merge(panel->bounds);
    panel->view.triangles = panel->triangles;
    panel->view.color = several() ? kColors[0] : kColors[i];
    panel->view.label = fmt::format("{}: {} voxels of {:.4g}", i == 0 ? "solid" : "closing", totals.layers[i].voxels,
                                    header.frame.voxel);
    if (cells.cell_voxels() > 1) panel->view.label += fmt::format("\ndrawn in cells of {} voxels", cells.cell_voxels());
    panels_.push_back(std::move(panel));
  }

  const Options& o_;
  std::unique_ptr<bp::OutputFile> file_;
  std::vector<std::unique_ptr<Panel>> panels_;
  bp::Bounds3d bounds_;
  std::optional<bp::UpAxis> up_;
};

void show_stream(const Options& o, const std::string& in, Picture& picture) {
  bp::BrickReader source(in);
  bp::OutputFile out("-", false);
  bp::CoarseView cells(source.header().bricks);
  if (o.dump) out.write(bp::dump_header(source.header()));
  bp::Brick brick;
  while (source.read(brick)) {
    if (picture.wanted()) cells.add(brick);
    if (o.dump) out.write(bp::dump_brick(brick));
  }
  const bp::StreamHeader& header = source.header();
  const bp::StreamTotals& totals = source.totals();
  if (picture.wanted()) picture.add_stream(cells, header, totals);
  if (o.dump) {
    out.write(bp::dump_end(totals));
  } else if (o.checksum) {
    out.write(totals.checksum() + "\n");
  } else if (o.json) {
    out.write(bp::stream_json(header, totals).dump(2) + "\n");
  } else {
    out.write(bp::stream_text(header, totals, in == "-" ? "stdin" : in));
  }
  out.commit();
}

void show_mesh(const Options& o, const std::string& in, Picture& picture) {
  if (o.dump) bp::fail(bp::ErrorCode::bad_argument, "{}: --dump is for brick streams, and this is none", in);
  bp::SceneOptions scene;
  scene.format = o.format;
  scene.colors = picture.wanted();
  auto source = bp::open_scene(in, scene);
  bp::MeshInfo info = bp::measure(*source);
  info.extras = bp::mesh_extras(in);
  if (o.checksum) {
    bp::print(info.totals.checksum() + "\n");
  } else {
    bp::print(o.json ? bp::mesh_json(info).dump(2) + "\n" : bp::mesh_text(info, in == "-" ? "stdin" : in));
  }
  if (picture.wanted()) picture.add_mesh(info, std::move(source), in);
}

/// By its name, as bpcheck does.
bool is_tileset(const Options& o, const std::string& in) {
  return o.format.empty() && in.ends_with(".json");
}

void show_tileset(const Options& o, const std::string& in, Picture& picture) {
  if (o.dump || o.checksum || picture.wanted())
    bp::fail(bp::ErrorCode::bad_argument, "{}: a tileset is described only; name its contents to see what they hold",
             in);
  const bp::TilesetInfo info = bp::tileset_info(in);
  bp::print(o.json ? bp::tileset_json(info).dump(2) + "\n" : bp::tileset_text(info, in));
}

void run(const Options& o) {
  Picture picture(o);
  for (const std::string& in : o.in)
    (is_tileset(o, in) ? show_tileset : is_stream(o, in) ? show_stream : show_mesh)(o, in, picture);
  if (!picture.wanted()) return;
  if (const std::string note = picture.write(); !note.empty()) std::fprintf(stderr, "bpinfo: note: %s\n", note.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpinfo", argc, argv, parse, run);
}
