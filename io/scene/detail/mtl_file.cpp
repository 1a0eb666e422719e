#include "io/scene/detail/mtl_file.h"

#include "io/scene/detail/text_scanner.h"
#include "lib/core/error.h"

namespace bp {

void MtlMaterials::load(const std::string& beside, const std::string& name) {
  if (beside.empty() || name.empty()) return;
  try {
    read(beside.substr(0, beside.rfind('/') + 1) + name);
  } catch (const Error&) {
    return;
  }
}

void MtlMaterials::read(const std::string& path) {
  TextScanner text(open_scene_file(path, ""));
  Material* current = nullptr;
  for (; !text.at_end(); text.next_line()) {
    if (!text.word_on_line()) continue;
    const std::string key(text.word());
    if (key == "newmtl") {
      const std::string name = text.rest_of_line();
      if (materials_.size() == kMost) return;
      current = &(materials_[name] = {});
    } else if (key == "Kd" && current != nullptr) {
      std::array<double, 3> rgb{};
      bool numbers = true;
      for (double& c : rgb) numbers = numbers && text.word_on_line() && text.real(c);
      if (numbers) current->color = color_from_srgb(rgb);
    } else if ((key == "d" || key == "Tr") && current != nullptr) {
      double x = 0;
      if (text.word_on_line() && text.real(x) && x < 1 && (key == "d" || x > 0)) current->see_through = true;
    } else if (key == "map_d" && current != nullptr) {
      current->see_through = true;
    }
  }
}

LinearColor MtlMaterials::color(const std::string& material) const {
  const auto found = materials_.find(material);
  return found == materials_.end() ? kWhite : found->second.color;
}

bool MtlMaterials::see_through(const std::string& material) const {
  const auto found = materials_.find(material);
  return found != materials_.end() && found->second.see_through;
}

}  // namespace bp
