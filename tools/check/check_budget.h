#pragma once
#include "io/scene/scene_reader.h"
#include "lib/core/error.h"

namespace bp {

/// How bpcheck shares out --memory: the proxy, with all that is found out about it, lies in memory as a whole; the
/// scene passes by, and its triangles are kept for distances as long as they fit.
class CheckBudget {
 public:
  CheckBudget(std::uint64_t memory, std::size_t scenes);

  /// Of the file that is read as a whole; refused if it needs more than its share.
  [[nodiscard]] SceneOptions of_proxy() const;
  /// The proxy does not fit. Throws `e` again, with a limit at which the scenes' descriptions fit beside it, too. A
  /// scene that cannot be opened, or that tells nothing of what it takes, leaves it as it is.
  [[noreturn]] void refuse_proxy(const NeedsMemory& e, const std::vector<std::string>& scenes,
                                 const SceneOptions& options) const;
  /// What the proxy takes is no longer there for the scene.
  void take(const std::vector<IndexedMesh>& proxy);
  /// Of the scenes, which are opened one after the other: the largest document counts. One alone is opened beside the
  /// proxy; of several, the next one beside the triangles of those before, too.
  [[nodiscard]] MemoryShare of_scene_document() const;
  [[nodiscard]] std::uint64_t reader_bytes() const { return usable_ / 3; }
  [[nodiscard]] MemoryShare of_scene() const;  ///< for distances, and for the voxels that hide a proxy

 private:
  [[nodiscard]] std::uint64_t parts_of_document() const;  ///< in which what the proxy leaves is cut

  std::uint64_t memory_, usable_;
  std::size_t scenes_;
  std::uint64_t share_;  ///< of the proxy: so many quarters of what is usable
};

}  // namespace bp
