#include "tools/cli/options/levels.h"

#include "lib/core/error.h"
#include "tools/cli/face_list.h"

namespace bp {

std::vector<Length> parse_error_list(const std::string& text) {
  std::vector<Length> all;
  for_each_item(text, [&](std::string_view item) {
    all.push_back(parse_error_length(item));
    const Length& last = all.back();
    if (last.unit == Length::Unit::voxels)
      fail(ErrorCode::bad_argument, "{}: the voxels follow from the errors; use scene units or percent", text);
    if (last.unit != all.front().unit) fail(ErrorCode::bad_argument, "{}: mixes units", text);
    if (all.size() == 1) return;
    const double before = all[all.size() - 2].value;
    const bool pixels = last.unit == Length::Unit::pixels;  // a larger error on screen is a coarser level
    if (pixels ? last.value >= before : last.value <= before)
      fail(ErrorCode::bad_argument, "{}: each level must have {} than the one before", text,
           pixels ? "fewer pixels" : "a larger one");
  });
  return all;
}

void LevelOptions::add_of_stream(Args& args) {
  args.group("Targets");
  const Args::Setter set_faces = [this](const std::string& text) {
    if (text.find('%') != std::string::npos)
      fail(ErrorCode::bad_argument,
           "{}: a stream does not tell how many triangles its scene has; give a number, or use bplod", text);
    faces = parse_face_list(text);
  };
  args.option("--faces", "N[,N...]", set_faces,
              "largest number of triangles, as 5000 or 5k; several falling numbers make as many levels, finest first, "
              "each of which encloses the one before");
  args.option(
      "--error", "LENGTH", [this](const std::string& text) { errors = {parse_error_length(text)}; },
      "largest distance from any point of the proxy to the closing, or to what --enclose names");
}

void LevelOptions::add_of_scene(Args& args, const std::string& levels_default, const std::string& faces_default) {
  args.group("Levels");
  const Args::Setter set_faces = [this](const std::string& text) {
    const bool percent = text.find('%') != std::string::npos;
    faces = percent ? std::vector<std::uint64_t>() : parse_face_list(text);
    shares = percent ? parse_face_shares(text) : std::vector<double>();
  };
  args.option("--levels", "N", levels, "number of levels (default: " + levels_default + ")");
  args.option(
      "--faces", "N[,N...]|P%[,P%...]", set_faces,
      "largest number of triangles of each level, as 5k, finest first, or a percentage of the scene's triangles; after "
      "a single number each further level has a quarter (default: " +
          faces_default + ")");
  args.option(
      "--error", "LENGTH[,...]", [this](const std::string& text) { errors = parse_error_list(text); },
      "largest distance from each level to what is visible of the scene, finest first; after a single length each "
      "further level has "
      "twice that; 800px is one pixel where the scene's diagonal is 800 pixels on screen");
}

}  // namespace bp
