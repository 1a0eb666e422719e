#pragma once
#include <map>
#include <string>

#include "lib/core/color.h"

/// Wavefront MTL: of the materials the diffuse colour, Kd, taken as sRGB, as programs show it; and whether they can be
/// seen through: d below 1, Tr (which is 1 - d; some write 1 for opaque) between 0 and 1, or map_d.
namespace bp {

class MtlMaterials {
 public:
  /// Adds those of a file that lies beside the file `beside`; one of the same name replaces. A file that is not there
  /// or cannot be understood adds none: a scene without colours is still a scene. An OBJ without a path has none.
  void load(const std::string& beside, const std::string& name);
  /// White if there is no such material.
  [[nodiscard]] LinearColor color(const std::string& material) const;
  /// False if there is no such material.
  [[nodiscard]] bool see_through(const std::string& material) const;

 private:
  static constexpr std::size_t kMost = std::size_t(1) << 20;
  struct Material {
    LinearColor color;
    bool see_through = false;
  };
  void read(const std::string& path);
  std::map<std::string, Material> materials_;
};

}  // namespace bp
