#include "io/mesh/detail/glb_looks.h"

#include <algorithm>

#include "io/gltf/gltf_sampler.h"

namespace bp {

namespace {

using Json = GltfOutJson;

/// Returns the number of an element, which is added if it is new.
std::size_t number_of(Json& array, const Json& element) {
  const auto found = std::find(array.begin(), array.end(), element);
  const auto number = std::size_t(found - array.begin());
  if (found == array.end()) array.push_back(element);
  return number;
}

bool is_webp(const Json& image) {
  return image.value("mimeType", "") == "image/webp" || image.value("uri", "").ends_with(".webp");
}

}  // namespace

std::size_t GlbLooks::add_material(const Json& material) {
  return number_of(materials_, material);
}

std::size_t GlbLooks::add_texture(std::size_t image, const Wrap& wrap, const TextureFilters& filters) {
  Json texture{{"sampler", number_of(samplers_, gltf_sampler(wrap, filters))}};
  if (is_webp(images_[image])) {
    has_webp_ = true;
    texture["extensions"] = {{"EXT_texture_webp", {{"source", image}}}};
  } else {
    texture["source"] = image;
  }
  return number_of(textures_, texture);
}

std::size_t GlbLooks::add_image(const std::string& uri) {
  return number_of(images_, {{"uri", uri}});
}

std::size_t GlbLooks::add_image(const std::string& bytes, const std::string& type) {
  images_.push_back({{"bufferView", data_.add_image_bytes(bytes)}, {"mimeType", type}});
  return images_.size() - 1;
}

void GlbLooks::write() {
  Json& doc = data_.json();
  if (!images_.empty()) {
    doc["samplers"] = samplers_;
    doc["images"] = images_;
    doc["textures"] = textures_;
  }
  doc["materials"] = materials_;
  if (has_webp_) data_.use("EXT_texture_webp", true);
}

}  // namespace bp
