#pragma once
#include <optional>
#include <string>

#include "io/mesh/contract.h"
#include "lib/core/coords.h"

/// How a mesh is written.
namespace bp {

enum class MeshFormat { glb, gltf, ply, obj, stl };

struct MeshWriteOptions {
  Vec3d origin{};        ///< scene units, subtracted from each vertex; each difference must be an exact double
  bool normals = false;  ///< unit vertex normals, weighted by angle, are written; STL has none
  std::optional<Contract> contract{};  ///< the contract that the file claims; STL has no place for it
};
/// Returns the name of the contract; empty: none.
[[nodiscard]] inline std::string contract_name(const MeshWriteOptions& options) {
  return options.contract ? name_of(*options.contract) : "";
}

}  // namespace bp
