#pragma once
#include "io/scene/scene_reader.h"
#include "lib/core/error.h"

namespace bp {

/// How bpcheck shares out --memory. The proxy, and everything that is found out about it, lies in memory as a whole.
/// The scene passes by; its triangles are kept for distances as long as they fit.
class CheckBudget {
 public:
  CheckBudget(std::uint64_t memory, std::size_t scenes);

  /// Returns the options for the file that is read as a whole. The reader refuses it if it needs more than its share.
  [[nodiscard]] SceneOptions of_proxy() const;
  /// Called if the proxy does not fit. Throws `e` again, with a limit at which the scenes' descriptions fit, too. If a
  /// scene cannot be opened, or does not tell its needs, `e` is thrown as it is.
  [[noreturn]] void refuse_proxy(const NeedsMemory& e, const std::vector<std::string>& scenes,
                                 const SceneOptions& options) const;
  /// Subtracts the memory of the proxy from the scene's.
  void take(const std::vector<IndexedMesh>& proxy);
  /// Returns the memory for the descriptions of the scenes. They are opened one after the other, so the largest counts.
  /// A single scene is opened beside the proxy; of several, the next one is opened beside the triangles of those
  /// before, too.
  [[nodiscard]] MemoryShare of_scene_document() const;
  [[nodiscard]] std::uint64_t reader_bytes() const { return usable_ / 3; }
  [[nodiscard]] MemoryShare of_scene() const;  ///< for distances, and for the voxels that hide a proxy

 private:
  /// The memory that the proxy leaves is cut into so many parts; one is for a description.
  [[nodiscard]] std::uint64_t parts_of_document() const;

  std::uint64_t memory_, usable_;
  std::size_t scenes_;
  std::uint64_t share_;  ///< the share of the proxy, in quarters of the usable memory
};

}  // namespace bp
