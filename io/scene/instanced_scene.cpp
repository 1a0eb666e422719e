#include "io/scene/instanced_scene.h"

namespace bp {

std::size_t bytes_of(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
    case ComponentType::u8:
      return 1;
    case ComponentType::i16:
    case ComponentType::u16:
      return 2;
    case ComponentType::u32:
    case ComponentType::f32:
      return 4;
    case ComponentType::f64:
      return 8;
  }
  return 0;
}

std::uint64_t InstancedScene::memory_bytes() const {
  return primitives.size() * sizeof(Primitive) + arrays.size() * sizeof(InstanceArray) +
         nodes.size() * sizeof(MeshNode);
}

}  // namespace bp
