#pragma once
#include <string>
#include <vector>

#include "io/scene/detail/assimp_textures.h"
#include "io/scene/instanced_scene.h"

/// The answer of the importer's process: plain records, counted.
namespace bp {

struct MeshRecord {
  std::uint64_t positions = 0, vertices = 0, indices = 0, triangles = 0;  // addresses in the scratch file, and counts
  std::uint64_t colors = Accessor::kZeros;                                // address; kZeros: the vertices have none
  std::array<double, 3> base_color{1, 1, 1};
  bool is_exact = false;  // positions are doubles; else float32
  double off = 0;         // bound on their error
  TextureRecord texture;
};
struct NodeRecord {
  using Numbers = std::array<std::array<double, 4>, 3>;
  Numbers m{}, off{};  // the transform, and bounds on its errors
  std::uint64_t mesh = 0;

  NodeRecord() = default;
  NodeRecord(const Affine& transform, std::uint64_t shown) : m(transform.m), mesh(shown) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) off[i][j] = transform.off(i, j);
    }
  }
  [[nodiscard]] Affine transform() const {
    Affine a;
    a.m = m;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) a.off.set(i, j, off[i][j]);
    }
    return a;
  }
};
struct Summary {
  std::uint64_t bytes = 0, bad_faces = 0;  // bytes of the scratch file; faces whose corners do not exist
  std::uint64_t animations = 0;
  Unfollowed unfollowed;
  std::vector<MeshRecord> meshes;
  std::vector<NodeRecord> nodes;
  std::string parts;     // names of the other files that were read, each with a zero after it
  std::string textures;  // names of images
};

[[nodiscard]] std::string packed(const Summary& summary);
/// Unpacks an answer. `name`: the scene's file, for the Error if the answer is garbled.
[[nodiscard]] Summary unpacked(const std::string& bytes, const std::string& name);

}  // namespace bp
