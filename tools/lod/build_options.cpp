#include "tools/lod/build_options.h"

#include "tools/cli/names.h"

namespace bp {

const char* name_of(Appearance appearance) {
  constexpr const char* kNames[] = {"off", "color", "texture", "full", "auto"};
  return kNames[std::size_t(appearance)];
}

const char* name_of(HullFiles files) {
  constexpr const char* kNames[] = {"none", "obj", "stl"};
  return kNames[std::size_t(files)];
}

const char* name_of(Symmetry symmetry) {
  constexpr const char* kNames[] = {"x", "y", "z", "off", "auto"};
  return kNames[std::size_t(symmetry)];
}

const char* name_of(LodProfile profile) {
  constexpr const char* kNames[] = {"gltf", "3dtiles", "collision", "occluder", "cage"};
  return kNames[std::size_t(profile)];
}

const char* BuildOptions::mode_name() const {
  return proxy.visual ? "visual" : name_of(proxy.mode);
}

}  // namespace bp
