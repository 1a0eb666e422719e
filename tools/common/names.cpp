#include "tools/common/names.h"

#include <cstddef>

namespace bp {

const char* name_of(FillMode fill) {
  constexpr const char* kNames[] = {"flood", "winding", "none", "inside"};
  return kNames[std::size_t(fill)];
}

const char* name_of(StructuringElement element) {
  return element == StructuringElement::cube ? "cube" : "ball";
}

const char* name_of(UpAxis up) {
  return up == UpAxis::y ? "y" : "z";
}

const char* name_of(MeshMode mode) {
  constexpr const char* kNames[] = {"bounding", "inside", "fit"};
  return kNames[std::size_t(mode)];
}

}  // namespace bp
