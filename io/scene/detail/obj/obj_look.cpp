#include "io/scene/detail/obj/obj_look.h"

#include "io/scene/detail/obj/obj_vectors.h"

namespace bp {

ObjLook::ObjLook(const SceneFilePtr& file, const SceneOptions& options)
    : file_(file),
      colors_(options.colors),
      walls_only_(options.walls_only),
      surface_(options.textures && options.surface),
      details_(options.details),
      textures_(options.textures),
      materials_(options.document) {}

void ObjLook::use(const std::string& material) {
  if (!colors_ && !walls_only_) return;
  name_ = material;
  MtlMaterial* const found = materials_.find(material);
  const bool textured = textures_ && found != nullptr;
  texture_ = textured ? texture_of(*found, material, *textures_, surface_, details_) : TriangleTexture::kNoMaterial;
  has_textures_ = has_textures_ || (textured && found->has_image());
  passed_over_ = walls_only_ && found != nullptr && found->see_through;
  if (!colors_) return;
  color_ = found != nullptr ? found->color(surface_) : kWhite;
  has_colors_ = has_colors_ || color_ != kWhite;
}

void ObjLook::load(const std::string& name, const TextScanner& text) {
  if (!colors_ && !walls_only_) return;
  materials_.load(file_->path(), name);
  if (materials_.fit()) return;
  TextScanner ahead(file_, text.mark());
  for (ahead.next_line(); !ahead.at_end(); ahead.next_line()) {
    if (ahead.word_on_line() && obj_keyword(ahead) == 'm') materials_.load(file_->path(), ahead.rest_of_line());
  }
  materials_.refuse();
}

void ObjLook::rewind() {
  texture_ = TriangleTexture::kNoMaterial;
  materials_.clear();
  name_.clear();
  color_ = kWhite;
  passed_over_ = false;
}

std::array<float, 2> ObjLook::place(double u, double v) {
  const MtlMaterial* const found = materials_.find(name_);
  return found != nullptr ? found->place(u, v) : std::array<float, 2>{};
}

}  // namespace bp
