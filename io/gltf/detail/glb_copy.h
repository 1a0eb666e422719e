#pragma once
#include <memory>
#include <span>
#include <string>

#include "io/files/file.h"
#include "io/gltf/glb_file.h"
#include "io/scene/scene_file.h"
#include "lib/core/box.h"

namespace bp::detail {

/// Throws bad_input if this is no GLB with JSON, one binary chunk, and nothing else.
void check_glb(const SceneFile& file);

/// A GLB whose binary chunk is changed in a scratch file.
class GlbCopy {
 public:
  GlbCopy(SceneFilePtr file, const std::string& temp_dir);

  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const { data_->read_at(offset, bytes); }
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) { data_->write_at(offset, bytes); }
  /// `min` and `max` of an accessor.
  void set_bounds(std::uint64_t accessor, const Bounds3d& bounds);
  void write(OutputFile& out) const;

 private:
  SceneFilePtr file_;
  GltfOutJson json_;
  std::unique_ptr<ScratchFile> data_;
};

}  // namespace bp::detail
