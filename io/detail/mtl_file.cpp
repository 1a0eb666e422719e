#include "io/detail/mtl_file.h"

#include "io/detail/text_scanner.h"
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
  LinearColor* current = nullptr;
  for (; !text.at_end(); text.next_line()) {
    if (!text.word_on_line()) continue;
    const std::string key(text.word());
    if (key == "newmtl") {
      const std::string name = text.rest_of_line();
      if (materials_.size() == kMost) return;
      current = &(materials_[name] = kWhite);
    } else if (key == "Kd" && current != nullptr) {
      std::array<double, 3> rgb{};
      bool numbers = true;
      for (double& c : rgb) numbers = numbers && text.word_on_line() && text.real(c);
      if (numbers) *current = color_from_srgb(rgb);
    }
  }
}

LinearColor MtlMaterials::color(const std::string& material) const {
  const auto found = materials_.find(material);
  return found == materials_.end() ? kWhite : found->second;
}

}  // namespace bp
