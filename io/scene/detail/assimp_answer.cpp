#include "io/scene/detail/assimp_answer.h"

#include <cstring>
#include <type_traits>

#include "lib/core/error.h"

namespace bp {

namespace {

/// The first record.
struct SummarySizes {
  std::uint64_t bytes = 0, bad_faces = 0, animations = 0;
  Unfollowed unfollowed;
  std::uint64_t meshes = 0, nodes = 0, parts = 0, textures = 0;  // numbers of records; parts, textures: bytes of names
};

template <class T>
void append(std::string& to, const T* from, std::size_t n) {
  static_assert(std::is_trivially_copyable_v<T>);
  to.append(reinterpret_cast<const char*>(from), n * sizeof(T));
}

}  // namespace

std::string packed(const Summary& s) {
  const SummarySizes sizes{s.bytes,         s.bad_faces,    s.animations,   s.unfollowed,
                           s.meshes.size(), s.nodes.size(), s.parts.size(), s.textures.size()};
  std::string bytes;
  append(bytes, &sizes, 1);
  append(bytes, s.meshes.data(), s.meshes.size());
  append(bytes, s.nodes.data(), s.nodes.size());
  return bytes + s.parts + s.textures;
}

Summary unpacked(const std::string& bytes, const std::string& name) {
  SummarySizes n;
  if (bytes.size() >= sizeof n) std::memcpy(&n, bytes.data(), sizeof n);
  if (bytes.size() != sizeof n + n.meshes * sizeof(MeshRecord) + n.nodes * sizeof(NodeRecord) + n.parts + n.textures)
    fail(ErrorCode::failed, "{}: the importer's process sent a garbled answer", name);
  Summary s{n.bytes,
            n.bad_faces,
            n.animations,
            n.unfollowed,
            std::vector<MeshRecord>(n.meshes),
            std::vector<NodeRecord>(n.nodes),
            bytes.substr(bytes.size() - n.parts - n.textures, n.parts),
            bytes.substr(bytes.size() - n.textures)};
  const char* const meshes = bytes.data() + sizeof n;
  if (!s.meshes.empty()) std::memcpy(s.meshes.data(), meshes, n.meshes * sizeof(MeshRecord));
  if (!s.nodes.empty())
    std::memcpy(static_cast<void*>(s.nodes.data()), meshes + n.meshes * sizeof(MeshRecord),
                n.nodes * sizeof(NodeRecord));
  return s;
}

}  // namespace bp
