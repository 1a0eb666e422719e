#pragma once
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "io/files/uri.h"
#include "io/scene/instanced_scene.h"
#include "io/scene/texture_table.h"
#include "lib/core/error.h"

/// A glTF 2.0 document: its JSON, and its buffers. Everything that a file may get wrong is checked when it is read.
namespace bp {

using GltfJson = nlohmann::json;

/// A bad_input for a valid file that this command cannot use; other programs may.
class Unfit : public Error {
 public:
  explicit Unfit(const std::string& what) : Error(ErrorCode::bad_input, what) {}
};

/// An object of the document that knows its name for messages: "meshes[3].primitives[0]".
class GltfObject {
 public:
  GltfObject(const GltfJson& json, std::string file, std::string place)
      : json_(&json), file_(std::move(file)), place_(std::move(place)) {
    if (!json.is_object()) broken("is not an object");
  }
  [[nodiscard]] bool has(const char* key) const { return json_->contains(key); }
  /// Returns whether the object's "extensions" has this name.
  [[nodiscard]] bool has_extension(const char* name) const {
    return has("extensions") && object("extensions").has(name);
  }
  /// Returns true if `key` is an object that holds this text. Anything else there is ignored.
  [[nodiscard]] bool holds_text(const char* key, const char* inner_key, const char* value) const;
  /// Returns a whole number up to 2^53, or `otherwise` if it is missing.
  [[nodiscard]] std::uint64_t number(const char* key, std::uint64_t otherwise) const;
  [[nodiscard]] std::uint64_t number(const char* key) const;
  [[nodiscard]] double real(const char* key) const;
  [[nodiscard]] std::string text(const char* key) const;
  [[nodiscard]] bool flag(const char* key) const;  ///< false if it is missing
  [[nodiscard]] GltfObject object(const char* key) const;
  /// Returns an array; empty if it is missing.
  [[nodiscard]] const GltfJson& array(const char* key) const;
  [[nodiscard]] GltfObject item(const char* key, std::uint64_t i) const;      ///< object i of an array
  [[nodiscard]] std::uint64_t index(const char* key, std::uint64_t i) const;  ///< whole number i of an array
  /// Returns N numbers, or `otherwise` if they are missing.
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> numbers(const char* key, std::array<double, N> otherwise) const {
    if (!has(key)) return otherwise;
    const GltfJson& values = array(key);
    if (values.size() != N) broken(fmt::format("'{}' does not have {} numbers", key, N));
    for (std::size_t i = 0; i < N; ++i) {
      if (!values[i].is_number()) broken(fmt::format("'{}' holds something else than numbers", key));
      otherwise[i] = values[i].template get<double>();
    }
    return otherwise;
  }
  [[nodiscard]] const GltfJson& json() const { return *json_; }
  [[nodiscard]] const std::string& place() const { return place_; }  ///< empty: the document
  [[nodiscard]] std::string dump() const { return json_->dump(); }   ///< its JSON
  /// Throws bad_input "file: place what", with Remedy::repair_file.
  [[noreturn]] void broken(const std::string& what) const;
  /// Throws Unfit "file: place what"; `what` includes what to do.
  [[noreturn]] void unfit(const std::string& what) const;

 private:
  const GltfJson& at(const char* key) const;
  const GltfJson* json_;
  std::string file_, place_;
};

/// Throws bad_input, with the name, if a glTF or a tileset requires an unknown extension.
void check_required_extensions(const GltfObject& root);

/// Returns whether an extension is read, or does not change which triangles a viewer draws, and where.
[[nodiscard]] bool keeps_triangles(const std::string& extension);

/// Returns the componentType of an accessor. Throws unless glTF has it.
[[nodiscard]] ComponentType component_type(const GltfObject& accessor);

inline constexpr std::array kVectorTypes = {"SCALAR", "VEC2", "VEC3", "VEC4"};  ///< by number of components
inline constexpr std::size_t kMatrixNumbers = 16;                               ///< of MAT4, by columns
/// The extension of views, and its later name. The KHR version adds codecs, which are not read.
inline constexpr std::array kMeshoptNames = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

struct CountedJson {
  GltfJson json;
  std::uint64_t bytes = 0;  ///< memory that it takes
};
/// The memory of objects made from a JSON text: `bytes` for each occurrence of a word in it.
struct MadeOfJson {
  std::string_view word;
  std::uint64_t bytes = 0;
};
/// Reads the JSON of a file that is no glTF. `held`: bytes of SceneOptions::document that are taken already. `made` is
/// counted with the JSON before it is parsed; `later` only in the limit that a refusal names. Throws as GltfDocument.
[[nodiscard]] CountedJson read_json(const SceneFilePtr& file, const SceneOptions& options, std::uint64_t held = 0,
                                    const MadeOfJson& made = {}, const MadeOfJson& later = {});

class GltfDocument {
 public:
  GltfDocument(const SceneFilePtr& file, const SceneOptions& options);

  [[nodiscard]] GltfObject root() const { return GltfObject(json_, file_->name(), ""); }
  /// Returns the memory of the JSON.
  [[nodiscard]] std::uint64_t memory_bytes() const { return json_bytes_; }
  /// Returns the bytes of SceneOptions::document that parsing took.
  [[nodiscard]] std::uint64_t document_bytes() const { return document_bytes_; }
  /// Returns accessor i, checked against its views. `components`: the number that its type must have: 1 to 4, or
  /// kMatrixNumbers.
  Accessor accessor(std::uint64_t i, std::size_t components);
  /// Returns all numbers of accessor i. `what`: their name for the error if they take more than SceneOptions::document.
  std::vector<double> numbers(std::uint64_t i, std::size_t components, const char* what);
  [[nodiscard]] std::vector<double> numbers(const Accessor& accessor, const char* what) const;
  /// Throws out_of_resource if `what` takes more than SceneOptions::document.
  void check_memory(const char* what, std::uint64_t bytes) const;
  /// Unpacks the accessors of a primitive with KHR_draco_mesh_compression, which have data then. Returns false for
  /// other primitives.
  bool unpack(const GltfObject& primitive);
  /// Returns the positions or normals of a primitive after its morph targets, `name` in them, were applied with these
  /// weights.
  Accessor morphed(const GltfObject& primitive, const char* name, const Accessor& vectors,
                   const std::vector<double>& weights);
  /// Keeps computed vectors in scratch as an accessor. `off`: the most that rounding may have moved a number.
  Accessor keep_vectors(const std::vector<double>& numbers, double off);
  /// Returns the place of image i.
  ImagePlace image(std::uint64_t i);
  /// Returns all buffers that accessors have named so far, in one file.
  [[nodiscard]] SceneFilePtr bytes() const { return bytes_; }
  /// Returns how many views and primitives met so far may be read without an extension, and then have other content.
  /// Views with EXT_meshopt_compression are compared; primitives with KHR_draco_mesh_compression cannot be, and count.
  [[nodiscard]] std::uint64_t differing() const { return differing_; }

 private:
  struct Data {
    std::uint64_t address = 0, size = 0;
  };
  struct View {
    std::uint64_t address = 0, size = 0, stride = 0;
    std::uint64_t packed_stride = 0;  ///< bytes of an element that was compressed; 0: it was not
  };
  static constexpr std::uint64_t kNotPacked = ~std::uint64_t(0);
  /// Throws Unfit if a primitive before took the accessor's numbers from elsewhere: some programs then take the same.
  void note_use(const GltfObject& primitive, std::uint64_t accessor, std::uint64_t packed_in);
  void note_plain_use(const GltfObject& primitive);
  /// `size`: of an element; `packed`: its bytes where it was compressed, or 0.
  static void check_stride(const GltfObject& object, const Accessor& a, std::uint64_t size, std::uint64_t packed);
  void open_glb();
  void parse(std::uint64_t offset, std::uint64_t size);
  void check_root() const;
  const Data& buffer(std::uint64_t i);
  SceneFilePtr open_buffer(std::uint64_t i);
  [[nodiscard]] SceneFilePtr lifted(const std::string& uri) const;
  [[nodiscard]] UriFile file_beside(const std::string& uri) const;
  SceneFilePtr open_beside(const GltfObject& buffer, const std::string& uri) const;
  View view(std::uint64_t i);
  View part_of_buffer(const GltfObject& object);
  /// Unpacks a view with EXT_meshopt_compression or KHR_meshopt_compression.
  View unpacked(std::uint64_t i, const GltfObject& packed);
  [[nodiscard]] bool requires_one_of(std::span<const char* const> extensions) const;
  [[nodiscard]] std::optional<View> plain_view(std::uint64_t i);
  [[nodiscard]] std::vector<std::byte> packed_bytes(const View& view) const;
  /// Keeps bytes in scratch; returns their address.
  [[nodiscard]] std::uint64_t keep(std::span<const std::byte> plain);
  void read_sparse(const GltfObject& sparse, Accessor& a);
  void check_sparse_numbers(const GltfObject& numbers, const Accessor& a) const;

  SceneFilePtr file_;
  const SceneOptions& options_;
  std::string temp_dir_;
  GltfJson json_;
  std::uint64_t json_bytes_ = 0, document_bytes_ = 0, differing_ = 0;
  std::vector<SceneFilePtr> lifted_;  // decoded strings of the JSON
  SceneFilePtr glb_data_;             // the binary chunk
  std::shared_ptr<JoinedFile> bytes_ = std::make_shared<JoinedFile>();
  std::vector<std::optional<Data>> buffers_;
  struct Numbers {
    std::uint64_t address = 0, count = 0;
  };
  std::map<std::uint64_t, View> unpacked_;
  std::map<std::uint64_t, std::uint64_t> packed_in_;   // views of the compressed data of accessors, or kNotPacked
  std::map<std::uint64_t, Numbers> unpacked_numbers_;  // unpacked numbers of accessors, without gaps
  std::shared_ptr<ScratchFile> scratch_;               // unpacked bytes
};

}  // namespace bp
