#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "io/files/paths.h"
#include "io/image/image_reader.h"
#include "io/image/texture_writer.h"
#include "io/mesh/obj_level.h"
#include "tools/lod/choices.h"
#include "tools/lod/lod_outputs.h"

namespace bp {

namespace {

constexpr std::array kImages = {"color", "alpha", "normal", "roughness", "metal", "emission"};

/// Returns the name of a level's files; a single level has the name that was asked for.
std::string name_of_level(const BuildOptions& o, std::size_t level) {
  return level_count(request_of(o)) == 1 ? o.name : level_name(o.name, level);
}

/// Returns the name of a level's material and of the files of its material. Blanks are replaced, since readers of OBJ
/// end names at blanks. Different levels get different names.
std::string material_name(const std::string& name) {
  std::string out;
  for (const char c : name) out += c == ' ' ? "~_" : c == '\t' ? "~t" : c == '~' ? "~~" : std::string(1, c);
  return out;
}

/// Returns the names of all files that a level's material may have, with `kinds` kinds of images.
std::vector<std::string> files_beside(const std::string& material, std::size_t kinds) {
  std::vector<std::string> files;
  for (std::size_t k = 0; k < kinds; ++k) {
    for (const char* const ending : {"jpg", "png"})
      files.push_back(fmt::format("{}_{}.{}", material, kImages[k], ending));
  }
  files.push_back(material + ".mtl");
  return files;
}

constexpr const char* kOwnHead = "# made by bplod ";

/// Returns the MTL that an existing level of bplod names, after the line that names it; empty if there is none.
std::string material_before(const std::string& obj, const std::string& folder, const std::string& mtl) {
  const std::string head = head_of(obj), line = "mtllib " + mtl + "\n";
  const bool ours = head.starts_with(kOwnHead) && head.find("\n" + line) != std::string::npos;
  return ours ? line + head_of(folder + "/" + mtl) : "";
}

/// Makes --overwrite remove files that an earlier level named and that this run does not write.
void leave_out_earlier(const BuildOptions& o, const std::string& name, const std::set<std::string>& written,
                       OutputFolder& out) {
  const std::string material = material_name(name);
  const std::string before = material_before(o.out + "/" + name + ".obj", o.out, material + ".mtl");
  for (const std::string& file : files_beside(material, kImages.size())) {
    if (!written.contains(file) && before.find(" " + file + "\n") != std::string::npos) out.take_away(file);
  }
}

/// Makes --overwrite remove them for all levels, and the levels of an earlier, longer list.
void leave_out_earlier(const BuildOptions& o, const std::set<std::string>& written, OutputFolder& out) {
  const std::size_t count = level_count(request_of(o));
  for (std::size_t i = 0; i < count; ++i) leave_out_earlier(o, name_of_level(o, i), written, out);
  for (std::size_t i = count == 1 ? 0 : count;; ++i) {
    const std::string name = level_name(o.name, i);
    if (!head_of(o.out + "/" + name + ".obj").starts_with(kOwnHead)) return;
    leave_out_earlier(o, name, written, out);
    out.take_away(name + ".obj");
  }
}

/// Writes an image of a level. Returns the name of its file; empty if there is no image.
class ImageWriter {
 public:
  ImageWriter(std::string name, OutputFolder& out, std::vector<std::string>& written)
      : name_(std::move(name)), out_(out), written_(written) {}

  std::string operator()(const char* kind, const ImageFile& image) const {
    if (!image.is_there()) return "";
    const std::string file = fmt::format("{}_{}.{}", name_, kind, image.type == "image/png" ? "png" : "jpg");
    out_.file(file).write(image.bytes);
    written_.push_back(file);
    return file;
  }

 private:
  std::string name_;
  OutputFolder& out_;
  std::vector<std::string>& written_;
};

/// Returns a channel of an image as a grey image, as MTL needs it; none if it is nearly 0 everywhere.
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
      for (std::string& file : files_beside(material_name(name), o.full() ? kImages.size() : 2))
        files.push_back(std::move(file));
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
    const std::string name = name_of_level(o, files.size()), material = material_name(name);
    std::string materials;
    std::vector<std::string> beside;
    if (const auto& texture = level.mesh.texture) {
      const MtlImages images = write_images(*texture, ImageWriter(material, out, beside));
      materials = material + ".mtl";
      out.file(materials).write(mtl_text(material, *texture, images));
      beside.push_back(materials);
    }
    write_obj_level(level.mesh, material, materials, out.file(name + ".obj"), {origin, false, contract_of_levels(o)});
    written.insert(name + ".obj");
    written.insert(beside.begin(), beside.end());
    files.push_back({name + ".obj", files.size(), level.mesh.triangles.size()});
    files.back().beside = std::move(beside);
  }
  for (const std::string& file : obj_files(o, level_count(request_of(o)))) {
    if (!written.contains(file)) out.leave_out(file);
  }
  leave_out_earlier(o, written, out);
  return files;
}

}  // namespace bp
