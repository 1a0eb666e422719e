#pragma once
#include "lib/image/mip_image.h"
#include "lib/pass/bake/detail/look_blocks.h"
#include "lib/pass/bake/scene_looks.h"

namespace bp {

/// Looks at a scene. It keeps the blocks and images that it used last. Not thread-safe: each thread has its own.
class SceneEye {
 public:
  /// `surfaces`: looks are complete, not only colours and alpha.
  explicit SceneEye(const SceneLooks& looks, bool surfaces = false) : looks_(looks), surfaces_(surfaces) {}

  /// Sets the side that surfaces are seen from. Normals are turned to it.
  void look_from(const Vec3d& side) { side_ = side; }

  /// The look from `start` up to start + direction, over about `size` scene units along each side.
  struct Seen {
    double along = 1;
    Look look;
  };
  /// Finds the first surface along a line. `threshold`: a surface counts if it covers at least this much, and then it
  /// counts alone. `through` is set if a surface that covers less was in the way.
  [[nodiscard]] std::optional<Seen> first_along(const Vec3d& start, const Vec3d& direction, double size,
                                                float threshold, bool& through);
  /// Finds the nearest place within `reach`. Its alpha is 1, or 0 for a hole, which covers less than `threshold`. An
  /// edge of holes may lie on a wall. So another place that covers counts instead, up to twice as far away, or two
  /// sizes farther.
  [[nodiscard]] std::optional<Look> nearest(const Vec3d& p, double reach, double size, float threshold);

 private:
  using Block = std::shared_ptr<const LookBlock>;
  /// An item of a block.
  struct Place {
    Block block;
    std::uint32_t item = 0;
  };
  struct Candidate {
    double distance;
    std::uint32_t block;
  };
  template <class T>
  using Held = std::vector<std::pair<std::uint32_t, std::shared_ptr<const T>>>;  // the latest last

  [[nodiscard]] Block block(std::uint32_t number);
  [[nodiscard]] const MipImage* image(std::uint32_t number, MipImage::Kind kind = MipImage::Kind::color);
  [[nodiscard]] Look at(const LookBlock& block, std::uint32_t item, const Vec3d& p, double size);
  /// The place at which an image is looked at.
  struct Spot {
    std::array<double, 3> part{};  ///< shares of the triangle's corners
    std::array<double, 2> uv{}, second_uv{};
    double size = 0;  ///< scene units
  };
  void add_surface(const LookBlock& block, std::uint32_t item, const Spot& spot, Look& look);
  [[nodiscard]] LinearTexel numbers_at(const TextureMap& map, const TriangleD& t, const TriangleTexture& texture,
                                       const Spot& spot, MipImage::Kind kind);
  [[nodiscard]] std::array<float, 3> light_at(const TextureSurface& surface, const TriangleD& t,
                                              const TriangleTexture& texture, const Spot& spot);
  [[nodiscard]] bool covers(const LookBlock& block, std::uint32_t item, const Vec3d& p, double size, float threshold);
  [[nodiscard]] Vec3d nearest_of(const Place& place, const Vec3d& p) const;
  template <class Accept>
  [[nodiscard]] Place nearest_place(const Vec3d& p, double most, const Accept& accept);
  /// Decides which of two triangles at one place is seen.
  [[nodiscard]] bool before(const LookBlock& a, std::uint32_t item_a, const LookBlock& b, std::uint32_t item_b) const;
  template <class Distance>
  void find_candidates(const Bounds3d& box, double most, const Distance& distance);

  const SceneLooks& looks_;
  const bool surfaces_;
  Vec3d side_{};
  Held<LookBlock> blocks_;
  Held<MipImage> images_;
  std::vector<Candidate> candidates_;
  Place near_;  // the place found last
};

}  // namespace bp
