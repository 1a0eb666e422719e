#include "tools/lod/build_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/scene/scene_format.h"
#include "lib/core/error.h"
#include "lib/grid/cells.h"
#include "lib/pass/voxelize/voxelize_stage.h"
#include "lib/volume/boundary_runs.h"
#include "tools/cli/face_list.h"
#include "tools/cli/names.h"
#include "tools/run/enclosed_triangles_limit.h"
#include "tools/run/inputs.h"

namespace bp {

namespace {

constexpr std::int64_t kMostHullsAsked = 4096;

/// The first scene's file name without folder and extension.
std::string base_name(const std::string& path) {
  const std::string file = path.substr(path.rfind('/') + 1);
  return file == "-" ? "scene" : file.substr(0, file.rfind('.'));
}

/// The value, or null.
template <class T>
Json optional_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json optional_json(const std::optional<Length>& length) {
  return length ? Json(length->text()) : Json(nullptr);
}

/// As JSON wants it: every profile writes the name into some.
bool is_utf8(const std::string& text) {
  try {
    (void)Json(text).dump();
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

void check_name(BuildOptions& o) {
  const bool given = !o.name.empty();
  if (!given) o.name = base_name(o.scenes.front());
  if (o.name.empty() || o.name.find('/') != std::string::npos)
    fail(ErrorCode::bad_argument, "--name '{}': must be a name without a folder", o.name);
  if (!is_utf8(o.name))
    fail(ErrorCode::bad_argument, "{} '{}': is not UTF-8, as names in glTF are; give a --name in UTF-8",
         given ? "--name" : "the scene's name", o.name);
}

void set_faces(LodRequest& request, const std::string& text) {
  const bool percent = text.find('%') != std::string::npos;
  request.faces = percent ? std::vector<std::uint64_t>() : parse_face_list(text);
  request.shares = percent ? parse_face_shares(text) : std::vector<double>();
}

/// Numbers as numbers, percentages as text.
Json faces_json(const LodRequest& request) {
  if (request.shares.empty()) return request.faces;
  Json all = Json::array();
  for (const double share : request.shares) all.push_back(Length{share, Length::Unit::percent}.text());
  return all;
}

/// -o foo.glb: who writes that wants a file, and there are several.
void check_folder_name(const BuildOptions& o) {
  const std::string extension = scene_format_of(o.out);
  std::error_code none;
  if (extension.empty() || std::filesystem::is_directory(o.out, none)) return;
  const std::string folder = o.out.substr(0, o.out.size() - extension.size() - 1);
  fail(ErrorCode::bad_argument,
       "-o {}: bplod writes several files to a folder, and this is the name of a file; did you mean -o {}?", o.out,
       folder.empty() || folder.ends_with('/') ? folder + o.name : folder);
}

/// Whether levels are one mesh each, and something has to stay inside while they are tightened.
bool may_enclose_scene(const BuildOptions& o) {
  return (o.profile == LodProfile::gltf || o.profile == LodProfile::collision) && o.mode == MeshMode::bounding &&
         !o.loose;
}

/// What would be passed over in silence.
void check_meaning(const Args& args, const BuildOptions& o) {
  if (o.profile != LodProfile::tiles) {
    for (const char* const name : {"--tile", "--tiles", "--cache", "--resume"}) {
      if (args.given(name)) fail(ErrorCode::bad_argument, "{} needs --profile 3dtiles", name);
    }
  }
  if (o.profile == LodProfile::tiles && args.given("--origin"))
    fail(ErrorCode::bad_argument,
         "--origin: a tileset holds its place in double, in the transforms of its tiles; leave it out, and move the "
         "tileset by the transform of its root");
  if (o.profile != LodProfile::collision && args.given("--hulls"))
    fail(ErrorCode::bad_argument, "--hulls needs --profile collision");
  if (o.profile == LodProfile::collision && args.given("--colors") && o.colors)
    fail(ErrorCode::bad_argument, "--profile collision has no colours; leave --colors out");
  if (o.profile == LodProfile::occluder) {
    for (const char* const name : {"--mode", "--enclose", "--fill", "--error", "--screen", "--colors", "--explain"})
      if (args.given(name)) fail(ErrorCode::bad_argument, "{} has no meaning with --profile occluder", name);
  }
  if (o.mode == MeshMode::fit) {
    for (const char* const name : {"--enclose", "--no-tighten"}) {
      if (args.given(name))
        fail(ErrorCode::bad_argument, "a fit encloses nothing and is not tightened; {} has no meaning", name);
    }
  }
  if (o.enclose == Enclose::scene && o.profile == LodProfile::tiles)
    fail(ErrorCode::bad_argument, "--enclose scene: tiles enclose voxels; leave it out, or take another --profile");
  if (o.enclose == Enclose::scene && !can_read_again(o))
    fail(ErrorCode::bad_argument, "--enclose scene: a scene from a pipe cannot be read again; give it as a file");
  const bool by_error = !o.request.errors.empty() || !o.request.pixels.empty();
  if (o.loose && args.given("--enclose") && !by_error)
    fail(ErrorCode::bad_argument, "--enclose says what tightening keeps inside; --no-tighten leaves that out");
}

/// One level within the scene, of the voxels of its surface.
void set_occluder(BuildOptions& o) {
  if (!o.request.levels && asks_for_nothing(o.request)) o.request.levels = 1;
  if (level_count(o.request) != 1) fail(ErrorCode::bad_argument, "--profile occluder has one level");
  if (!o.request.shares.empty())
    fail(ErrorCode::bad_argument, "--faces {}%: an occluder takes a number of faces; some hundred are enough",
         o.request.shares.front());
  o.mode = MeshMode::inside;
  o.fill = FillMode::none;
  o.colors = false;
}

void check_options(BuildOptions& o) {
  if (o.profile == LodProfile::occluder) set_occluder(o);
  if (o.profile == LodProfile::collision && asks_for_nothing(o.request) && !o.request.levels) o.request.levels = 1;
  if (o.profile == LodProfile::tiles && !o.request.shares.empty())
    fail(
        ErrorCode::bad_argument,
        "--faces {}%: of a tileset --faces is the budget of each tile, whose triangles are not counted; give a number, "
        "or leave it out, and the scene decides",
        o.request.shares.front());
  if (o.profile == LodProfile::collision && level_count(o.request) != 1)
    fail(ErrorCode::bad_argument, "--profile collision has one level");
  if (o.profile == LodProfile::collision && o.mode != MeshMode::bounding)
    fail(ErrorCode::bad_argument, "--profile collision needs --mode bounding");
  if (o.profile == LodProfile::collision) o.colors = false;  // nobody sees them
  check(o.request);
  if (o.out.empty() && !o.tiles && (!o.explain || o.resume))
    fail(ErrorCode::bad_argument, "name the folder of the levels with -o");
  check_folder_name(o);
  if (o.voxel && o.resolution) fail(ErrorCode::bad_argument, "--voxel and --resolution exclude each other");
  if (o.voxel && (o.voxel->unit == Length::Unit::voxels || !(o.voxel->value > 0)))
    fail(ErrorCode::bad_argument, "--voxel {}: must be above 0, in scene units or percent", o.voxel->text());
  if (o.resolution && *o.resolution < 1) fail(ErrorCode::bad_argument, "--resolution 0: at least 1 voxel is needed");
  if (o.tile_vox < kBrickEdge || o.tile_vox % kBrickEdge != 0)
    fail(ErrorCode::bad_argument, "--tile {}: must be a multiple of 64", o.tile_vox);
  if (o.resume && !o.cache.empty())
    fail(ErrorCode::bad_argument, "--cache keeps what is done as well; leave --resume out");
  if (o.tiles && o.explain) fail(ErrorCode::bad_argument, "--explain numbers the jobs; leave --tiles out");
  if (o.explain && (o.resume || !o.cache.empty()) && std::count(o.scenes.begin(), o.scenes.end(), "-") > 0)
    fail(ErrorCode::bad_argument, "--explain reads the scene twice to find what is kept; give it as a file");
  if (o.tiles && o.cache.empty())
    fail(ErrorCode::bad_argument,
         "--tiles makes no tileset but results for a later run; name their folder with --cache");
  if (o.tiles && !o.out.empty())
    fail(ErrorCode::bad_argument, "--tiles writes no tileset; leave -o to the run that puts the tiles together");
  check_name(o);
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

const char* name_of(LodProfile profile) {
  constexpr const char* kNames[] = {"gltf", "3dtiles", "collision", "occluder"};
  return kNames[std::size_t(profile)];
}

BuildOptions parse_build_options(Args& args) {
  BuildOptions o;
  args.about("Makes levels of detail of scenes: coarser and coarser proxies that strictly enclose them.");
  args.positional("SCENE", o.scenes, "scenes, taken together; - is stdin and needs --format");
  args.option("-o,--output", "DIR", o.out, "folder of the levels; it is made if it is not there");
  args.option(
      "--profile",
      {{"gltf", LodProfile::gltf},
       {"3dtiles", LodProfile::tiles},
       {"collision", LodProfile::collision},
       {"occluder", LodProfile::occluder}},
      o.profile,
      "gltf: a GLB a level, and one with all (MSFT_lod); 3dtiles: a tileset of compressed GLB, coarse root, in "
      "the scene's coordinates (mind --up); collision: "
      "one level, named for Godot, Unreal and Unity; occluder: one level, strictly within what the scene hides");
  args.option("--mode", {{"bounding", MeshMode::bounding}, {"fit", MeshMode::fit}}, o.mode,
              "around the scene; or as near to it as can be, enclosing nothing");
  args.option("--name", "NAME", o.name, "first part of the names of files and nodes (default: the first scene's)");
  args.option("--levels", "N", o.request.levels,
              "number of levels (default: as many as are listed; else 4, or fewer where 12 faces are reached before)");
  args.option(
      "--faces", "N[,N...]|P%[,P%...]", [&o](const std::string& text) { set_faces(o.request, text); },
      "triangles of each level, finest first; or percentages of the scene's (not of tilesets); one number: each "
      "further one of --levels has a quarter (default: by the scene: 50%, 40000 at most; collision: 12.5%, 5000 at "
      "most)");
  args.option(
      "--error", "LENGTH[,...]", [&o](const std::string& text) { o.request.errors = parse_errors(text); },
      "largest distance between scene and level, finest first; one: each further level has twice that");
  args.option(
      "--screen", "PIXELS[,...]", [&o](const std::string& text) { o.request.pixels = parse_pixels(text); },
      "size on screen, of the scene's diagonal, up to which a level's error is a pixel; one: then half of that");
  args.option("--voxel", "LENGTH", o.voxel,
              "edge of a voxel of the finest level: scene units, or 0.5% of the diagonal");
  args.option("--resolution", "N", o.resolution,
              "voxels along the longest side (default: by --faces, 256 to 1024, of tilesets by the scene, 256 to 4096; "
              "or 8 voxels to the error)");
  args.option("--tile", "N", o.tile_vox,
              "3dtiles: voxels along the side of a tile; a level that is larger is cut into tiles of its own");
  args.option(
      "--hulls", "N", [&o](const std::string& text) { o.hulls = parse_count(text, 1, kMostHullsAsked); },
      "collision: convex hulls in Unreal's file, at most (default: 32, or one for each part where there are more)");
  args.option("--cache", "DIR", o.cache,
              "3dtiles: keep the results of all jobs in DIR, and take from there what has not changed");
  args.flag("--resume", o.resume, "3dtiles: keep what is done in OUTPUT/.partial, and go on from there after a kill");
  args.option(
      "--tiles", "A..B", [&o](const std::string& text) { o.tiles = parse_job_range(text); },
      "3dtiles: fill --cache with the tiles of these numbers, before B, and write no tileset");
  args.flag("--explain", o.explain, "print what would be made, and how, and what is kept of it; make nothing");
  args.option("-s,--scale", "LENGTH", o.request.scale,
              "closing radius of the finest level; it doubles from level to level (default: by the target)");
  args.option("--element", {{"cube", StructuringElement::cube}, {"ball", StructuringElement::ball}}, o.element,
              "of the dilation; cube: large flat areas survive; ball: slanted sides do, so it is a fit's default");
  args.option(
      "--enclose",
      {{"auto", std::nullopt}, {"scene", Enclose::scene}, {"input", Enclose::input}, {"closing", Enclose::closing}},
      o.enclose,
      "what stays inside while a level is tightened: the scene's triangles, its voxels, or their closing "
      "(default: auto, scene for levels in one mesh of a scene in files, of up to 1048576 triangles; else "
      "input)");
  args.option("--fill", {{"flood", FillMode::flood}, {"winding", FillMode::winding}, {"none", FillMode::none}}, o.fill,
              "inside: what the outside cannot reach; where the winding number is not 0 (keeps cavities); nothing");
  args.option("--colors", {{"auto", true}, {"off", false}}, o.colors,
              "auto: vertices get the colours of the scene's materials and vertices, if it has any; off: none");
  args.option("--up", "x|y|z|-x|-y|-z", o.up,
              "axis of the scene that points up (default: y, or what a proxy of ours tells)");
  args.option(
      "--origin", "auto|off|X,Y,Z", [&o](const std::string& text) { o.origin = parse_origin(text); },
      "subtract this point from all vertices, for programs of 32-bit floats; auto: a round point near a scene that "
      "lies far off; off: none, and no note (default: none; not of tilesets)");
  args.option("--format", "NAME", o.format,
              "format of stdin, or of files whose names do not tell: ply stl obj off glb ...");
  args.flag("--no-tighten", o.loose, "leave out the step that lowers the volume");
  o.common.add_to(args);
  args.example("bplod plant.glb --faces 20000,5000,1000 --profile 3dtiles -o plant-tiles");
  args.parse();
  check_scene_format(o.format, o.scenes);
  keep_inputs(o.scenes);
  check_meaning(args, o);
  // Beside slanted sides a cube's closing stands off about as far as a fit looks for the scene: thorns.
  if (o.mode == MeshMode::fit && !args.given("--element")) o.element = StructuringElement::ball;
  check_options(o);
  return o;
}

Json options_json(const BuildOptions& o) {
  Json errors = Json::array();
  for (const Length& error : o.request.errors) errors.push_back(error.text());
  return {{"profile", name_of(o.profile)},
          {"mode", name_of(o.mode)},
          {"name", o.name},
          {"levels", optional_json(o.request.levels)},
          {"faces", faces_json(o.request)},
          {"error", errors},
          {"screen", o.request.pixels},
          {"voxel", optional_json(o.voxel)},
          {"resolution", optional_json(o.resolution)},
          {"tile", o.tile_vox},
          {"hulls", o.hulls > 0 ? Json(o.hulls) : Json(nullptr)},
          {"cache", !o.cache.empty()},
          {"resume", o.resume},
          {"tiles", o.tiles ? Json{o.tiles->begin, o.tiles->end} : Json(nullptr)},
          {"explain", o.explain},
          {"scale", optional_json(o.request.scale)},
          {"element", name_of(o.element)},
          {"enclose", o.enclose ? name_of(*o.enclose) : "auto"},
          {"fill", name_of(o.fill)},
          {"colors", o.colors},
          {"up", o.up ? Json(name_of(*o.up)) : Json(nullptr)},
          {"tighten", !o.loose},
          {"origin", o.origin.text().empty() ? Json(nullptr) : Json(o.origin.text())},
          {"threads", o.common.threads},
          {"memory", o.common.memory_bytes}};
}

double area_of(const Bounds3d& b) {
  const double x = b.max[0] - b.min[0], y = b.max[1] - b.min[1], z = b.max[2] - b.min[2];
  return 2 * (x * y + y * z + z * x);
}

/// Of the cube of the same volume: a flat scene shows along its thickness, too, what is in it.
double area_of_cube_like(const Bounds3d& b) {
  constexpr double kFlattest = 1.0 / 64;
  double volume = 1;
  for (std::size_t i = 0; i < 3; ++i) volume *= std::max(b.max[i] - b.min[i], kFlattest * b.longest_side());
  const double edge = std::cbrt(volume);
  return 6 * edge * edge;
}

bool is_by_scene(const BuildOptions& o) {
  return o.profile == LodProfile::tiles && !o.voxel && !o.resolution && asks_for_nothing(o.request);
}

LodRequest request_for(const BuildOptions& o, std::uint64_t triangles) {
  constexpr double kPerCollisionFace = 8;
  if (o.profile == LodProfile::tiles) return o.request;
  LodDefaults defaults;
  if (o.profile == LodProfile::collision) defaults = {kPerCollisionFace, kMostCollisionFaces};
  defaults.by_voxels = o.voxel || o.resolution;
  return request_for(o.request, triangles, defaults);
}

double voxel_size(const BuildOptions& o, const SceneSize& scene, int halvings) {
  const Bounds3d& bounds = scene.bounds;
  if (o.voxel) return o.voxel->in_world(bounds.diagonal(), 0);
  const double error = finest_error(o.request, bounds.diagonal());
  if (error > 0 && !o.resolution) return error / kVoxelsPerError;
  if (o.profile == LodProfile::occluder) return voxel_size_of(bounds, o.resolution.value_or(kOccluderResolution));
  const double coarse = voxel_size_of(bounds, o.resolution.value_or(kDefaultResolution));
  const bool tileset = o.profile == LodProfile::tiles;
  const LodRequest request = request_for(o, scene.triangles);
  if (o.resolution || request.faces.empty() != tileset) return coarse;
  const std::uint64_t faces = tileset ? std::min(scene.triangles, kTilesetFaces) : request.faces.front();
  double dense_faces = double(tileset ? kDensePerFace : kDensePerFaceAsked) * double(faces);
  if (!tileset) dense_faces = std::max(dense_faces, kLeastDenseFaces);
  const double area = tileset ? area_of_cube_like(bounds) : area_of(bounds);
  const double fine = std::min(coarse, std::sqrt(2 * kSlantedSteps * area / dense_faces));
  const std::int64_t most = tileset ? kMostTilesetResolution : kMostResolution;
  return std::min(coarse, std::max(std::ldexp(fine, -halvings), voxel_size_of(bounds, most)));
}

bool can_read_again(const BuildOptions& o) {
  return std::all_of(o.scenes.begin(), o.scenes.end(), [](const std::string& scene) {
    std::error_code none;  // what is no file, a pipe say, can be read once
    return scene != "-" && std::filesystem::is_regular_file(scene, none);
  });
}

bool may_refine(const BuildOptions& o) {
  const bool by_faces = asks_for_faces(o.request) || asks_for_nothing(o.request);
  return !o.voxel && !o.resolution && by_faces && o.profile != LodProfile::tiles && can_read_again(o);
}

Enclose enclosed_by(const BuildOptions& o, std::uint64_t triangles) {
  if (o.enclose) return *o.enclose;
  const bool scene = may_enclose_scene(o) && can_read_again(o) && triangles <= kMostEnclosedTriangles;
  return scene ? Enclose::scene : Enclose::input;
}

std::string enclose_note(const BuildOptions& o, std::uint64_t triangles) {
  if (o.enclose || !may_enclose_scene(o) || enclosed_by(o, triangles) == Enclose::scene) return "";
  const bool file = can_read_again(o);
  return fmt::format("{}: levels enclose the scene's voxels, not its triangles, and are less tight; {}",
                     file ? fmt::format("the scene has {} triangles, more than {}", triangles, kMostEnclosedTriangles)
                          : "the scene comes from a pipe and cannot be read again",
                     file ? "--enclose scene takes them all the same" : "give it as a file");
}

OptionText option_text(const BuildOptions& o, Enclose enclosed, const LodTarget& target, std::size_t i,
                       double scale_world, const GridFrame& frame) {
  OptionText text;
  text.add("level", i).add("mode", name_of(o.mode));
  if (target.faces > 0) text.add("faces", target.faces);
  if (target.error_world > 0) text.add("error", target.error_world);
  text.add("scale", scale_world)
      .add("voxel", frame.voxel)
      .add("element", name_of(o.element))
      .add("enclose", name_of(enclosed))
      .add("fill", name_of(o.fill))
      .add("up", name_of(frame.up))
      .add("tighten", !o.loose);
  return text;
}

}  // namespace bp
