#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_reader.h"

/// The vertices of a scene in the order of its file, and the scene written again with other positions. Everything else
/// of the file stays as it is: parts, materials, places in images, colours, order.
namespace bp {

/// Vertices of a file, in scene units. Unlike triangles, they come as they stand: also those that no face names.
struct PointBatch {
  std::vector<Vec3d> positions;
  std::vector<Vec3d> normals;   ///< as many, or none: unit vectors
  std::vector<Vec3d> tangents;  ///< as many, or none
};
/// Replaces positions; and normals and tangents, if there are any, which need not have the length 1 then.
using MovePoints = std::function<void(PointBatch&)>;
using MoveFrame = std::function<void(std::size_t, PointBatch&)>;

class ScenePoints {
 public:
  static constexpr std::size_t kBatch = std::size_t(1) << 15;  ///< vertices of a batch, at most

  virtual ~ScenePoints() = default;
  /// Replaces `out` by the positions of the next vertices; false, and `out` empty, at the end.
  virtual bool read(std::vector<Vec3d>& out) = 0;
  /// Vertices in all; of an OBJ a guess from what read() took so far, 0 before that.
  [[nodiscard]] virtual std::uint64_t count() const = 0;
  /// Memory of what describes the scene: also of what it becomes, once write() or write_frames() calls `move`.
  [[nodiscard]] virtual std::uint64_t memory_bytes() const { return 0; }
  /// Writes the scene, from its beginning. `move` gets all vertices in the order of read(). A number whose value stays
  /// keeps its bytes.
  virtual void write(const MovePoints& move, OutputFile& out) = 0;
  /// Writes the scene, from its beginning, with a morph target for each of so many frames, and an animation that shows
  /// one after the other, `seconds` apart. `move` gets a frame, then as in write(). Throws bad_input if it is no glTF.
  virtual void write_frames(std::size_t frames, double seconds, const MoveFrame& move, OutputFile& out);
  /// What stays although it should follow; empty: nothing.
  [[nodiscard]] virtual std::string left_behind() const { return {}; }
};

/// Opens an OBJ, PLY, glTF or GLB, by the extension of its name. Memory: a batch, and the JSON of glTF. Scratch of
/// options.temp_dir: as much as the buffer of glTF has bytes. A .gltf is written with its buffer in it. Throws
/// bad_input if it is of another format, broken, or holds what cannot be kept.
[[nodiscard]] std::unique_ptr<ScenePoints> open_points(const std::string& path, const SceneOptions& options);

/// What becomes of the vertices.
struct PointsUse {
  bool written = false;    ///< by ScenePoints::write() or write_frames(); else they are read
  std::size_t frames = 0;  ///< of write_frames()
};
/// Bytes of SceneOptions::document that all steps of this use take together, at most. The file is counted, not opened:
/// it need not fit in memory.
[[nodiscard]] std::uint64_t bytes_of_points(const std::string& path, const SceneOptions& options, const PointsUse& use);

[[nodiscard]] std::unique_ptr<ScenePoints> obj_points(SceneFilePtr file);
[[nodiscard]] std::unique_ptr<ScenePoints> ply_points(SceneFilePtr file);
[[nodiscard]] std::unique_ptr<ScenePoints> gltf_points(SceneFilePtr file, const SceneOptions& options);
[[nodiscard]] std::uint64_t bytes_of_gltf_points(const SceneFilePtr& file, const SceneOptions& options,
                                                 const PointsUse& use);

}  // namespace bp
