#include <fmt/format.h>

#include <array>
#include <set>

#include "io/image/image_reader.h"
#include "io/image/texture_writer.h"
#include "io/mesh/obj_level.h"
#include "tools/lod/choices.h"
#include "tools/lod/lod_outputs.h"

namespace bp {

namespace {

constexpr std::array kImages = {"color", "alpha", "normal", "roughness", "metal", "emission"};

/// A level by itself has the name that was asked for.
std::string name_of_level(const BuildOptions& o, std::size_t level) {
  return level_count(request_of(o)) == 1 ? o.name : level_name(o.name, level);
}

/// Writes an image beside a level; returns its file's name, empty if there is none.
class ImageWriter {
 public:
  ImageWriter(std::string name, OutputFolder& out, std::set<std::string>& written)
      : name_(std::move(name)), out_(out), written_(written) {}

  std::string operator()(const char* kind, const ImageFile& image) const {
    if (!image.is_there()) return "";
    const std::string file = fmt::format("{}_{}.{}", name_, kind, image.type == "image/png" ? "png" : "jpg");
    out_.file(file).write(image.bytes);
    written_.insert(file);
    return file;
  }

 private:
  std::string name_;
  OutputFolder& out_;
  std::set<std::string>& written_;
};

/// A channel of an image as one of its own, in grey, as MTL has them; none if it is about 0 everywhere.
ImageFile channel_of(const ImageFile& image, std::size_t channel) {
  if (!image.is_there()) return {};
  TextureImage all = decode_image(std::as_bytes(std::span(image.bytes)), "the baked image", UINT64_MAX);
  int most = 0;
  for (TextureImage::Texel& t : all.texels) {
    const std::uint8_t value = t[channel];
    t = {value, value, value, 255};
    most = std::max(most, int(value));
  }
  if (most < 4) return {};
  EncodedImage grey = encode_texture(all);
  return {std::move(grey.bytes), std::move(grey.type)};
}

MtlImages write_images(const MeshTexture& texture, const ImageWriter& write) {
  const ImageFile color{texture.image, texture.type};
  return {write("color", color),
          texture.has_holes ? write("alpha", channel_of(color, 3)) : "",
          write("normal", texture.normal),
          write("roughness", channel_of(texture.roughness, 1)),
          write("metal", channel_of(texture.roughness, 2)),
          write("emission", texture.emission)};
}

}  // namespace

std::vector<std::string> obj_files(const BuildOptions& o, std::size_t levels) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < levels; ++i) {
    const std::string name = name_of_level(o, i);
    if (o.may_have_textures()) {
      const std::size_t kinds = o.full() ? kImages.size() : 2;
      for (std::size_t k = 0; k < kinds; ++k) {
        for (const char* const ending : {"jpg", "png"})
          files.push_back(fmt::format("{}_{}.{}", name, kImages[k], ending));
      }
      files.push_back(name + ".mtl");
    }
    files.push_back(name + ".obj");
  }
  return files;
}

std::vector<WrittenFile> write_obj_levels(const BuildOptions& o, const std::vector<LodLevel>& levels,
                                          const Vec3d& origin, OutputFolder& out) {
  std::vector<WrittenFile> files;
  std::set<std::string> written;
  for (const LodLevel& level : levels) {
    const std::string name = name_of_level(o, files.size());
    std::string materials;
    if (const auto& texture = level.mesh.texture) {
      const MtlImages images = write_images(*texture, ImageWriter(name, out, written));
      materials = name + ".mtl";
      out.file(materials).write(mtl_text(name, *texture, images));
      written.insert(materials);
    }
    write_obj_level(level.mesh, name, materials, out.file(name + ".obj"), origin);
    written.insert(name + ".obj");
    files.push_back({name + ".obj", files.size(), level.mesh.triangles.size()});
  }
  for (const std::string& file : obj_files(o, level_count(request_of(o)))) {
    if (!written.contains(file)) out.leave_out(file);
  }
  return files;
}

}  // namespace bp
