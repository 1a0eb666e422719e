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

/// An image on a mesh, as the importer's process sends it: a plain record. Addresses are in the scratch file.
struct TextureRecord {
  /// Texture coordinates of the vertices, three floats each; kZeros: no image.
  std::uint64_t places = Accessor::kZeros;
  std::uint64_t vertices = 0;                  ///< number of vertices
  std::uint64_t name_begin = 0, name_end = 0;  ///< range of the file's name in TextureUnloader::names()
  std::uint64_t data = 0, data_bytes = 0;      ///< an image within the scene; 0 bytes: it is a file
  std::array<double, 2> scale{1, 1}, offset{};
  std::array<TextureWrap, 2> wrap{};
  double opacity = 1;
};

/// Writes textures, in the importer's process.
class TextureUnloader {
 public:
  explicit TextureUnloader(ScratchFile& scratch) : scratch_(scratch) {}
  /// Returns the image of the diffuse colour.
  [[nodiscard]] TextureRecord unload(const aiMesh& mesh, const aiScene& scene);
  [[nodiscard]] const std::string& names() const { return names_; }

 private:
  void add_data(const aiTexture& texture, TextureRecord& record);
  ScratchFile& scratch_;
  std::string names_;
  std::map<const aiTexture*, std::uint64_t> added_;  // addresses
};

/// Adds an image to a primitive. `bytes`: the scratch file; `scene`: path of the file that was read, empty if it has
/// none. The image replaces the colour, as in most programs.
void lay_texture(const TextureRecord& record, const std::string& names, const SceneFilePtr& bytes,
                 const std::string& scene, TextureTable& textures, Primitive& primitive);

}  // namespace bp
