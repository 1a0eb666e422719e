#include "tools/check/hints.h"

#include <fmt/format.h>

#include "tools/common/mesh_extras.h"

namespace bp {

std::string enclosure_hint(const std::string& scene, const std::string& proxy, bool inside) {
  const MeshExtras extras = mesh_extras(proxy);
  const std::string maker = made_by(mesh_extras(scene));
  if (!maker.empty() && extras.provenance.empty())
    return fmt::format("{} was made by {}, and {} was not: if they are swapped, name the proxy last", scene, maker,
                       proxy);
  const std::string mode = mode_of(extras);
  if (mode == "fit")
    return fmt::format(
        "{} was made with --mode fit, which draws it close to the scene and need not enclose it: check "
        "it alone, or make it without",
        proxy);
  if (mode == "inside" && !inside)
    return fmt::format("{} was made with --mode inside, to lie within its scene: prove that with --inside", proxy);
  if (mode == "bounding" && inside)
    return fmt::format("{} was made with --mode bounding, to enclose its scene: prove that without --inside", proxy);
  return "";
}

}  // namespace bp
