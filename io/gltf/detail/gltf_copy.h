#pragma once
#include <memory>
#include <span>
#include <string>

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
  /// `min` and `max` of an accessor.
  void set_bounds(std::uint64_t accessor, const Bounds3d& bounds);
  /// A GLB as a GLB; else JSON with the buffer in it.
  void write(OutputFile& out);

 private:
  void write_json(OutputFile& out);
  SceneFilePtr file_;
  GltfOutJson json_;
  std::unique_ptr<ScratchFile> data_;
};

}  // namespace bp::detail
