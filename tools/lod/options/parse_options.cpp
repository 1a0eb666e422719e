#include "tools/lod/options/parse_options.h"

#include <algorithm>
#include <filesystem>

#include "io/files/utf8.h"
#include "io/scene/scene_format.h"
#include "lib/check/counted.h"
#include "lib/core/error.h"
#include "lib/grid/cells.h"
#include "tools/cli/names.h"
#include "tools/cli/output_name.h"
#include "tools/lod/choices.h"

namespace bp {

namespace {

constexpr std::int64_t kMostHullsAsked = 4096;

/// The first scene's file name without folder and extension.
std::string base_name(const std::string& path) {
  const std::string file = path.substr(path.rfind('/') + 1);
  return file == "-" ? "scene" : file.substr(0, file.rfind('.'));
}

/// Returns the value as JSON, or null.
template <class T>
Json optional_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json optional_json(const std::optional<Length>& length) {
  return length ? Json(length->text()) : Json(nullptr);
}

/// Parses "5%" as 0.05.
double parse_share(const std::string& text) {
  const double percent = text.ends_with('%') ? parse_number(text.substr(0, text.size() - 1)) : -1;
  if (!(percent >= 0 && percent <= 100)) fail(ErrorCode::bad_argument, "'{}' is no share from 0% to 100%", text);
  return percent / 100;
}

/// Returns the value that has this name.
template <class T>
T parse_named(const std::string& text, std::initializer_list<T> values, const char* names) {
  for (const T value : values) {
    if (text == name_of(value)) return value;
  }
  fail(ErrorCode::bad_argument, "{}: must be {}", text, names);
}

Symmetry parse_symmetry(const std::string& text) {
  return parse_named(text, {Symmetry::x, Symmetry::y, Symmetry::z, Symmetry::off, Symmetry::automatic},
                     "auto, x, y, z or off");
}

std::optional<Length> parse_rooms(const std::string& text) {
  if (text == "filled") return {};
  if (text == "open") return Length{};
  const Length height = parse_length(text);
  if (height.value == 0) fail(ErrorCode::bad_argument, "{}: must be open, filled or the height of a person", text);
  return height;
}

HullFiles parse_hull_files(const std::string& text) {
  return parse_named(text, {HullFiles::obj, HullFiles::stl}, "obj or stl");
}

/// Returns numbers as numbers, and percentages as text.
Json faces_json(const LevelOptions& levels) {
  if (levels.shares.empty()) return levels.faces;
  Json all = Json::array();
  for (const double share : levels.shares) all.push_back(Length{share, Length::Unit::percent}.text());
  return all;
}

/// Understands -o DIR/foo.obj as levels in OBJ that are called foo.
void take_obj_name(const Args& args, BuildOptions& o) {
  const std::filesystem::path out(o.out);
  std::error_code none;
  if (o.profile != LodProfile::gltf || scene_format_of(o.out) != "obj" || out.stem().empty() ||
      out.stem().string().starts_with('.') || std::filesystem::is_directory(out, none))
    return;
  if (args.given("--name")) fail(ErrorCode::bad_argument, "--name: -o {} names the files already", o.out);
  if (o.asked_compression) fail(ErrorCode::bad_argument, "--compression is of GLB files; give -o a folder");
  o.obj = true;
  o.name = out.stem().string();
  o.out = out.has_parent_path() ? out.parent_path().string() : ".";
  if (o.appearance == Appearance::automatic)
    o.appearance = Appearance::texture;  // OBJ has no standard for colours of vertices
}

/// Tells the files that the profile writes into the folder.
const char* files_of_profile(LodProfile profile) {
  constexpr const char* kFiles[] = {"levels as GLB, or as OBJ with -o DIR/NAME.obj", "tileset.json, and tiles as GLB",
                                    "bodies as GLB, and hulls as OBJ or STL", "an occluder as GLB",
                                    "a cage as OBJ and GLB"};
  return kFiles[std::size_t(profile)];
}

void check_output(const BuildOptions& o) {
  if (o.out.empty() && !o.tiles && !o.explain) fail(ErrorCode::bad_argument, "name the folder of the levels with -o");
  check_folder_name(o.out, o.name, files_of_profile(o.profile));
}

/// Refuses options that have no meaning for the profile.
void check_profile(const Args& args, const BuildOptions& o) {
  const auto refuse = [&](std::initializer_list<const char*> names) {
    for (const char* const name : names)
      if (args.given(name))
        fail(ErrorCode::bad_argument, "{} has no meaning with --profile {}", name, name_of(o.profile));
  };
  const auto needs = [&](std::initializer_list<const char*> names, LodProfile profile) {
    for (const char* const name : names)
      if (args.given(name) && o.profile != profile)
        fail(ErrorCode::bad_argument, "{} needs --profile {}", name, name_of(profile));
  };
  needs({"--tile", "--tiles", "--cache", "--leaves", "--place", "--crs"}, LodProfile::tiles);
  if (o.asked_compression && o.profile != LodProfile::gltf && !o.is_tileset())
    fail(ErrorCode::bad_argument, "--compression needs --profile gltf or 3dtiles");
  needs({"--hulls", "--hull-corners", "--hull-files"}, LodProfile::collision);
  needs({"--margin", "--symmetry"}, LodProfile::cage);
  needs({"--min-hidden", "--rooms"}, LodProfile::occluder);
  if (o.is_tileset() && args.given("--origin") && !(o.place.place && o.proxy.origin.kind == OriginOption::Kind::point))
    fail(ErrorCode::bad_argument,
         "--origin: a tileset holds its place in double, in the transforms of its tiles; leave it out, or name with "
         "--origin X,Y,Z the point that stands at --place");
  if (o.profile == LodProfile::collision && args.given("--appearance") && o.colors())
    fail(ErrorCode::bad_argument, "--profile collision has no colours; leave --appearance out");
  if (o.profile == LodProfile::occluder)
    refuse({"--mode", "--enclose", "--fill", "--error", "--appearance", "--field"});
  if (o.is_tileset()) refuse({"--field"});
  if (o.is_cage()) refuse({"--mode", "--appearance", "--enclose", "--error", "--scale", "--field"});
  if (o.profile == LodProfile::collision && o.proxy.mode != MeshMode::bounding)
    fail(ErrorCode::bad_argument, "--profile collision needs --mode bounding");
  if (o.proxy.mode == MeshMode::fit && args.given("--enclose"))
    fail(ErrorCode::bad_argument, "a fit encloses nothing and is not tightened; --enclose has no meaning");
  if (o.leaves && !can_read_again(o))
    fail(ErrorCode::bad_argument, "--leaves scene: a scene from a pipe cannot be read again; give it as a file");
  const bool scene = o.proxy.enclose.kind == EncloseOption::Kind::scene;
  if (scene && !can_read_again(o))
    fail(ErrorCode::bad_argument, "--enclose scene: a scene from a pipe cannot be read again; give it as a file");
}

/// Sets the options of profiles that have only one level, which nobody looks at.
void set_one_level(BuildOptions& o) {
  if (o.profile == LodProfile::gltf || o.is_tileset()) return;
  if (!o.levels.levels && asks_for_nothing(request_of(o))) o.levels.levels = 1;
  if (level_count(request_of(o)) != 1) fail(ErrorCode::bad_argument, "--profile {} has one level", name_of(o.profile));
  o.appearance = Appearance::off;
  if (o.profile != LodProfile::occluder) return;
  if (!o.levels.shares.empty())
    fail(ErrorCode::bad_argument, "--faces {}%: an occluder takes a number of faces; some hundred are enough",
         o.levels.shares.front());
  o.proxy.mode = MeshMode::inside;
  o.voxels.fill = FillMode::none;
}

void check_levels(const BuildOptions& o) {
  const LevelRequest r = request_of(o);
  if (o.is_tileset() && !r.shares.empty())
    fail(
        ErrorCode::bad_argument,
        "--faces {}%: of a tileset --faces is the budget of each tile, whose triangles are not counted; give a number, "
        "or leave it out, and the scene decides",
        r.shares.front());
  if (asks_for_faces(r) && !r.errors_world.empty())
    fail(ErrorCode::bad_argument, "--faces and --error exclude each other");
  if (r.levels && (*r.levels < 1 || *r.levels > kMostLevels))
    fail(ErrorCode::bad_argument, "--levels {}: must be 1 to {}", *r.levels, kMostLevels);
  const std::size_t listed = std::max({r.faces.size(), r.shares.size(), r.errors_world.size()});
  if (r.levels && listed > 1 && listed != *r.levels)
    fail(ErrorCode::bad_argument,
         "--levels {}: {} lists {} numbers, one for each level; list {}, or leave --levels out", *r.levels,
         r.errors_world.empty() ? "--faces" : "--error", listed, *r.levels);
}

void check_jobs(const BuildOptions& o) {
  if (o.tile_vox < kBrickEdge || o.tile_vox % kBrickEdge != 0)
    fail(ErrorCode::bad_argument, "--tile {}: must be a multiple of 64", o.tile_vox);
  if (o.tiles && o.explain) fail(ErrorCode::bad_argument, "--explain numbers the jobs; leave --tiles out");
  if (o.explain && !o.inputs.empty())
    fail(ErrorCode::bad_argument, "--inputs tells what levels were made of, and --explain makes none; leave one out");
  if (o.explain && !o.cache.empty() && !can_read_again(o))
    fail(ErrorCode::bad_argument, "--explain reads the scene twice to find what is kept; give it as a file");
  if (o.tiles && o.cache.empty())
    fail(ErrorCode::bad_argument,
         "--tiles makes no tileset but results for a later run; name their folder with --cache");
  if (o.tiles && !o.out.empty())
    fail(ErrorCode::bad_argument, "--tiles writes no tileset; leave -o to the run that puts the tiles together");
}

void declare_looks(Args& args, BuildOptions& o) {
  args.option(
      "--appearance",
      {{"auto", Appearance::automatic, "a texture if the scene has textures, else colours"},
       {"texture", Appearance::texture, "a texture with what the scene's textures and colours show, if it has any"},
       {"full", Appearance::full, "and normals, roughness, metal and light, as images"},
       {"color", Appearance::color, "colours on vertices, of the scene's materials and vertices, if it has any"},
       {"off", Appearance::off, "neither"}},
      o.appearance, "textures or colours of the levels");
  args.option("--compression,--tile-compression",
              {{"auto", std::optional<Compression>{}, "meshopt for 3dtiles only"},
               {"meshopt", {Compression::meshopt}, "small, with EXT_meshopt_compression"},
               {"none", {Compression::none}, "plain glTF"}},
              o.asked_compression, "how GLB files are stored");
}

void declare_profile(Args& args, BuildOptions& o) {
  args.group("Profile");
  args.option("--profile",
              {{"gltf", LodProfile::gltf, "levels of detail as GLB"},
               {"3dtiles", LodProfile::tiles, "a tileset; to look at: --mode visual"},
               {"collision", LodProfile::collision,
                "a body for physics: one mesh for Godot and Unity, convex hulls for Unreal"},
               {"occluder", LodProfile::occluder, "one mesh inside, for culling in Godot"},
               {"cage", LodProfile::cage, "quads and triangles, to deform with"}},
              o.profile, "what the levels are for");
  args.option(
      "--hulls", "N", [&o](const std::string& text) { o.hulls = parse_count(text, 1, kMostHullsAsked); },
      "collision: largest number of convex hulls (default: 32 or 64, or one for each part)");
  args.option(
      "--hull-corners", "N",
      [&o](const std::string& text) { o.hull_corners = parse_count(text, 8, std::int64_t(kMostCorners)); },
      "collision: most corners of a hull: 64 for PhysX, 32 for MJX (default: 64)");
  args.option(
      "--hull-files", "obj|stl", [&o](const std::string& text) { o.hull_files = parse_hull_files(text); },
      "collision: each hull in a file of its own, too, and a MuJoCo model and a URDF of them");
  args.option(
      "--symmetry", "auto|x|y|z|off", [&o](const std::string& text) { o.symmetry = parse_symmetry(text); },
      "cage: the axis across which its halves mirror each other (default: the scene's, if it has one)");
  args.option(
      "--min-hidden", "SHARE", [&o](const std::string& text) { o.min_hidden = parse_share(text); },
      "occluder: fail if it holds less of the scene's bounds, as 5%");
  args.option(
      "--rooms", "filled|open|HEIGHT", [&o](const std::string& text) { o.rooms = parse_rooms(text); },
      "occluder: fill rooms, or leave those open that a person so high can enter (default: filled)");
  args.option("--margin", "LENGTH", o.margin, "cage: least distance from the scene");
  declare_looks(args, o);
}

void declare_tileset(Args& args, BuildOptions& o) {
  args.group("Tileset");
  args.option("--tile", "N", o.tile_vox, "voxels along the side of a tile; larger levels are cut into tiles");
  args.option("--leaves",
              {{"none", false, "the finest level ends the tileset"},
               {"scene", true, "the scene's own triangles and images, for close views"}},
              o.leaves, "what lies below the finest level");
  o.place.add_to(args);
  args.option("--cache", "DIR", o.cache, "keep the results of all jobs in DIR, and reuse what has not changed");
  args.option(
      "--tiles", "A..B", [&o](const std::string& text) { o.tiles = parse_job_range(text); },
      "fill --cache with jobs A to before B, and write no tileset");
}

void declare(Args& args, BuildOptions& o) {
  args.about("Makes levels of detail of scenes: coarser and coarser proxies around them.");
  o.voxels.add_scenes(args, "scenes");
  args.option("-o,--output", "DIR", o.out, "folder of the levels, made if missing; or NAME.obj: levels as OBJ");
  args.option("--name", "NAME", o.name, "first part of the names of files and nodes (default: the first scene's)");
  declare_profile(args, o);
  o.levels.add_of_scene(args, "as many as are listed; else 4, or fewer where a level would have less than 12 faces",
                        "half of the scene's, at most 10000; other profiles: fewer");
  o.proxy.add_of_scene(args);
  o.voxels.add_to(args,
                  "from --faces, 256 to 1024; from --error, 8 voxels to an error; occluder: 512; 3dtiles: from "
                  "the scene, 256 to 4096");
  o.closing.add_to(args, " of the finest level", "; it doubles from level to level (default: from --faces or --error)");
  args.option(
      "--field", "FILE", o.field,
      "rules (bpscale(1)) for where levels are finer or coarser: a level's scale is to a rule's as the base is");
  declare_tileset(args, o);
  o.common.add_to(args, CommonOptions::all_parts & ~unsigned(CommonOptions::device_part));
  args.group("Messages");
  args.option("--inputs", "FILE", o.inputs, "list the files that were read or looked for");
  args.flag("--explain", o.explain, "print what would be made, and what is kept of it; make nothing");
  args.removed("--no-tighten", "levels are always tightened; --enclose closing makes the loosest ones");
  args.removed("--colors", "--appearance color|off says what the levels carry");
  args.removed("--element", "bplod closes with cubes, and with balls for --mode fit; bpclose takes either");
  args.removed("--device",
               "bplod computes on the CPU, which takes most of the time anyway; BP_BACKEND chooses another");
  args.removed("--resume", "--cache DIR keeps what is done, and a run after a kill goes on from there");
  args.removed("--screen",
               "--error takes pixels: --error 800px is one pixel where the scene's diagonal is 800 pixels on screen");
  args.often({"--output", "--profile", "--faces", "--error", "--levels", "--up", "--overwrite"});
  args.needed("--output");
  args.example("bplod plant.glb --profile collision -o plant-collision");
}

}  // namespace

JobRange parse_job_range(const std::string& text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) fail(ErrorCode::bad_argument, "{}: is not of the form A..B", text);
  const std::int64_t begin = parse_integer(std::string_view(text).substr(0, dots), 0, INT64_MAX);
  const std::int64_t end = parse_integer(std::string_view(text).substr(dots + 2), 0, INT64_MAX);
  if (begin > end) fail(ErrorCode::bad_argument, "{}: ends before it begins", text);
  return {std::uint64_t(begin), std::uint64_t(end)};
}

void check_name(BuildOptions& o) {
  const bool given = !o.name.empty();
  if (!given) o.name = base_name(o.voxels.scenes.front());
  if (o.name.empty() || o.name.find('/') != std::string::npos)
    fail(ErrorCode::bad_argument, "--name '{}': must be a name without a folder", o.name);
  if (one_line(o.name) != o.name)
    fail(ErrorCode::bad_argument, "{} '{}': has a line break or another control character; give a --name without",
         given ? "--name" : "the scene's name", o.name);
  if (!is_utf8(o.name))
    fail(ErrorCode::bad_argument, "{} '{}': is not UTF-8, as names in glTF are; give a --name in UTF-8",
         given ? "--name" : "the scene's name", o.name);
}

void settle(BuildOptions& o) {
  // A fit searches for the scene from the closing's surface. At slanted sides the closing by a cube lies about as far
  // from the scene as that search reaches, and the fit would get thorns there; balls follow such sides.
  if (o.proxy.mode == MeshMode::fit) o.closing.element = StructuringElement::ball;
  set_one_level(o);
  check_levels(o);
}

BuildOptions parse_build_options(Args& args) {
  BuildOptions o;
  declare(args, o);
  args.parse();
  o.voxels.check();
  o.proxy.check();
  if (!o.field.empty()) keep_inputs({o.field});
  check_profile(args, o);
  o.place.check(o.voxels.up, can_read_again(o));
  o.place.at = o.proxy.origin.point;
  settle(o);
  take_obj_name(args, o);
  check_visual(args, o);
  check_output(o);
  check_jobs(o);
  check_name(o);
  return o;
}

Json options_json(const BuildOptions& o) {
  Json errors = Json::array();
  for (const Length& error : o.levels.errors) errors.push_back(error.text());
  return {{"profile", name_of(o.profile)},
          {"mode", o.mode_name()},
          {"name", o.name},
          {"levels", optional_json(o.levels.levels)},
          {"faces", faces_json(o.levels)},
          {"error", errors},
          {"voxel", optional_json(o.voxels.voxel)},
          {"resolution", optional_json(o.voxels.resolution)},
          {"tile", o.tile_vox},
          {"symmetry", o.is_cage() ? Json(name_of(o.symmetry)) : Json(nullptr)},
          {"margin", o.is_cage() ? Json(o.margin.text()) : Json(nullptr)},
          {"min_hidden", o.min_hidden > 0 ? Json(o.min_hidden) : Json(nullptr)},
          {"rooms", !o.rooms             ? "filled"
                    : o.rooms->value > 0 ? o.rooms->text()
                                         : "open"},
          {"hulls", o.hulls > 0 ? Json(o.hulls) : Json(nullptr)},
          {"hull_corners", o.hull_corners},
          {"hull_files", o.hull_files == HullFiles::none ? Json(nullptr) : Json(name_of(o.hull_files))},
          {"cache", !o.cache.empty()},
          {"place", o.place.place ? Json(*o.place.place) : Json(nullptr)},
          {"crs", o.place.crs.empty() ? Json(nullptr) : Json(o.place.crs)},
          {"leaves", o.leaves ? "scene" : "none"},
          {"compression", o.compression() == Compression::none ? "none" : "meshopt"},
          {"tiles", o.tiles ? Json{o.tiles->begin, o.tiles->end} : Json(nullptr)},
          {"explain", o.explain},
          {"scale", optional_json(o.closing.scale)},
          {"field", !o.field.empty()},
          {"element", name_of(o.closing.element)},
          {"enclose", o.proxy.enclose.text()},
          {"fill", name_of(o.voxels.fill)},
          {"appearance", name_of(o.appearance)},
          {"up", o.voxels.up ? Json(name_of(*o.voxels.up)) : Json(nullptr)},
          {"origin", o.proxy.origin.text().empty() ? Json(nullptr) : Json(o.proxy.origin.text())},
          {"threads", o.common.threads},
          {"memory", o.common.memory_bytes}};
}

}  // namespace bp
