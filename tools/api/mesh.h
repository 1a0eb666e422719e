#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh_writer.h"
#include "tools/api/grid.h"

namespace bp::api {

/// One mesh of a handle.
struct Mesh {
  std::vector<double> vertices;
  std::vector<std::uint32_t> triangles, quads;
  std::optional<LatticeMesh> lattice;     ///< none of a mesh that was loaded
  std::vector<std::string> loaded_steps;  ///< of a mesh that was loaded: MeshExtras::provenance
  MeshWriteOptions write;
  bp_mesh_info info{};
  std::string stopped_by, enclosed;  ///< that `info` points to

  /// Returns the arrays of the mesh as a caller of the library would give them.
  [[nodiscard]] bp_arrays arrays() const;
  /// Returns the steps that made it, as MeshExtras::provenance has them.
  [[nodiscard]] std::vector<std::string> steps() const;
};
using Meshes = std::vector<Mesh>;

/// How bplod writes the meshes of a handle (levels.cpp).
struct LevelFiles;

/// Makes the arrays of a mesh.
[[nodiscard]] Mesh mesh_of(LatticeMesh lattice);

/// Meshes a grid. `cage`: into a cage of quads.
[[nodiscard]] Meshes mesh(const VoxelGrid& grid, const bp_mesh_options* options, Call& call, bool cage = false);

}  // namespace bp::api

struct bp_mesh {
  bp::api::Meshes meshes;
  std::shared_ptr<const bp::api::LevelFiles> files;  ///< null: they are not written as files that belong together
};

namespace bp::api {

/// Throws bad_argument if there is no such mesh.
[[nodiscard]] const Mesh& mesh_at(const bp_mesh* meshes, std::size_t index);

}  // namespace bp::api
