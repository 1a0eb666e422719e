#pragma once
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "io/scene/detail/obj/mtl_material.h"
#include "io/scene/scene_file.h"
#include "lib/core/memory_share.h"

/// Reads Wavefront MTL. Only the places of materials in their files stay in memory. A material is read when its name is
/// asked for: large libraries have far more materials than a scene uses.
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
  /// Returns the material of this name; null if there is none. Valid until the next call of load() or find().
  [[nodiscard]] MtlMaterial* find(const std::string& name);

 private:
  static constexpr std::size_t kMost = std::size_t(1) << 20;
  static constexpr double kMostShare = 0.25;              // of the memory that the program leaves
  static constexpr std::uint64_t kMostKept = 4ULL << 20;  // bytes of materials that are kept: part of the program's own
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
  MtlMaterial read(const std::string& name);
  bool read_at(const Place& place, const std::string& name, MtlMaterial& material);

  const bool is_limited_;
  const MemoryShare memory_;
  std::map<std::string, std::uint32_t> file_numbers_;  // by path
  std::vector<File> files_;
  std::uint64_t loads_ = 0;
  std::deque<Place> places_;  // in the order of hashes if they are sorted_
  bool sorted_ = true;
  std::uint64_t count_ = 0;                  // of materials, with those that are only counted
  std::string too_many_;                     // the file whose materials did not fit in addition to those before
  std::map<std::string, MtlMaterial> kept_;  // names that were asked for, with those that no file has
  std::uint64_t kept_bytes_ = 0;
  SceneFilePtr open_;  // the file that was read last
  std::uint32_t open_number_ = 0;
};

}  // namespace bp
