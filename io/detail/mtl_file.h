#pragma once
#include <map>
#include <string>

#include "lib/core/color.h"

/// Wavefront MTL: of the materials only the diffuse colour, Kd, taken as sRGB, as programs show it.
namespace bp {

class MtlMaterials {
 public:
  /// Adds those of a file that lies beside the file `beside`; one of the same name replaces. A file that is not there
  /// or cannot be understood adds none: a scene without colours is still a scene. An OBJ without a path has none.
  void load(const std::string& beside, const std::string& name);
  /// White if there is no such material.
  [[nodiscard]] LinearColor color(const std::string& material) const;

 private:
  static constexpr std::size_t kMost = std::size_t(1) << 20;
  void read(const std::string& path);
  std::map<std::string, LinearColor> materials_;
};

}  // namespace bp
