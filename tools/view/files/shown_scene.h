#pragma once
#include <mutex>
#include <string>

#include "io/scene/part_names.h"
#include "io/scene/scene_options.h"
#include "lib/grid/stream.h"
#include "tools/view/events.h"
#include "tools/view/view_options.h"

namespace bp {

/// The scene as a page sees it: its triangles where they are few, and the names of its parts. Thread-safe.
class ShownScene {
 public:
  /// Reads a scene of at most `most` triangles; others are not shown. `middle` is subtracted from positions that are
  /// sent. Keeps references to options, header and events. Throws as readers of scenes do.
  ShownScene(const ViewOptions& options, const StreamHeader& header, const Vec3d& middle, std::uint64_t most,
             const Events& events);

  /// As ShownMesh::bytes(); empty: the scene has too many triangles.
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

  /// Returns the names of parts as a JSON list, for rules by name: the first kMostNames. Reads a scene that is not
  /// shown.
  [[nodiscard]] std::string part_names();

  /// Returns the name of the part that is nearest to a point of the scene, as {"part": NAME}; it is empty if that part
  /// has no name. Reads the scene.
  [[nodiscard]] std::string part_at(const Vec3d& point) const;

  static constexpr std::size_t kMostNames = 1000;

 private:
  void read();
  [[nodiscard]] bool is_shown() const { return header_.scene.triangles <= most_; }

  const ViewOptions& options_;
  const StreamHeader& header_;
  const Vec3d middle_;
  const std::uint64_t most_;
  const Events& events_;  ///< tell when bpview ends
  std::string bytes_;
  PartNames parts_;
  std::once_flag read_;
};

/// How bpview reads the scene, within its share of --memory.
[[nodiscard]] SceneOptions scene_options(const ViewOptions& options);

}  // namespace bp
