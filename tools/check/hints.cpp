#include "tools/check/hints.h"

#include <fmt/format.h>

#include <filesystem>

#include "lib/core/error.h"

namespace bp {

MeshExtras extras_of(const std::string& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return {};
  try {
    return mesh_extras(path);
  } catch (const Error&) {
    return {};
  }
}

std::string enclosure_hint(const std::string& scene, const std::string& proxy, bool inside, bool moved) {
  const MeshExtras extras = extras_of(proxy);
  const std::string maker = made_by(extras_of(scene));
  if (!maker.empty() && extras.provenance.empty())
    return fmt::format("{} was made by {}, and {} was not: if they are swapped, name the proxy last", scene, maker,
                       proxy);
  if (extras.origin && !moved && made_by(extras) == "bpmesh")
    return fmt::format("{} was moved by bpmesh --origin: give bpcheck the same, --origin={},{},{}", proxy,
                       (*extras.origin)[0], (*extras.origin)[1], (*extras.origin)[2]);
  if (extras.origin && made_by(extras) == "bplod")
    return fmt::format("{} is the content of a tile, and lies elsewhere than its scene: check its tileset.json", proxy);
  const std::string mode = mode_of(extras);
  if (mode == "fit") return fit_hint(proxy);
  if (mode == "inside" && !inside)
    return fmt::format("{} was made with --mode inside, to lie within its scene: prove that with --inside", proxy);
  if (mode == "bounding" && inside)
    return fmt::format("{} was made with --mode bounding, to enclose its scene: prove that without --inside", proxy);
  return "";
}

std::string fit_hint(const std::string& content) {
  if (mode_of(extras_of(content)) != "fit") return "";
  return fmt::format(
      "{} was made with --mode fit, which draws it close to the scene and need not enclose it: check it alone, or make "
      "it without",
      content);
}

}  // namespace bp
