// bpinfo: what a stream of voxels or a mesh holds. Manual: docs/bpinfo.1.md
#include <algorithm>
#include <cstdio>
#include <optional>

#include "io/deform/weight_file.h"
#include "io/scene/scene_format.h"
#include "io/scene/scene_parts.h"
#include "io/scene/scene_reader.h"
#include "io/scene/texture_table.h"
#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "io/tiles/tileset_file.h"
#include "io/tiles/tileset_level.h"
#include "lib/check/counted.h"
#include "lib/core/error.h"
#include "lib/levels/voxel_choice.h"
#include "lib/pass/voxelize/empty_scene.h"
#include "tools/cli/options/voxel.h"
#include "tools/cli/run_tool.h"
#include "tools/info/leak_view.h"
#include "tools/info/leaks.h"
#include "tools/info/mesh_info.h"
#include "tools/info/part_places.h"
#include "tools/info/picture.h"
#include "tools/info/stream_info.h"
#include "tools/info/tileset_info.h"
#include "tools/info/weight_info.h"
#include "tools/notes/leak_words.h"
#include "tools/run/inputs.h"

namespace {

struct Options {
  bp::CommonOptions common;
  std::vector<std::string> in;
  std::string format, boxes;
  bp::PictureOptions picture;
  std::optional<std::size_t> level;
  bp::VoxelOptions voxels;  ///< of --leaks
  bool json = false, dump = false, leaks = false, quiet = false;
};

/// Checks the options that belong to --leaks.
void check_leaks(Options& o, const bp::Args& args) {
  args.needs({"--voxel", "--resolution", "--memory", "--temp"}, "--leaks");
  if (!o.leaks) return;
  for (const char* other : {"--dump", "--boxes", "--level", "--pick"}) args.excludes(other, "--leaks");
  o.voxels.check_size();
  if (o.in.size() > 1) bp::fail(bp::ErrorCode::bad_argument, "--leaks takes one INPUT");
  o.voxels.scenes = o.in;
  o.voxels.format = o.format;
  o.voxels.up = o.picture.image.up;
}

/// Checks the options that print one thing only.
void check_alone(const Options& o) {
  if (o.json && o.dump) bp::fail(bp::ErrorCode::bad_argument, "--json and --dump exclude each other");
  if (o.in.size() > 1 && (o.json || o.dump)) bp::fail(bp::ErrorCode::bad_argument, "--json and --dump take one INPUT");
  if (o.picture.image.pick && (o.json || o.dump))
    bp::fail(bp::ErrorCode::bad_argument, "--pick prints a point and nothing else; leave out --json and --dump");
  if (!o.boxes.empty() &&
      (o.in.size() > 1 || o.json || o.dump || !o.picture.image.file.empty() || o.picture.image.pick))
    bp::fail(bp::ErrorCode::bad_argument,
             "--boxes takes one INPUT and prints boxes only; leave out --image, --pick, --json and --dump");
}

Options parse(bp::Args& args) {
  Options o;
  args.about("Tells what streams of voxels, meshes and tilesets hold, draws them, and checks a stream to its end.");
  args.positional("[INPUT...]", o.in,
                  "streams, meshes or scenes, tilesets (tileset.json or its folder); - is stdin (default: -)");
  args.group("Text");
  args.flag("--json", o.json, "print JSON");
  args.flag("--dump", o.dump, "print a stream as text, one line for each brick");
  args.option("--boxes", "NAME", o.boxes,
              "print boxes around the parts of a scene with this name or material (* and ? as in file names)");
  args.flag("--leaks", o.leaks,
            "tell where the inside of a scene or stream is open: the narrowest place on the widest way into each room");
  o.voxels.add_size(args, std::to_string(bp::kOccluderResolution) + ", for --leaks of a scene");
  o.picture.image.add_to(args);
  args.group("Input");
  args.option("--level", "N", o.level,
              "level of a glTF file to show, or of a tileset to draw; 0, the finest (default)");
  bp::add_scene_format(args, o.format, "INPUTs are meshes, and this is the ");
  o.common.add_to(args,
                  bp::CommonOptions::threads_part | bp::CommonOptions::memory_part | bp::CommonOptions::overwrite_part);
  args.flag("-q,--quiet", o.quiet, "show no notes");
  args.removed("--checksum", "the text and --json have it");
  args.often(
      {"--json", "--leaks", "--image", "--view", "--zoom", "--look-at", "--pick", "--boxes", "--level", "--overwrite"});
  args.example("bpinfo scene.glb closed.bpv proxy.glb --image all.png");
  args.parse();
  if (o.in.empty()) o.in = {"-"};
  for (std::string& in : o.in) in = bp::tileset_in(in);
  bp::check_scene_format(o.format, o.in);
  bp::check_stdin_once(o.in);
  bp::keep_inputs(o.in);
  if (!o.picture.image.file.empty()) bp::check_panel_size(o.picture.image.panel_size, o.in.size());
  check_leaks(o, args);
  o.picture.image.check(args, o.leaks);
  check_alone(o);
  o.picture.several = o.in.size() > 1;
  o.picture.overwrite = o.common.overwrite;
  return o;
}

/// Returns whether the input is a stream of voxels. stdin and pipes are, since they cannot be read twice; files tell by
/// their first bytes.
bool is_stream(const Options& o, const std::string& in) {
  if (!o.format.empty()) return false;
  if (in == "-") return true;
  const bp::InputFile file(in);
  if (!file.seekable()) return true;
  if (file.size() == 0) return bp::scene_format_of(in).empty();
  return bp::begins_as_stream(in) || in.ends_with(".bpv");
}

/// Decides by the name, as bpcheck does.
bool is_tileset(const Options& o, const std::string& in) {
  return o.format.empty() && in.ends_with(".json");
}

/// Decides by the first bytes. They are those of a stream of voxels except for the magic.
bool is_weights(const Options& o, const std::string& in) {
  return o.format.empty() && in != "-" && bp::begins_as_weights(bp::InputFile(in));
}

void note(const Options& o, const std::string& text) {
  if (!o.quiet) std::fprintf(stderr, "bpinfo: note: %s\n", text.c_str());
}

void check_level(const std::string& in, std::size_t level, std::size_t levels) {
  if (level < levels) return;
  if (levels <= 1) bp::fail(bp::ErrorCode::bad_argument, "{}: --level {} is not there; it has one level, 0", in, level);
  bp::fail(bp::ErrorCode::bad_argument, "{}: --level {} is not there; it has 0, the finest, to {}", in, level,
           levels - 1);
}

/// Returns whether the file can have levels, though many have one.
bool is_gltf(const std::string& in) {
  const std::string format = bp::scene_format_of(in);
  return format == "glb" || format == "gltf";
}

/// Refuses --level where it would be ignored in silence.
void check_level_is_used(const Options& o) {
  const auto has_levels = [&](const std::string& in) {
    return is_tileset(o, in) ? !o.picture.image.file.empty() : is_gltf(in);
  };
  if (!o.level || std::any_of(o.in.begin(), o.in.end(), has_levels)) return;
  bp::fail(bp::ErrorCode::bad_argument,
           "--level: means nothing here; it is for glTF files (not stdin), which may have levels (MSFT_lod), and for "
           "tilesets with --image");
}

void show_stream(const Options& o, const std::string& in, bp::Picture& picture) {
  bp::BrickReader source(in);
  if (picture.wanted() && o.in.size() == 1)  // now that it is known how many layers are drawn
    bp::check_panel_size(o.picture.image.panel_size, source.header().has_closing ? 2 : 1);
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
  if (picture.wanted()) picture.add_stream(cells, header, totals, in);
  if (o.dump) {
    out.write(bp::dump_end(totals));
  } else if (o.json) {
    out.write(bp::stream_json(header, totals).dump(2) + "\n");
  } else if (!o.picture.image.pick) {
    out.write(bp::stream_text(header, totals, in == "-" ? "stdin" : in));
  }
  out.commit();
}

void note_missing_materials(const Options& o, const std::string& in) {
  for (const std::string& file : bp::missing_materials(in))
    note(o, fmt::format("{}: {}, and its colours are not drawn", in, file));
}

void note_faults(const Options& o, const bp::SceneOptions& scene) {
  for (const std::string& fault : scene.textures->faults()) note(o, fault);
}

void show_mesh(const Options& o, const std::string& in, bp::Picture& picture) {
  if (o.dump) bp::fail(bp::ErrorCode::bad_argument, "{}: --dump is for streams of voxels, and this is not one", in);
  const bp::MeshExtras extras = bp::mesh_extras(in);
  bp::SceneOptions scene;
  scene.format = o.format;
  scene.colors = picture.wanted();
  if (picture.wanted()) scene.textures = std::make_shared<bp::TextureTable>();
  scene.part_names = std::make_shared<bp::PartNames>();
  if (is_gltf(in)) scene.level = o.level.value_or(0);
  check_level(in, scene.level, extras.levels);
  auto source = bp::open_scene(in, scene);
  bp::MeshInfo info = bp::measure(*source);
  if (info.totals.triangles == 0) bp::refuse_empty_scene(source->name(), info.counts);
  info.extras = extras;
  info.level = scene.level;
  info.names = *scene.part_names;
  if (!o.picture.image.pick && !o.leaks)
    bp::print(o.json ? bp::mesh_json(info).dump(2, ' ', false, bp::Json::error_handler_t::replace) + "\n"
                     : bp::mesh_text(info, in == "-" ? "stdin" : in));
  if (!picture.wanted()) return;
  note_missing_materials(o, in);
  note_faults(o, scene);
  picture.add_mesh(info, std::move(source), in, bp::level_text(info.level, extras.levels), scene.textures);
}

void draw_tileset(const Options& o, const bp::Tileset& tileset, const std::string& in, bp::Picture& picture) {
  const std::size_t wanted = o.level.value_or(0);
  bp::TilesetLevel level = bp::tileset_level(tileset, in, wanted);
  if (level.levels == 0) bp::fail(bp::ErrorCode::bad_input, "{}: no tile has a content; there is nothing to draw", in);
  check_level(in, wanted, level.levels);
  const std::size_t there = level.contents.size(), all = there + level.missing.size();
  if (!level.missing.empty())
    note(o, fmt::format("{}: {} of {} contents of level {} are not there, and not drawn; the first is {}", in,
                        level.missing.size(), all, wanted, level.missing[0]));
  bp::SceneOptions scene;
  scene.colors = true;
  scene.textures = std::make_shared<bp::TextureTable>();
  auto source = bp::open_contents(tileset, std::move(level.contents), in, scene);
  bp::MeshInfo info = bp::measure(*source);
  const std::string which = bp::level_text(wanted, level.levels);
  picture.add_mesh(info, std::move(source), in,
                   fmt::format("{}{} tile{}", which.empty() ? "" : which + "\n", there, there == 1 ? "" : "s"),
                   scene.textures);
}

void show_tileset(const Options& o, const std::string& in, bp::Picture& picture) {
  if (o.dump)
    bp::fail(bp::ErrorCode::bad_argument,
             "{}: a tileset is described and drawn only; name its contents to see what they hold", in);
  const bp::Tileset tileset = bp::read_tileset(in);
  const bp::TilesetInfo info = bp::tileset_info(tileset, in);
  if (!o.picture.image.pick) bp::print(o.json ? bp::tileset_json(info).dump(2) + "\n" : bp::tileset_text(info, in));
  if (picture.wanted()) draw_tileset(o, tileset, in, picture);
}

void show_weights(const Options& o, const std::string& in, bp::Picture& picture) {
  if (o.dump || picture.wanted())
    bp::fail(bp::ErrorCode::bad_argument, "{}: weights are described only; name their scene or their cage", in);
  const bp::WeightInfo info = bp::weight_info(in);
  bp::print(o.json ? bp::weight_json(info).dump(2) + "\n" : bp::weight_text(info, in));
}

/// Reads the last layer of a stream, and adds it to the picture.
bp::WallVoxels stream_walls(const Options& o, const std::string& in, const bp::LeakMemory& memory,
                            bp::Picture& picture) {
  bp::BrickReader source(in);
  bp::WallVoxels walls{source.header(), bp::make_shelf(memory.shelf, o.common.temp)};
  const bp::Layer layer = walls.header.has_closing ? bp::Layer::closing : bp::Layer::solid;
  if (walls.header.fill == bp::FillMode::inside)
    bp::fail(bp::ErrorCode::bad_input, "{}: holds the inside without its walls (--fill inside); give --leaks the scene",
             in == "-" ? "stdin" : in);
  bp::require_leak_memory(walls.header, memory.search);
  bp::CoarseView cells(walls.header.bricks);
  for (bp::Brick brick; source.read(brick);) {
    if (picture.wanted()) cells.add(brick);
    if (brick.layer == layer) walls.bricks->put(brick.coord, brick.fill, brick.bits);
  }
  if (picture.wanted()) picture.add_stream(cells, walls.header, source.totals(), in);
  return walls;
}

/// Points at the leaks in the picture, from a direction that shows the first.
void point_at_leaks(const Options& o, const bp::LeakInfo& info, const bp::BitBox& walls, bp::Picture& picture) {
  if (info.leaks.empty()) return;
  bp::LeakView view = bp::view_of(info.leaks[0], walls, info.frame);
  if (o.picture.image.view_given) view = {o.picture.image.azimuth, o.picture.image.elevation};
  const auto place = [&](const bp::Leak& leak) { return bp::middle_of(leak.place, info.frame); };
  std::vector<bp::Mark> marks;
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < info.leaks.size(); ++i) {
    const bool seen = bp::is_seen(info.leaks[i], view, walls, info.frame);
    hidden += std::size_t(!seen);
    if (seen || i == 0) marks.push_back({place(info.leaks[i]), fmt::format("{}{}", i + 1, seen ? "" : ", behind")});
  }
  std::string text = "leak 1: " + bp::place_text(place(info.leaks[0]), info.frame);
  if (hidden > 0) text += fmt::format("\n{} of {} behind walls", hidden, bp::counted(info.leaks.size(), "leak"));
  picture.point_at(std::move(marks), view.azimuth, view.elevation, text);
}

void show_leaks(const Options& o, const std::string& in, bp::Picture& picture) {
  const bool stream = is_stream(o, in);
  if (stream && (o.voxels.voxel || o.voxels.resolution))
    bp::fail(bp::ErrorCode::bad_argument, "{}: is a stream, which has its voxels; leave out --voxel and --resolution",
             in == "-" ? "stdin" : in);
  if (!stream && in == "-" && picture.wanted())
    bp::fail(bp::ErrorCode::bad_argument, "a scene from stdin is read once; --leaks with --image takes a file");
  const bp::LeakMemory memory(o.common.memory_bytes);
  const bp::WallVoxels walls = stream ? stream_walls(o, in, memory, picture) : bp::wall_voxels(o.voxels, o.common);
  const bp::BitBox voxels = bp::dense_voxels(walls);
  bp::LeakInfo info = bp::leak_info(walls.header, voxels, memory.search);
  bp::SceneOptions how;
  how.temp_dir = o.common.temp;
  how.walls_only = !stream;
  bp::name_parts(walls.header, how, info);
  bp::print(o.json ? bp::leak_json(info).dump(2, ' ', false, bp::Json::error_handler_t::replace) + "\n"
                   : bp::leak_text(info, in == "-" ? "stdin" : in));
  if (!picture.wanted()) return;
  if (is_tileset(o, in)) draw_tileset(o, bp::read_tileset(in), in, picture);
  if (!stream && !is_tileset(o, in)) show_mesh(o, in, picture);
  point_at_leaks(o, info, voxels, picture);
}

/// Returns the places of parts, as text: of the scene that a stream was made of, or of a scene in a file.
std::string part_places(const Options& o, const std::string& in) {
  if (is_tileset(o, in)) bp::fail(bp::ErrorCode::bad_argument, "{}: --boxes is for scenes; tiles have no parts", in);
  if (is_weights(o, in)) bp::fail(bp::ErrorCode::bad_argument, "{}: --boxes is for scenes; weights have no parts", in);
  if (is_stream(o, in)) {
    const bp::BrickReader stream(in);
    return bp::part_places(stream.header().scene, stream.header().bounds, o.boxes);
  }
  bp::SceneOptions options;
  options.format = o.format;
  bp::Bounds3d bounds;
  const auto source = bp::open_scene(in, options);
  for (std::vector<bp::TriangleD> chunk; source->read(chunk);) {
    for (const bp::TriangleD& t : chunk) {
      for (const bp::Vec3d& p : t) bounds.add(p);
    }
  }
  bp::SceneFiles scene;
  scene.files = {{in, bp::InputFile(in).size()}};
  scene.format = o.format;
  return bp::part_places(scene, bounds, o.boxes);
}

void run(const Options& o) {
  check_level_is_used(o);
  if (!o.boxes.empty()) return bp::print(part_places(o, o.in[0]));
  bp::Picture picture(o.picture);
  for (const std::string& in : o.in)
    (o.leaks             ? show_leaks
     : is_tileset(o, in) ? show_tileset
     : is_weights(o, in) ? show_weights
     : is_stream(o, in)  ? show_stream
                         : show_mesh)(o, in, picture);
  if (!picture.wanted()) return;
  for (const std::string& text : picture.write()) note(o, text);
  if (o.picture.image.pick) bp::print(picture.picked() + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpinfo", argc, argv, parse, run);
}
