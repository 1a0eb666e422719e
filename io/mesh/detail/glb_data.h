#pragma once
#include <string>
#include <vector>

#include "io/gltf/glb_file.h"
#include "io/gltf/meshopt_codec.h"

/// Arrays of a GLB that is being written, plain or with EXT_meshopt_compression.
namespace bp {

constexpr int kGltfByte = 5120, kGltfUint8 = 5121, kGltfShort = 5122, kGltfUint16 = 5123, kGltfUint32 = 5125,
              kGltfFloat = 5126;
constexpr int kGltfArrayBuffer = 34962, kGltfElementArrayBuffer = 34963;

class GlbData {
 public:
  explicit GlbData(bool compressed) : compressed_(compressed) {}

  [[nodiscard]] bool is_compressed() const { return compressed_; }
  /// Notes that the file uses an extension; `required`: it cannot be shown without.
  void use(const std::string& extension, bool required);
  /// Notes that the file needs KHR_mesh_quantization.
  void quantize() { quantized_ = true; }

  /// Adds an accessor in a new view; `accessor` has all but the view. `filter`: of EXT_meshopt_compression.
  std::size_t add_attributes(const std::string& bytes, std::size_t stride, GltfOutJson accessor,
                             const char* filter = nullptr);
  /// Adds vectors of float32, without loss.
  std::size_t add_floats(const std::string& bytes, std::size_t stride, GltfOutJson accessor);
  std::size_t add_indices(const TriangleIndices& triangles, std::size_t vertices);
  /// Adds the bytes of an image; returns the number of their view.
  std::size_t add_image_bytes(const std::string& bytes);
  /// Adds tangents or normals, as octahedral bytes if the file is compressed.
  std::size_t add_tangents(const std::vector<std::array<float, 4>>& tangents);
  std::size_t add_normals(const std::vector<std::array<float, 3>>& normals);

  /// Returns the document without accessors and views, for nodes, meshes, materials ...
  [[nodiscard]] GltfOutJson& json() { return doc_; }
  /// Returns the whole document; the members of `json` come first.
  [[nodiscard]] std::string document(GltfOutJson asset, const std::vector<std::size_t>& roots);
  [[nodiscard]] const std::string& bytes() const { return data_; }

 private:
  template <std::size_t N>
  std::size_t add_directions(const std::vector<std::array<float, N>>& all, const char* type);
  [[nodiscard]] GltfOutJson add_view(const std::string& bytes, std::size_t stride, const char* mode,
                                     const std::string& stored);
  std::size_t append(const std::string& bytes);
  std::size_t add_accessor(GltfOutJson accessor);

  const bool compressed_;
  bool quantized_ = false;
  std::vector<std::string> used_, required_;
  GltfOutJson doc_{{"nodes", GltfOutJson::array()},
                   {"meshes", GltfOutJson::array()},
                   {"accessors", GltfOutJson::array()},
                   {"bufferViews", GltfOutJson::array()}};
  std::string data_;
  std::size_t fallback_ = 0;  // size of the views uncompressed
};

}  // namespace bp
