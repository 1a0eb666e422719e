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
      if (text.word_on_line() && text.real(x) && x < 1 && (key == "d" || x > 0)) {
        current->see_through = true;
        current->alpha = key == "d" ? x : 1 - x;
      }
    } else if (key == "map_Kd" && current != nullptr) {
      read_image(text, path.substr(0, path.rfind('/') + 1), *current);
    } else if (key == "map_d" && current != nullptr) {
      current->see_through = true;
    }
  }
}

// "map_Kd -s 2 2 1 -clamp on some name.png": options have words or numbers after them, and the name may have blanks.
void MtlMaterials::read_image(TextScanner& text, const std::string& folder, Material& material) {
  while (text.word_on_line() && text.peek() == '-') {
    const std::string option(text.word());
    if (option == "-s" || option == "-o" || option == "-t") {
      std::array<double, 3> numbers = option == "-s" ? std::array<double, 3>{1, 1, 1} : std::array<double, 3>{};
      for (double& x : numbers) {
        if (!text.word_on_line() || !text.real(x)) break;
      }
      if (option == "-t") continue;
      const std::size_t at = option == "-s" ? 0 : 1;
      material.uv[at] = numbers[0];
      material.uv[at + 2] = numbers[1];
    } else {
      const std::string value = text.word_on_line() ? std::string(text.word()) : "";
      if (option == "-clamp") material.clamp = value == "on";
      if (option == "-mm" && text.word_on_line()) (void)text.word();
    }
  }
  std::string name = text.word_on_line() ? text.rest_of_line() : "";
  for (char& c : name) c = c == '\\' ? '/' : c;
  if (!name.empty()) material.image = name[0] == '/' ? name : folder + name;
}

std::uint32_t MtlMaterials::texture(const std::string& material, TextureTable& textures) const {
  const auto found = materials_.find(material);
  if (found == materials_.end() || found->second.image.empty()) return TriangleTexture::kNoMaterial;
  const Material& m = found->second;
  TextureMaterial t;
  t.image = textures.add_image(m.image, {m.image, nullptr, m.image});
  t.replaces_color = true;
  t.alpha = float(m.alpha);
  t.alpha_mode = m.see_through ? AlphaMode::blend : AlphaMode::opaque;
  if (m.clamp) t.wrap = {TextureWrap::clamp, TextureWrap::clamp};
  return textures.add_material(fmt::format("{} {} {} {}", m.image, m.clamp, m.see_through, m.alpha), t);
}

std::array<float, 2> MtlMaterials::place(const std::string& material, double u, double v) const {
  const auto found = materials_.find(material);
  if (found == materials_.end()) return {};
  const std::array<double, 4>& by = found->second.uv;
  return {float(by[0] * u + by[1]), float(1 - (by[2] * v + by[3]))};
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
