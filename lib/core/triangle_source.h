#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/color.h"
#include "lib/core/coords.h"
#include "lib/core/grid_frame.h"
#include "lib/core/texture.h"

/// A stream of triangles in scene units. Readers of scenes implement it (io/), passes pull from it; nothing else of a
/// scene is known to lib/.
namespace bp {

/// How far coordinates in memory may be from those that their file stands for: along each axis, a corner of a triangle
/// whose largest coordinate is m is off by at most share * m + offset. Two numbers, so that one triangle far away says
/// nothing about those near the origin. Both are 0 where the file's numbers were taken as they are (docs/bounding.md).
struct Rounding {
  double share = 0;
  double offset = 0;  ///< scene units
  double most = 0;    ///< the largest distance that a point was off by at most, scene units: for messages

  [[nodiscard]] bool any() const { return share > 0 || offset > 0; }
  void add(const Rounding& r) {
    share = std::max(share, r.share), offset = std::max(offset, r.offset), most = std::max(most, r.most);
  }
  /// Notes that a coordinate of a triangle is off by `bound`. Up to `most_share` of the triangle's largest coordinate
  /// it is taken as a share.
  void see(double bound, double largest, double most_share) {
    if (bound == 0) return;
    most = std::max(most, kRoundUp * kDiagonal * bound);
    if (bound <= most_share * largest) {
      share = std::max(share, kRoundUp * (bound / largest));
    } else {
      offset = std::max(offset, bound);
    }
  }
  /// No point of the triangle is off by more than this, as a distance in scene units.
  [[nodiscard]] double of(const TriangleD& t) const {
    double largest = 0;
    for (const Vec3d& p : t) largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    return of(largest);
  }
  [[nodiscard]] double of(double largest) const { return kRoundUp * kDiagonal * (share * largest + offset); }

 private:
  static constexpr double kDiagonal = 1.7320508075688774;  // of a cube of edge 1, rounded up
  static constexpr double kRoundUp = 1 + 0x1p-40;          // covers the rounding of the bound itself
};

/// What the files of a scene say of their meshes that no reader follows: programs may draw these elsewhere, or draw
/// more.
struct Unfollowed {
  std::uint64_t skins = 0;       ///< meshes that joints have moved or bent
  std::uint64_t morphs = 0;      ///< meshes with morph targets that show
  std::uint64_t transforms = 0;  ///< nodes whose transform is read in different ways
  std::uint64_t vertices = 0;    ///< meshes whose vertices are read in different ways
  std::uint64_t missing = 0;     ///< instances of what is not read, or in another file

  [[nodiscard]] bool any() const { return moves() || missing > 0; }
  /// Whether what was read may lie elsewhere.
  [[nodiscard]] bool moves() const { return skins + morphs + transforms + vertices > 0; }
  void add(const Unfollowed& u) {
    skins += u.skins, morphs += u.morphs, transforms += u.transforms, vertices += u.vertices, missing += u.missing;
  }
};

/// What a source met on its way. Skipped triangles are counted, never silently lost.
struct SceneCounts {
  std::uint64_t triangles = 0;        ///< delivered
  std::uint64_t non_finite = 0;       ///< skipped: a coordinate is NaN or infinite
  std::uint64_t degenerate = 0;       ///< met: exactly zero area (two equal corners, or exactly collinear)
  std::uint64_t kept_degenerate = 0;  ///< the degenerate ones that were delivered; the others were skipped
  std::uint64_t bad_faces = 0;   ///< skipped: a face that names a vertex that does not exist, has fewer than 3 corners,
                                 ///< or is a surface of a kind that is not read
  std::uint64_t differing = 0;   ///< meshes that a file holds twice, and not alike; the compressed one is delivered
  std::uint64_t instances = 0;   ///< mesh instances met (1 for formats without a scene graph)
  std::uint64_t animations = 0;  ///< that the files have; none is followed
  std::uint64_t posed = 0;       ///< meshes with a skin or morph targets, which stand as the files show them
  Rounding rounding;             ///< of coordinates; final once all triangles were read
  Unfollowed unfollowed;
  void add(const SceneCounts& c) {
    triangles += c.triangles, non_finite += c.non_finite;
    degenerate += c.degenerate, kept_degenerate += c.kept_degenerate;
    bad_faces += c.bad_faces, differing += c.differing, instances += c.instances, animations += c.animations;
    posed += c.posed;
    rounding.add(c.rounding), unfollowed.add(c.unfollowed);
  }
  [[nodiscard]] bool has_area() const { return triangles > kept_degenerate; }
  /// Whether the files hold surfaces that were not delivered, or perhaps not as other programs read them.
  [[nodiscard]] bool is_partial() const { return non_finite + bad_faces + differing > 0 || unfollowed.any(); }
};

/// Bits of TriangleSource::read_faces(): the triangle before, or after, is of the same polygon.
inline constexpr std::uint8_t kSamePolygonBefore = 8, kSamePolygonAfter = 16;

class TriangleSource {
 public:
  virtual ~TriangleSource() = default;

  /// Replaces `out` by the next triangles (at most some tens of thousands). False, and `out` empty, at the end.
  /// Polygons arrive as their triangles, one after the other (PolygonCutter). Throws bad_input with file, place and
  /// remedy if the scene is broken.
  virtual bool read(std::vector<TriangleD>& out) = 0;

  /// As read(), with the colours of each triangle's corners: white where the scene says nothing. From one rewind() to
  /// the next, one of these is called.
  virtual bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) {
    const bool more = read(out);
    colors.assign(out.size(), TriangleColors{});
    return more;
  }
  /// As read_colored(), and what lies on each triangle: nothing where the scene says nothing.
  virtual bool read_textured(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                             std::vector<TriangleTexture>& textures) {
    const bool more = read_colored(out, colors);
    textures.assign(out.size(), TriangleTexture{});
    return more;
  }
  /// As read_colored(), and for each triangle its inner edges, within a polygon that it is a part of: bit k stands for
  /// the edge from corner k to the next, and kSamePolygonBefore and -After tell which triangles are of one polygon.
  /// Sources that know of no polygons say 0.
  virtual bool read_faces(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                          std::vector<std::uint8_t>& inner_edges) {
    const bool more = read_colored(out, colors);
    inner_edges.assign(out.size(), 0);
    return more;
  }
  /// False if every triangle is white; known after all of them were read once.
  [[nodiscard]] virtual bool has_colors() const { return false; }

  /// True if an image lies on some triangle; known after all of them were read once.
  [[nodiscard]] virtual bool has_textures() const { return false; }

  /// Starts over from the first triangle; the same triangles follow in the same order.
  virtual void rewind() = 0;

  [[nodiscard]] virtual const SceneCounts& counts() const = 0;  ///< since the last rewind
  [[nodiscard]] virtual std::string name() const = 0;           ///< for messages: file names
  /// Axis that points up, if the scene tells (proxies of ours do); known from the first read() on.
  [[nodiscard]] virtual std::optional<UpAxis> up() const { return {}; }
};

}  // namespace bp
