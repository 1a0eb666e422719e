#pragma once
#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "io/gltf/glb_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_reader.h"
#include "lib/core/box.h"

namespace bp::detail {

/// Throws bad_input if this is a GLB that is not JSON, one binary chunk, and nothing else.
void check_container(const SceneFile& file);

/// A glTF document whose first buffer is changed in a scratch file.
class GltfCopy {
 public:
  /// buffer: the first one, of so many bytes.
  GltfCopy(SceneFilePtr file, const SceneFile& buffer, std::uint64_t bytes, const SceneOptions& options);

  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const { data_->read_at(offset, bytes); }
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) { data_->write_at(offset, bytes); }
  /// Bytes so far; a multiple of 4, as append() leaves it.
  [[nodiscard]] std::uint64_t size() const { return data_->size(); }
  void append(std::span<const std::byte> bytes) { data_->append(bytes); }
  /// The number of a new accessor for these bytes, which is otherwise like another one.
  [[nodiscard]] std::uint64_t add_accessor(std::uint64_t like, std::uint64_t offset, std::uint64_t bytes);
  /// The number of the copy of `mesh` that this node has from now on.
  [[nodiscard]] std::uint64_t mesh_of_its_own(std::uint64_t node, std::uint64_t mesh);
  /// numbers: of POSITION, NORMAL, TANGENT, plus 1; 0: none.
  void set_accessors(std::uint64_t mesh, std::uint64_t primitive, const std::array<std::uint64_t, 3>& numbers);
  /// `min` and `max` of an accessor.
  void set_bounds(std::uint64_t accessor, const Bounds3d& bounds);
  /// A morph target for all primitives of these accessors (as for set_accessors()). From `offset` on there are `count`
  /// changes of POSITION, with those of NORMAL behind each if there are any.
  void add_target(const std::array<std::uint64_t, 3>& numbers, std::uint64_t offset, std::uint64_t count,
                  const Bounds3d& bounds);
  /// An animation that shows one morph target after the other, `seconds` apart.
  void add_animation(std::size_t targets, double seconds);
  /// A GLB as a GLB; else JSON with the buffer in it.
  void write(OutputFile& out);

 private:
  void write_json(OutputFile& out);
  /// The number of a new accessor.
  std::size_t add_floats(std::size_t view, std::uint64_t offset, std::uint64_t count, const char* type);
  std::size_t add_scalars(const std::vector<float>& values);
  SceneFilePtr file_;
  GltfOutJson json_;
  std::unique_ptr<ScratchFile> data_;
  std::map<std::uint64_t, std::uint64_t> own_meshes_;  // by node
};

}  // namespace bp::detail
