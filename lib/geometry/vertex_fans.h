#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace bp {

/// The triangles at each vertex, in ascending order. A triangle that names a vertex twice is listed twice. Linear.
class VertexFans {
 public:
  /// `triangles`: by numbers of vertices, below `vertices`.
  VertexFans(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices)
      : begins_(vertices + 1, 0), all_(triangles.size() * 3) {
    for (const auto& t : triangles)
      for (const std::uint32_t v : t) ++begins_[v + 1];
    for (std::size_t v = 0; v < vertices; ++v) begins_[v + 1] += begins_[v];
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
      for (const std::uint32_t v : triangles[i]) all_[next[v]++] = i;
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(all_).subspan(begins_[vertex], begins_[vertex + 1] - begins_[vertex]);
  }

 private:
  std::vector<std::uint32_t> begins_, all_;
};

}  // namespace bp
