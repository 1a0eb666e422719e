#include "io/gltf/draco_codec.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>

namespace bp {

namespace {

draco::DecoderBuffer buffer_of(std::span<const std::byte> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return buffer;
}

constexpr std::size_t kMostComponents = 4;      // most components in glTF
constexpr std::uint64_t kBytesOfCorners = 100;  // for each triangle: its corners, and its neighbours

struct Head {
  std::uint32_t triangles = 0;
  bool sequential = false;
};

/// Reads the numbers of triangles and vertices. Draco allocates as many as the bytes claim, so they are checked first.
bool read_head(std::span<const std::byte> bytes, Head& head) {
  draco::DecoderBuffer buffer = buffer_of(bytes);
  draco::DracoHeader header{};
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return false;
  if (header.encoder_type != draco::TRIANGULAR_MESH) return false;
  buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
  if (header.version_major != 2 || header.version_minor < 2) return false;  // the extension requires 2.2
  draco::GeometryMetadata metadata;
  if ((header.flags & METADATA_FLAG_MASK) != 0 && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
    return false;
  head.sequential = header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING;
  std::uint8_t traversal = 0;
  std::uint32_t vertices = 0;
  if (!head.sequential && !(buffer.Decode(&traversal) && draco::DecodeVarint(&vertices, &buffer))) return false;
  return draco::DecodeVarint(&head.triangles, &buffer);
}

/// A decoder that checks the size of the attributes before their values are allocated, both as integers and as final
/// values.
template <class Decoder>
class Careful final : public Decoder {
 public:
  explicit Careful(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

 protected:
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    std::uint64_t of_vertex = 0;
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      const draco::PointAttribute& a = *cloud.attribute(i);
      if (a.num_components() > kMostComponents) return false;
      of_vertex += a.num_components() * (sizeof(std::int32_t) + std::uint64_t(draco::DataTypeLength(a.data_type())));
    }
    return of_vertex * cloud.num_points() <= most_bytes_ && Decoder::DecodeAllAttributes();
  }

 private:
  std::uint64_t most_bytes_;
};

template <class Decoder>
bool decode(std::span<const std::byte> bytes, std::uint64_t triangles, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer = buffer_of(bytes);
  Careful<Decoder> decoder(triangles * (kDracoBytesPerTriangle - kBytesOfCorners));
  return decoder.Decode(draco::DecoderOptions(), &buffer, &mesh).ok();
}

template <class Number>
bool values_of(const draco::PointAttribute& from, std::size_t vertices, std::size_t components,
               std::vector<std::byte>& values) {
  values.resize(vertices * components * sizeof(Number));
  std::vector<Number> value(components);
  for (std::size_t i = 0; i < vertices; ++i) {
    const draco::AttributeValueIndex index = from.mapped_index(draco::PointIndex(std::uint32_t(i)));
    if (index.value() >= from.size()) return false;
    if (!from.ConvertValue<Number>(index, std::int8_t(components), value.data())) return false;
    std::memcpy(values.data() + i * components * sizeof(Number), value.data(), components * sizeof(Number));
  }
  return true;
}

bool take_values(const draco::PointAttribute& from, std::size_t vertices, DracoAttribute& to) {
  switch (to.type) {
    case ComponentType::i8:
      return values_of<std::int8_t>(from, vertices, to.components, to.values);
    case ComponentType::u8:
      return values_of<std::uint8_t>(from, vertices, to.components, to.values);
    case ComponentType::i16:
      return values_of<std::int16_t>(from, vertices, to.components, to.values);
    case ComponentType::u16:
      return values_of<std::uint16_t>(from, vertices, to.components, to.values);
    case ComponentType::u32:
      return values_of<std::uint32_t>(from, vertices, to.components, to.values);
    case ComponentType::f32:
      return values_of<float>(from, vertices, to.components, to.values);
    case ComponentType::f64:
      return values_of<double>(from, vertices, to.components, to.values);
  }
  return false;
}

bool take_triangles(const draco::Mesh& from, DracoMesh& to) {
  to.vertices = from.num_points();
  to.indices.reserve(3 * std::size_t(from.num_faces()));
  for (std::uint32_t f = 0; f < from.num_faces(); ++f) {
    for (const draco::PointIndex& corner : from.face(draco::FaceIndex(f))) {
      if (corner.value() >= to.vertices) return false;
      to.indices.push_back(corner.value());
    }
  }
  return true;
}

}  // namespace

std::string decode_draco(std::span<const std::byte> bytes, std::uint64_t most_triangles, DracoMesh& mesh,
                         std::span<DracoAttribute> attributes) {
  const std::string damaged = "are damaged, of another version than 2.2, or more than glTF has of vertices";
  Head head;
  if (!read_head(bytes, head)) return damaged;
  if (head.triangles > most_triangles)
    return fmt::format("have {} triangles, and {} indices", head.triangles, 3 * most_triangles);
  draco::Mesh decoded;
  const bool fine = head.sequential ? decode<draco::MeshSequentialDecoder>(bytes, most_triangles, decoded)
                                    : decode<draco::MeshEdgebreakerDecoder>(bytes, most_triangles, decoded);
  if (!fine || !take_triangles(decoded, mesh)) return damaged;
  for (DracoAttribute& attribute : attributes) {
    const draco::PointAttribute* const from = decoded.GetAttributeByUniqueId(attribute.id);
    if (from == nullptr) return fmt::format("have no attribute {}", attribute.id);
    if (!take_values(*from, mesh.vertices, attribute)) return damaged;
  }
  return {};
}

}  // namespace bp
