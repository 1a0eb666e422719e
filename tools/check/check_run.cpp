#include "tools/check/check_run.h"

#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/core/length.h"
#include "tools/cli/length.h"
#include "tools/cli/options/voxel.h"
#include "tools/run/inputs.h"

namespace bp {

namespace {

TilePart parse_part(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) fail(ErrorCode::bad_argument, "{}: is not of the form K/N, as 1/3", text);
  const std::int64_t of = parse_integer(std::string_view(text).substr(slash + 1), 1, std::int64_t(kMostTileParts));
  return {std::uint64_t(parse_integer(std::string_view(text).substr(0, slash), 1, of)) - 1, std::uint64_t(of)};
}

/// Parses a margin; voxels are refused, since no file here tells their size.
Length parse_margin(const std::string& text) {
  constexpr const char* kWhat = "a length such as 0.5 or 2%; no voxels are known here";
  double value = 0;
  const std::string_view unit = take_number(text, value, kWhat);
  if (!unit.empty() && unit != "%") refuse_unit(text, unit, kWhat);
  if (value == 0) fail(ErrorCode::bad_argument, "'{}': every proxy that holds keeps some distance; leave it out", text);
  return parse_length(text);
}

void declare(Args& args, CheckRun& o) {
  args.about(
      "Proves that a proxy is closed, oriented, 2-manifold, free of self-intersections, and strictly encloses its "
      "scenes; or names the places where it does not. Exact for the coordinates as read. Exit status: 0 proven, 1 "
      "refuted, 5 not decided.");
  args.positional(
      "[SCENE...] PROXY", o.files,
      "scenes and their proxy, or a proxy alone; a proxy may be a tileset, by its tileset.json or its folder");
  args.group("Question");
  args.flag("--inside", o.inside, "prove that the proxy lies strictly inside the scenes, not around them");
  args.flag("--convex", o.convex,
            "prove that the parts of the proxy, which may overlap, are convex and enclose the scenes together");
  args.option(
      "--margin", "LENGTH", [&o](const std::string& text) { o.margin = parse_margin(text); },
      "prove also that the proxy keeps this distance from the scenes: scene units, or a percentage of the "
      "scenes' diagonal");
  args.flag("--claimed", o.claimed, "prove what the proxy's file claims of itself, and say what it does not claim");
  args.option(
      "--part", "K/N", [&o](const std::string& text) { o.part = parse_part(text); },
      "check part K of N parts of a tileset, for machines that share the work; if all N hold, the tileset holds");
  args.group("Files");
  add_scene_format(args, o.format);
  args.option(
      "--origin", "X,Y,Z", o.origin,
      "add this point to every vertex of the proxy, exactly (default: what its --origin subtracted, if the file "
      "tells)");
  args.group("Verdict");
  args.flag("--json", o.json, "print the verdict as JSON");
  o.common.add_to(args,
                  CommonOptions::all_parts & ~unsigned(CommonOptions::device_part | CommonOptions::overwrite_part));
  args.removed("--overwrite", "--report replaces an earlier report, and no other file");
  args.removed("--no-distances", "distances are always measured");
  args.removed("--samples", "distances are always measured, from 5000 triangles of each side");
  args.removed("--examples", "bpcheck names the first 5 places of each kind");
  for (const char* const name : {"--image", "--image-size", "--up", "--azimuth", "--elevation", "--zoom", "--look-at"})
    args.removed(name, "bpinfo SCENE PROXY --image FILE draws both");
  args.often({"--inside", "--convex", "--json", "--memory"});
}

}  // namespace

CheckRun parse_check_run(Args& args) {
  CheckRun o;
  declare(args, o);
  args.example("bpcheck scene.glb proxy.glb");
  args.parse();
  for (std::string& file : o.files) file = tileset_in(file);
  args.excludes("--convex", "--inside");
  args.excludes("--margin", "--inside");
  args.excludes("--margin", "--convex");
  for (const char* question : {"--inside", "--convex", "--margin", "--part"}) args.excludes("--claimed", question);
  if (args.given("--part") && !is_tileset(o.files.back()))
    fail(ErrorCode::bad_argument, "--part: is for tilesets; leave it out for a mesh");
  check_scene_format(o.format, o.files);
  check_stdin_once(o.files);
  keep_inputs(o.files);
  if (o.inside && o.files.size() < 2)
    fail(ErrorCode::bad_argument, "--inside asks for a scene around the proxy; name it before the proxy");
  if (o.margin.value > 0 && o.files.size() < 2)
    fail(ErrorCode::bad_argument, "--margin asks for a scene in the proxy; name it before the proxy");
  return o;
}

}  // namespace bp
