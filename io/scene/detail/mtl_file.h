#pragma once
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/detail/text/text_scanner.h"
#include "io/scene/texture_table.h"
#include "lib/core/color.h"
#include "lib/core/memory_share.h"

/// Reads Wavefront MTL. It reads from each material: the diffuse colour, Kd, taken as sRGB, as programs show it;
/// whether it is transparent: d below 1, Tr (which is 1 - d; some write 1 for opaque) between 0 and 1, or map_d; and
/// the image of map_Kd, which replaces Kd, as in most programs. If surfaces are asked for, also Pr, Pm, Ke, their
/// images, which replace them, and the normal map of norm, or else of map_Bump or bump, which is heights if it is grey.
/// Only the places of materials in their files stay in memory. A material is read when its name is asked for: large
/// libraries have far more materials than a scene uses.
namespace bp {

class MtlMaterials {
 public:
  /// `document`: as SceneOptions::document; 0 bytes: no limit. The places stay while triangles are read. So they take
  /// at most a quarter of what the program leaves, and that only if the document may take so much.
  explicit MtlMaterials(const MemoryShare& document);
  /// Adds the materials of a file in the folder of the file `beside` (find_beside(), io/files/beside.h). One of the
  /// same name is replaced. A file that is missing or cannot be understood adds none: a scene without colours is still
  /// a scene. An OBJ without a path has none. Once the places do not fit, those of further files are only counted.
  void load(const std::string& beside, const std::string& name);
  [[nodiscard]] bool fit() const { return !is_limited_ || bytes() <= memory_.bytes; }
  /// Throws out_of_resource, with the limit on memory at which the places of all materials counted so far fit.
  [[noreturn]] void refuse() const;
  /// Forgets all materials and files.
  void clear();
  /// Returns the colour of a material; white if there is none of this name. Unless surfaces are asked for, the light
  /// (Ke) of a material without images is added.
  [[nodiscard]] LinearColor color(const std::string& material, bool surface);
  /// Returns the place in the image for texture coordinates of a face (vt).
  [[nodiscard]] std::array<float, 2> place(const std::string& material, double u, double v);
  /// Adds the material's images to `textures`, and their faults; returns its number, TriangleTexture::kNoMaterial if it
  /// has no image and no `details` are asked for (SceneOptions).
  [[nodiscard]] std::uint32_t texture(const std::string& material, TextureTable& textures, bool surface, bool details);
  /// Returns whether the material has an image of colours or light (map_Kd, map_Ke).
  [[nodiscard]] bool has_image(const std::string& material);
  /// Returns whether the material is transparent; false if there is none of this name.
  [[nodiscard]] bool see_through(const std::string& material);

 private:
  static constexpr std::size_t kMost = std::size_t(1) << 20;
  static constexpr double kMostShare = 0.25;              // of the memory that the program leaves
  static constexpr std::uint64_t kMostKept = 4ULL << 20;  // bytes of materials that are kept: part of the program's own
  struct Map {
    std::string image;  // as the file names it; empty: none
    bool clamp = false;
    std::array<double, 4> uv{1, 0, 1, 0};  // factor and offset of u, of v
    double strength = 1;                   // -bm
    friend bool operator==(const Map&, const Map&) = default;
  };
  struct Maps {
    Map color, normal, bump, roughness, metal, emission;
    [[nodiscard]] std::array<const Map*, 6> all() const {
      return {&color, &normal, &bump, &roughness, &metal, &emission};
    }
  };
  struct Material {
    const std::string* file = nullptr;  // the file that has it, of files_; null: no file has it
    LinearColor color, emission{0, 0, 0};
    bool see_through = false;
    double alpha = 1, roughness = 1, metal = 0;
    std::unique_ptr<Maps> own_maps;       // null: it has none; most materials of a large file have none
    std::optional<std::uint32_t> number;  // in the table of textures
    [[nodiscard]] const Maps& maps() const;
    /// Returns the image whose coordinates count for all images of the material.
    [[nodiscard]] const Map& first_map() const;
    /// Returns the bytes outside of the object itself.
    [[nodiscard]] std::uint64_t heap_bytes() const;
    [[nodiscard]] bool has_image() const { return !maps().color.image.empty() || !maps().emission.image.empty(); }
  };
  struct File {
    const std::string* path;  // of file_numbers_
    std::uint64_t loaded;     // when it was loaded last; a material of a later file replaces one of the same name
  };
  /// Where a material stands: 16 bytes for each of a million.
  struct Place {
    static constexpr int kLengthBits = 24;
    std::uint32_t hash;       // of its name
    std::uint32_t file;       // of files_
    std::uint64_t at_length;  // offset of its first line, and number of bytes up to the next material
    [[nodiscard]] std::uint64_t at() const { return at_length >> kLengthBits; }
    [[nodiscard]] std::uint64_t length() const { return at_length & ((1ULL << kLengthBits) - 1); }
  };
  [[nodiscard]] std::uint64_t bytes() const { return count_ * sizeof(Place); }
  void list(const std::string& path, std::uint32_t file);
  void add(const std::string& name, std::uint32_t file, std::uint64_t begin, std::uint64_t end);
  [[nodiscard]] const Material* find(const std::string& name) { return find_to_change(name); }
  Material* find_to_change(const std::string& name);
  Material read(const std::string& name);
  bool read_at(const Place& place, const std::string& name, Material& material);
  static void read_line(TextScanner& text, const std::string& key, Material& material);
  static void read_map(TextScanner& text, Map& map);
  [[nodiscard]] static std::string path_of(const Map& map, const Material& material);
  [[nodiscard]] static TextureSurface surface_of(const Material& material, TextureTable& textures);
  static void add_light(const Material& material, TextureTable& textures, TextureSurface& s);
  [[nodiscard]] static TextureMap map_of(const Map& map, const Material& material, TextureTable& textures,
                                         const std::optional<Relief>& relief = {});
  const bool is_limited_;
  const MemoryShare memory_;
  std::map<std::string, std::uint32_t> file_numbers_;  // by path
  std::vector<File> files_;
  std::uint64_t loads_ = 0;
  std::deque<Place> places_;  // in the order of hashes if they are sorted_
  bool sorted_ = true;
  std::uint64_t count_ = 0;               // of materials, with those that are only counted
  std::string too_many_;                  // the file whose materials did not fit in addition to those before
  std::map<std::string, Material> kept_;  // names that were asked for, with those that no file has
  std::uint64_t kept_bytes_ = 0;
  SceneFilePtr open_;  // the file that was read last
  std::uint32_t open_number_ = 0;
};

}  // namespace bp
