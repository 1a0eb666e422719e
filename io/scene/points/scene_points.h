#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_reader.h"

/// Reads the vertices of a scene in the order of its file, and writes the scene with other positions. Everything else
/// in the file stays as it is: parts, materials, texture coordinates, colours, order.
namespace bp {

/// Vertices of a file, in scene units, in the order of the file. Vertices that no face uses are included.
struct PointBatch {
  std::vector<Vec3d> positions;
  std::vector<Vec3d> normals;   ///< as many, or none: unit vectors
  std::vector<Vec3d> tangents;  ///< as many, or none
};
/// Replaces positions, and normals and tangents if there are any; their lengths need not be 1 afterwards.
using MovePoints = std::function<void(PointBatch&)>;
using MoveFrame = std::function<void(std::size_t, PointBatch&)>;

class ScenePoints {
 public:
  static constexpr std::size_t kBatch = std::size_t(1) << 15;  ///< vertices of a batch, at most

  virtual ~ScenePoints() = default;
  /// Replaces `out` by the positions of the next vertices; returns false, and `out` empty, at the end.
  virtual bool read(std::vector<Vec3d>& out) = 0;
  /// Returns the number of vertices; for an OBJ an estimate from the part that read() has taken, 0 before that.
  [[nodiscard]] virtual std::uint64_t count() const = 0;
  /// Returns the memory of the scene's description, including its growth once write() or write_frames() calls `move`.
  [[nodiscard]] virtual std::uint64_t memory_bytes() const { return 0; }
  /// Writes the scene, from its beginning. `move` gets all vertices in the order of read(). A number whose value stays
  /// keeps its bytes.
  virtual void write(const MovePoints& move, OutputFile& out) = 0;
  /// Writes the scene, from its beginning, with `frames` morph targets, and an animation that shows one after the
  /// other, `seconds` apart. `move` gets a frame, then batches as in write(). Throws bad_input if the scene is no glTF.
  virtual void write_frames(std::size_t frames, double seconds, const MoveFrame& move, OutputFile& out);
  /// Returns a text on content that stays although it should follow; empty: none.
  [[nodiscard]] virtual std::string left_behind() const { return {}; }
};

/// Opens an OBJ, PLY, glTF or GLB file; the extension of its name decides. Takes memory for a batch and for glTF's
/// JSON. glTF's buffer lies in a scratch file in options.temp_dir. A .gltf is written with its buffer inside. Throws
/// bad_input if the file is of another format, broken, or has content that cannot be kept.
[[nodiscard]] std::unique_ptr<ScenePoints> open_points(const std::string& path, const SceneOptions& options);

/// The use of the vertices.
struct PointsUse {
  bool written = false;    ///< ScenePoints::write() or write_frames() is called; else they are only read
  std::size_t frames = 0;  ///< frames of write_frames()
};
/// Returns the most bytes of SceneOptions::document that all steps of this use take together. The file is counted, not
/// opened: it need not fit in memory.
[[nodiscard]] std::uint64_t bytes_of_points(const std::string& path, const SceneOptions& options, const PointsUse& use);

[[nodiscard]] std::unique_ptr<ScenePoints> obj_points(SceneFilePtr file);
[[nodiscard]] std::unique_ptr<ScenePoints> ply_points(SceneFilePtr file);
[[nodiscard]] std::unique_ptr<ScenePoints> gltf_points(SceneFilePtr file, const SceneOptions& options);
[[nodiscard]] std::uint64_t bytes_of_gltf_points(const SceneFilePtr& file, const SceneOptions& options,
                                                 const PointsUse& use);

}  // namespace bp
