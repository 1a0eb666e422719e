#pragma once
#include "io/scene/detail/instanced/element_reader.h"

namespace bp {

/// Makes triangles of runs (PlacedRun). One thread at a time uses it.
class RunDecoder {
 public:
  /// Keeps at most `budget` bytes of the file's blocks, and in addition the indices and vertices of one run.
  RunDecoder(const InstancedScene& scene, std::uint64_t budget) : scene_(scene), elements_(scene.bytes, budget) {}

  /// Adds the triangles of the batch's runs to the batch, and what was rounded to `rounding`.
  void decode(RawBatch& batch, Rounding& rounding);
  /// Returns the primitives of the last batch with a corner beyond the bounds that their file tells.
  [[nodiscard]] const std::vector<std::uint32_t>& leaving() const { return leaving_; }

 private:
  using Corners = std::array<std::uint64_t, 3>;

  void decode(const PlacedRun& run, RawBatch& batch);
  void read_corners(const Primitive& p, const PlacedRun& run);
  [[nodiscard]] Corners corners_of(const Primitive& p, const PlacedRun& run, std::uint64_t triangle) const;
  [[nodiscard]] bool read_points(const Primitive& p, std::uint64_t triangles);
  template <class Point>
  void add_triangles(const PlacedRun& run, const Point& point, RawBatch& batch);
  [[nodiscard]] TriangleTexture texture_of(const Primitive& p, const Affine& transform, const Corners& corners);
  [[nodiscard]] LinearColor color_of(const Primitive& p, std::uint64_t vertex);

  const InstancedScene& scene_;
  ElementReader elements_;
  Rounding rounding_;                   // of the batch
  std::vector<std::uint32_t> leaving_;  // of the batch
  std::vector<std::uint64_t> indices_;  // of the run, from first_index_ on
  std::uint64_t first_index_ = 0;
  std::uint64_t fan_centre_ = 0;   // vertex that all triangles of a fan share
  std::vector<std::byte> points_;  // bytes of vertices, from first_point_ on
  std::uint64_t first_point_ = 0;
};

}  // namespace bp
