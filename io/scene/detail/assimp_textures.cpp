#include "io/scene/detail/assimp_textures.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <filesystem>
#include <span>

#include "io/files/beside.h"

namespace bp {

namespace {

TextureWrap wrap_of(aiTextureMapMode mode) {
  return mode == aiTextureMapMode_Wrap     ? TextureWrap::repeat
         : mode == aiTextureMapMode_Mirror ? TextureWrap::mirror
                                           : TextureWrap::clamp;
}

/// Returns the path of an image. Paths are often those of another machine: then the file can only be in the scene's
/// folder.
std::string path_of(std::string name, const std::string& scene) {
  if (name.starts_with("file://")) name = name.substr(7);
  return find_beside(std::filesystem::path(scene).parent_path().string(), name);
}

}  // namespace

TextureRecord TextureUnloader::unload(const aiMesh& mesh, const aiScene& scene) {
  static_assert(sizeof(aiVector3D) == 3 * sizeof(float), "places are written as they lie");
  TextureRecord record;
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return record;
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  const aiTextureType type =
      material.GetTextureCount(aiTextureType_BASE_COLOR) > 0 ? aiTextureType_BASE_COLOR : aiTextureType_DIFFUSE;
  aiString name;
  unsigned channel = 0;
  aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
  if (material.GetTexture(type, 0, &name, nullptr, &channel, nullptr, nullptr, modes) != aiReturn_SUCCESS)
    return record;
  if (name.length == 0 || channel >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !mesh.HasTextureCoords(channel)) return record;
  record.places = scratch_.append(std::as_bytes(std::span(mesh.mTextureCoords[channel], mesh.mNumVertices)));
  record.vertices = mesh.mNumVertices;
  record.wrap = {wrap_of(modes[0]), wrap_of(modes[1])};
  aiUVTransform moved;
  if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), moved) == aiReturn_SUCCESS) {
    record.scale = {moved.mScaling.x, moved.mScaling.y};
    record.offset = {moved.mTranslation.x, moved.mTranslation.y};
  }
  float opacity = 1;
  if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) record.opacity = opacity;
  record.name_begin = names_.size();
  names_ += name.C_Str();
  record.name_end = names_.size();
  if (const aiTexture* const held = scene.GetEmbeddedTexture(name.C_Str())) add_data(*held, record);
  return record;
}

/// Writes the bytes of an image within the file, if they are a compressed file: a height of 0 says so.
void TextureUnloader::add_data(const aiTexture& texture, TextureRecord& record) {
  if (texture.mHeight != 0 || texture.mWidth == 0) return;
  record.data_bytes = texture.mWidth;
  const auto [found, is_new] = added_.try_emplace(&texture, 0);
  if (is_new)
    found->second = scratch_.append(
        std::as_bytes(std::span(reinterpret_cast<const char*>(texture.pcData), std::size_t(texture.mWidth))));
  record.data = found->second;
}

void lay_texture(const TextureRecord& record, const std::string& names, const SceneFilePtr& bytes,
                 const std::string& scene, TextureTable& textures, Primitive& primitive) {
  if (record.places == Accessor::kZeros || record.name_end > names.size() || record.name_begin > record.name_end)
    return;
  const std::string name = names.substr(record.name_begin, record.name_end - record.name_begin);
  ImagePlace place{fmt::format("{}: {}", scene, name), nullptr, ""};
  if (record.data_bytes > 0) {
    place.bytes = part_of(bytes, record.data, record.data_bytes);
  } else if (!scene.empty()) {
    place.name = place.path = path_of(name, scene);
  }
  TextureMaterial material;
  const std::string key = fmt::format("{} {}", place.name, record.data);
  material.image = textures.add_image(key, place);
  material.wrap = record.wrap;
  material.replaces_color = true;
  material.alpha = float(record.opacity);
  material.alpha_mode = record.opacity < 1 ? AlphaMode::blend : AlphaMode::opaque;
  primitive.material = textures.add_material(
      fmt::format("{} {} {} {}", key, int(record.wrap[0]), int(record.wrap[1]), record.opacity), material);
  primitive.has_image = true;
  primitive.uv = Accessor();
  primitive.uv->components = 2;
  primitive.uv->count = record.vertices;
  primitive.uv->address = record.places;
  primitive.uv->stride = 3 * sizeof(float);
  // v goes upwards in Assimp.
  primitive.uv_transform = {record.scale[0], 0, record.offset[0], 0, -record.scale[1], 1 - record.offset[1]};
}

}  // namespace bp
