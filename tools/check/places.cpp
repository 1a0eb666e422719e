#include "tools/check/places.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/check/hints.h"
#include "tools/cli/names.h"
#include "tools/run/origin.h"

namespace bp {

namespace {

bool holds(const Bounds3d& outer, const Bounds3d& inner) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(outer.min[i] <= inner.min[i] && outer.max[i] >= inner.max[i])) return false;
  }
  return true;
}

Bounds3d bounds_of(const IndexedMesh& mesh) {
  Bounds3d bounds;
  for (const Vec3d& p : mesh.vertices) bounds.add(p);
  return bounds;
}

Bounds3d turned(const Bounds3d& bounds, const AxisTurn& turn) {
  Bounds3d out;
  out.add(turn(bounds.min));
  out.add(turn(bounds.max));
  return out;
}

std::string turn_note(const std::string& file, UpAxis up) {
  return fmt::format("{} says that it was turned from {} up to y up; the turn is undone", file_name(file), name_of(up));
}

}  // namespace

std::vector<std::string> place_notes(const std::vector<std::string>& files, std::optional<UpAxis> up) {
  std::vector<std::string> notes;
  for (const std::string& scene : std::vector<std::string>(files.begin(), files.end() - 1)) {
    const MeshExtras extras = extras_of(scene);
    const std::optional<UpAxis> axis = up_axis_named(extras.up.value_or("y"));
    if (extras.recorded && axis && *axis != UpAxis::y) notes.push_back(turn_note(scene, *axis));
  }
  const std::string& proxy = files.back();
  if (up && *up != UpAxis::y) notes.push_back(turn_note(proxy, *up));
  if (const double rounding = extras_of(proxy).rounding; rounding > 0) {
    notes.push_back(
        fmt::format("{}: its nodes move or scale it. The proof is for coordinates composed in double; programs that "
                    "compute in 32-bit floats may draw a vertex elsewhere, by up to {:.2g} along each axis",
                    file_name(proxy), rounding));
  }
  return notes;
}

std::string unknown_axes(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const MeshExtras extras = extras_of(file);
    if (!extras.up || *extras.up == name_of(UpAxis::y)) continue;
    const std::string says = fmt::format("{} says in asset.extras.up that '{}' was up", file_name(file), *extras.up);
    if (!up_axis_named(*extras.up)) return says + ", which is none of x, y, z, -x, -y and -z";
    if (!extras.recorded) return says + ", but not that a tool of this suite turned it (asset.extras.provenance)";
  }
  return "";
}

std::string missing_axes(const std::vector<std::string>& files, const IndexedMesh& proxy, const Bounds3d& scene,
                         std::optional<UpAxis> scene_up) {
  const bool scene_is_gltf = std::all_of(files.begin(), files.end() - 1, is_gltf);
  if (proxy.up || scene_up || scene.empty() || scene_is_gltf == is_gltf(files.back())) return "";
  const Bounds3d bounds = bounds_of(proxy);
  if (holds(bounds, scene)) return "";
  for (const char* const name : kUpNames) {
    if (!holds(turned(bounds, to_y_up(*up_axis_named(name)).inverse()), scene)) continue;
    const std::string& gltf = scene_is_gltf ? files.front() : files.back();
    return fmt::format(
        "{} does not tell whether it was turned to y up (asset.extras.up), and the bounds of the proxy hold those of "
        "the scene only if it was",
        file_name(gltf));
  }
  return "";
}

}  // namespace bp
