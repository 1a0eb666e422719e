#pragma once
#include <map>
#include <string>

#include "io/files/file.h"
#include "io/scene/instanced_scene.h"
#include "io/scene/texture_table.h"

struct aiMesh;
struct aiScene;
struct aiTexture;

namespace bp {

/// An image on a mesh, as the importer's process sends it: plain. Addresses are those of the scratch file.
struct TextureRecord {
  std::uint64_t places = Accessor::kZeros;     ///< of the vertices, three floats each; kZeros: no image
  std::uint64_t vertices = 0;                  ///< how many
  std::uint64_t name_begin = 0, name_end = 0;  ///< of its file, in TextureUnloader::names()
  std::uint64_t data = 0, data_bytes = 0;      ///< of an image that the scene holds; 0 bytes: it is a file
  std::array<double, 2> scale{1, 1}, offset{};
  std::array<TextureWrap, 2> wrap{};
  double opacity = 1;
};

/// In the importer's process.
class TextureUnloader {
 public:
  explicit TextureUnloader(ScratchFile& scratch) : scratch_(scratch) {}
  /// Of the diffuse colour.
  [[nodiscard]] TextureRecord unload(const aiMesh& mesh, const aiScene& scene);
  [[nodiscard]] const std::string& names() const { return names_; }

 private:
  void add_data(const aiTexture& texture, TextureRecord& record);
  ScratchFile& scratch_;
  std::string names_;
  std::map<const aiTexture*, std::uint64_t> added_;  // addresses
};

/// `bytes`: the scratch file; `scene`: path of the file that was read, empty if it has none. As most programs have it,
/// the image replaces the colour.
void lay_texture(const TextureRecord& record, const std::string& names, const SceneFilePtr& bytes,
                 const std::string& scene, TextureTable& textures, Primitive& primitive);

}  // namespace bp
