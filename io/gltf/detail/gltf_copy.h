#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "io/gltf/detail/gltf_vertices.h"
#include "io/gltf/glb_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_reader.h"
#include "lib/core/box.h"

namespace bp::detail {

/// Throws bad_input if a GLB does not consist of JSON and one binary chunk.
void check_container(const SceneFile& file);

/// The range of the JSON in a GLB or a glTF.
struct JsonPlace {
  std::uint64_t begin = 0, size = 0;
};
[[nodiscard]] JsonPlace json_place(const SceneFile& file);

/// A glTF document whose first buffer is changed in a scratch file.
class GltfCopy {
 public:
  // Memory for additions to the JSON, and for each byte of its text: parsed values, and the text that is written.
  static constexpr std::uint64_t kPerByte = 12, kMeshBytes = 500;
  static constexpr std::uint64_t kViewBytes = 900, kPositionBytes = 1900, kOtherBytes = 1000;  // each with an accessor
  static constexpr std::uint64_t kTargetViewBytes = 1200, kPositionTargetBytes = 2600, kNormalTargetBytes = 1300,
                                 kPrimitiveTargetBytes = 800;

  /// buffer: the first buffer, of `bytes` bytes. held: bytes of SceneOptions::document that are in use for other
  /// things.
  GltfCopy(SceneFilePtr file, const SceneFile& buffer, std::uint64_t bytes, std::uint64_t held,
           const SceneOptions& options);

  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const { data_->read_at(offset, bytes); }
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) { data_->write_at(offset, bytes); }
  /// Returns the bytes so far; a multiple of 4, as append() leaves it.
  [[nodiscard]] std::uint64_t size() const { return data_->size(); }
  void append(std::span<const std::byte> bytes) { data_->append(bytes); }
  /// Counts the JSON that the calls below will add; to be called before them. Throws NeedsMemory if the document takes
  /// more than SceneOptions::document has left.
  void plan_copies(const GltfPlan& plan);
  /// Returns the memory of the JSON, as it was planned.
  [[nodiscard]] std::uint64_t memory_bytes() const { return json_bytes_; }
  /// Adds an accessor for these bytes, otherwise equal to the accessor `like`; returns its number.
  [[nodiscard]] std::uint64_t add_accessor(std::uint64_t like, std::uint64_t offset, std::uint64_t bytes);
  /// Gives the node a copy of `mesh` of its own; returns the copy's number.
  [[nodiscard]] std::uint64_t mesh_of_its_own(std::uint64_t node, std::uint64_t mesh);
  /// numbers: the accessors of POSITION, NORMAL, TANGENT, plus 1; 0: none.
  void set_accessors(std::uint64_t mesh, std::uint64_t primitive, const std::array<std::uint64_t, 3>& numbers);
  /// Sets `min` and `max` of an accessor.
  void set_bounds(std::uint64_t accessor, const Bounds3d& bounds);
  /// Counts the memory of `targets` morph targets for the primitives of each of these vertices; to be called before
  /// add_target(). Throws NeedsMemory if the document would take more than SceneOptions::document has left.
  void plan_targets(const std::vector<GltfVertices>& parts, std::size_t targets);
  /// Begins a new view for the next targets.
  void begin_frame() { targets_view_.reset(); }
  /// Adds a morph target for the part of this number. Its bytes are those appended last: the changes of POSITION, each
  /// followed by that of NORMAL if there are normals.
  void add_target(std::size_t part, const Bounds3d& bounds);
  /// Adds an animation that shows one morph target after the other, `seconds` apart.
  void add_animation(std::size_t targets, double seconds);
  /// Writes a GLB as a GLB, a glTF as JSON with the buffer in it.
  void write(OutputFile& out);

 private:
  struct Part {
    std::uint64_t count = 0;
    bool has_normals = false;
    std::vector<GltfOutJson*> primitives;
    [[nodiscard]] std::uint64_t stride() const { return has_normals ? 24 : 12; }
  };
  void write_json(OutputFile& out);
  void add_memory(std::uint64_t bytes, const char* what);
  [[nodiscard]] std::uint64_t bytes_of_targets() const;
  /// Returns the view that ends with the last appended bytes; `bytes`: those of the part.
  std::size_t view_of_targets(std::uint64_t bytes, std::uint64_t stride);
  /// Adds an accessor; returns its number.
  std::size_t add_floats(std::size_t view, std::uint64_t offset, std::uint64_t count, const char* type);
  /// Adds an accessor in a new view that begins at `offset` and holds all bytes since; returns its number.
  std::size_t add_scalars(std::uint64_t offset);
  SceneFilePtr file_;
  GltfOutJson json_;
  std::unique_ptr<ScratchFile> data_;
  const SceneOptions& options_;
  const std::uint64_t held_;
  std::uint64_t json_bytes_ = 0;                       // planned memory of the JSON
  std::map<std::uint64_t, std::uint64_t> own_meshes_;  // by node
  std::vector<Part> parts_;
  std::optional<std::uint64_t> targets_view_;  // the stride of the last view, if it holds targets
};

}  // namespace bp::detail
