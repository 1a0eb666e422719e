#include "io/mesh/detail/glb_data.h"

#include <algorithm>

namespace bp {

namespace {

using Json = GltfOutJson;

}  // namespace

void GlbData::use(const std::string& extension, bool required) {
  if (std::find(used_.begin(), used_.end(), extension) != used_.end()) return;  // another level has it
  used_.push_back(extension);
  if (required) required_.push_back(extension);
}

std::string GlbData::document(Json asset, const std::vector<std::size_t>& roots) {
  Json doc;
  doc["asset"] = std::move(asset);
  if (compressed_) use("EXT_meshopt_compression", true);
  if (quantized_) use("KHR_mesh_quantization", true);
  if (!required_.empty()) doc["extensionsRequired"] = required_;
  if (!used_.empty()) doc["extensionsUsed"] = used_;
  doc["scene"] = 0;
  doc["scenes"] = Json::array({{{"nodes", roots}}});
  doc.update(doc_);
  doc["buffers"] = Json::array({{{"byteLength", data_.size()}}});
  if (compressed_) {  // the size that the views would have uncompressed; nobody reads it
    doc["buffers"].push_back(
        {{"byteLength", fallback_}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  }
  return doc.dump();
}

std::size_t GlbData::add_attributes(const std::string& bytes, std::size_t stride, Json accessor, const char* filter) {
  Json view = add_view(bytes, stride, "ATTRIBUTES", compressed_ ? encode_attributes(bytes, stride) : bytes);
  if (compressed_) view["byteStride"] = stride;
  if (filter != nullptr) view["extensions"]["EXT_meshopt_compression"]["filter"] = filter;
  view["target"] = kGltfArrayBuffer;
  doc_["bufferViews"].push_back(view);
  Json placed{{"bufferView", doc_["bufferViews"].size() - 1}};
  placed.update(accessor);
  return add_accessor(std::move(placed));
}

std::size_t GlbData::add_floats(const std::string& bytes, std::size_t stride, Json accessor) {
  accessor["componentType"] = kGltfFloat;
  if (compressed_) {
    if (const std::string multiples = exponential(bytes); !multiples.empty())
      return add_attributes(multiples, stride, std::move(accessor), "EXPONENTIAL");
  }
  return add_attributes(bytes, stride, std::move(accessor));
}

std::size_t GlbData::add_normals(const std::vector<std::array<float, 3>>& normals) {
  return add_directions(normals, "VEC3");
}

std::size_t GlbData::add_tangents(const std::vector<std::array<float, 4>>& tangents) {
  return add_directions(tangents, "VEC4");
}

template <std::size_t N>
std::size_t GlbData::add_directions(const std::vector<std::array<float, N>>& all, const char* type) {
  if (!compressed_) {
    const auto* const bytes = reinterpret_cast<const char*>(all.data());
    return add_attributes(std::string(bytes, all.size() * sizeof all[0]), sizeof all[0],
                          {{"componentType", kGltfFloat}, {"count", all.size()}, {"type", type}});
  }
  quantize();
  return add_attributes(octahedral(all), 4,
                        {{"componentType", kGltfByte}, {"count", all.size()}, {"type", type}, {"normalized", true}},
                        "OCTAHEDRAL");
}

std::size_t GlbData::add_indices(const TriangleIndices& triangles, std::size_t vertices) {
  const bool narrow = vertices < 65535;  // 65535 means "restart"
  std::string bytes;
  for (const auto& t : triangles) {
    for (const std::uint32_t v : t) bytes.append(reinterpret_cast<const char*>(&v), narrow ? 2 : 4);
  }
  Json view = add_view(bytes, narrow ? 2 : 4, "TRIANGLES", compressed_ ? encode_triangles(triangles, vertices) : bytes);
  view["target"] = kGltfElementArrayBuffer;
  doc_["bufferViews"].push_back(view);
  return add_accessor({{"bufferView", doc_["bufferViews"].size() - 1},
                       {"componentType", narrow ? kGltfUint16 : kGltfUint32},
                       {"count", 3 * triangles.size()},
                       {"type", "SCALAR"}});
}

std::size_t GlbData::add_image_bytes(const std::string& bytes) {
  const std::size_t offset = append(bytes);
  doc_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
  return doc_["bufferViews"].size() - 1;
}

Json GlbData::add_view(const std::string& bytes, std::size_t stride, const char* mode, const std::string& stored) {
  const std::size_t offset = append(stored);
  if (!compressed_) return {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}};
  const Json packed{{"buffer", 0},          {"byteOffset", offset},           {"byteLength", stored.size()},
                    {"byteStride", stride}, {"count", bytes.size() / stride}, {"mode", mode}};
  const Json view{{"buffer", 1},
                  {"byteOffset", fallback_},
                  {"byteLength", bytes.size()},
                  {"extensions", {{"EXT_meshopt_compression", packed}}}};
  fallback_ += (bytes.size() + 3) / 4 * 4;
  return view;
}

std::size_t GlbData::append(const std::string& bytes) {
  const std::size_t offset = data_.size();
  data_ += bytes;
  data_.append((4 - data_.size() % 4) % 4, '\0');
  return offset;
}

std::size_t GlbData::add_accessor(Json accessor) {
  doc_["accessors"].push_back(std::move(accessor));
  return doc_["accessors"].size() - 1;
}

}  // namespace bp
