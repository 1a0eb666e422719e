#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/color.h"
#include "lib/core/coords.h"
#include "lib/core/grid_frame.h"
#include "lib/core/texture.h"

/// A stream of triangles in scene units. Readers of scenes implement it (io/), and passes pull from it. lib/ knows
/// nothing else of a scene.
namespace bp {

/// A bound on how far coordinates in memory are from the numbers in their file. Along each axis, a corner of a triangle
/// whose largest coordinate is m is off by at most share * m + offset. There are two numbers, so that one triangle far
/// away does not loosen the bound near the origin. Both are 0 if the file's numbers were taken as they are
/// (docs/bounding.md).
struct Rounding {
  double share = 0;
  double offset = 0;  ///< scene units
  double most = 0;    ///< the largest distance by which a point was off, at most; scene units, for messages

  [[nodiscard]] bool any() const { return share > 0 || offset > 0; }
  void add(const Rounding& r) {
    share = std::max(share, r.share), offset = std::max(offset, r.offset), most = std::max(most, r.most);
  }
  /// Notes that a coordinate of a triangle is off by `bound`. The bound counts as a share if it is at most `most_share`
  /// of the triangle's largest coordinate, else as an offset.
  void see(double bound, double largest, double most_share) {
    if (bound == 0) return;
    most = std::max(most, kRoundUp * kDiagonal * bound);
    if (bound <= most_share * largest) {
      share = std::max(share, kRoundUp * (bound / largest));
    } else {
      offset = std::max(offset, bound);
    }
  }
  /// Returns a distance in scene units. No point of the triangle is off by more.
  [[nodiscard]] double of(const TriangleD& t) const {
    double largest = 0;
    for (const Vec3d& p : t) largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    return of(largest);
  }
  [[nodiscard]] double of(double largest) const { return kRoundUp * kDiagonal * (share * largest + offset); }
  /// Returns the same distance for all triangles in the box.
  [[nodiscard]] double of(const Bounds3d& box) const { return any() ? of({box.min, box.max, box.max}) : 0; }

 private:
  static constexpr double kDiagonal = 1.7320508075688774;  // diagonal of a cube of edge 1, rounded up
  static constexpr double kRoundUp = 1 + 0x1p-40;          // covers the rounding of the bound itself
};

/// Statements of a scene's files about their meshes that no reader follows. Other programs may draw these meshes
/// elsewhere, or draw more, or less.
struct Unfollowed {
  std::uint64_t skins = 0;       ///< meshes that joints have moved or bent
  std::uint64_t morphs = 0;      ///< meshes with morph targets that show
  std::uint64_t transforms = 0;  ///< nodes whose transform is read in different ways
  std::uint64_t vertices = 0;    ///< meshes whose vertices are read in different ways
  std::uint64_t missing = 0;     ///< instances of meshes that are not read, or are in another file
  std::uint64_t lines = 0;       ///< lines of a text that programs end elsewhere, or read more of
  std::uint64_t placed = 0;      ///< meshes that the importer places, in single precision
  std::uint64_t foreign = 0;     ///< files of a format that only Assimp reads, which leaves out parts of it
  std::uint64_t culled = 0;      ///< meshes that leave the bounds in their file, by which viewers cull
  std::uint64_t hidden = 0;      ///< meshes that viewers may hide
  std::uint64_t variants = 0;    ///< documents that show other poses or scenes, too: animations, no default scene

  [[nodiscard]] bool any() const { return moves() || missing + culled + hidden + variants > 0; }
  /// Returns whether meshes that were read may lie elsewhere in other programs.
  [[nodiscard]] bool moves() const { return skins + morphs + transforms + vertices + lines + placed + foreign > 0; }
  /// Returns whether other programs may draw what was read elsewhere, or draw more.
  [[nodiscard]] bool draws_elsewhere() const { return moves() || missing > 0; }
  /// Returns what matters to a proxy around all meshes: it encloses those that are not drawn, too.
  [[nodiscard]] Unfollowed of_enclosed() const {
    Unfollowed u = *this;
    u.hidden = u.culled = u.variants = 0;
    return u;
  }
  void add(const Unfollowed& u) {
    skins += u.skins, morphs += u.morphs, transforms += u.transforms, vertices += u.vertices, missing += u.missing;
    lines += u.lines, placed += u.placed, foreign += u.foreign, culled += u.culled, hidden += u.hidden;
    variants += u.variants;
  }
};

/// Counts of what a source met on its way. Triangles that are skipped are counted, never silently lost.
struct SceneCounts {
  std::uint64_t triangles = 0;        ///< delivered
  std::uint64_t non_finite = 0;       ///< skipped: a coordinate is NaN or infinite
  std::uint64_t degenerate = 0;       ///< met with exactly zero area: two equal corners, or exactly collinear ones
  std::uint64_t kept_degenerate = 0;  ///< the degenerate ones that were delivered; the others were skipped
  /// skipped: a face that names a missing vertex, has fewer than 3 corners, or is of a kind that is not read
  std::uint64_t bad_faces = 0;
  std::uint64_t differing = 0;   ///< meshes that a file holds twice, and not alike; the compressed one is delivered
  std::uint64_t instances = 0;   ///< mesh instances met (1 for formats without a scene graph)
  std::uint64_t animations = 0;  ///< animations in the files; none is followed
  std::uint64_t posed = 0;       ///< meshes with a skin or morph targets, which stand as the files show them
  Rounding rounding;             ///< of the coordinates; final once all triangles were read
  Unfollowed unfollowed;
  void add(const SceneCounts& c) {
    triangles += c.triangles, non_finite += c.non_finite;
    degenerate += c.degenerate, kept_degenerate += c.kept_degenerate;
    bad_faces += c.bad_faces, differing += c.differing, instances += c.instances, animations += c.animations;
    posed += c.posed;
    rounding.add(c.rounding), unfollowed.add(c.unfollowed);
  }
  [[nodiscard]] bool has_area() const { return triangles > kept_degenerate; }
  /// Returns the counts that matter to a proxy around all meshes.
  [[nodiscard]] SceneCounts of_enclosed() const {
    SceneCounts c = *this;
    c.unfollowed = unfollowed.of_enclosed();
    return c;
  }
  /// Returns whether surfaces of the files were not delivered, or may be read differently by other programs.
  [[nodiscard]] bool is_partial() const { return non_finite + bad_faces + differing > 0 || unfollowed.any(); }
};

/// Bits of TriangleSource::read_faces(): the triangle before, or after, belongs to the same polygon.
inline constexpr std::uint8_t kSamePolygonBefore = 8, kSamePolygonAfter = 16;

class TriangleSource {
 public:
  virtual ~TriangleSource() = default;

  /// Replaces `out` by the next triangles, at most some tens of thousands. Returns false with `out` empty at the end.
  /// Triangles of one polygon come one after the other (PolygonCutter). Throws bad_input with file, place and remedy if
  /// the scene is broken.
  virtual bool read(std::vector<TriangleD>& out) = 0;

  /// Like read(), with the colours of each triangle's corners; white if the scene has none. From one rewind() to the
  /// next, only one of the read functions is called.
  virtual bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) {
    const bool more = read(out);
    colors.assign(out.size(), TriangleColors{});
    return more;
  }
  /// Like read_colored(), with the texture of each triangle; empty if the scene has none.
  virtual bool read_textured(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                             std::vector<TriangleTexture>& textures) {
    const bool more = read_colored(out, colors);
    textures.assign(out.size(), TriangleTexture{});
    return more;
  }
  /// Like read_colored(), with the inner edges of polygons: bit k of a triangle says that the edge from corner k to the
  /// next lies within its polygon. kSamePolygonBefore and -After tell which triangles belong to one polygon. Sources
  /// that know of no polygons give 0.
  virtual bool read_faces(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                          std::vector<std::uint8_t>& inner_edges) {
    const bool more = read_colored(out, colors);
    inner_edges.assign(out.size(), 0);
    return more;
  }
  /// Returns false if every triangle is white. Known after all of them were read once.
  [[nodiscard]] virtual bool has_colors() const { return false; }

  /// Returns true if an image lies on some triangle. Known after all of them were read once.
  [[nodiscard]] virtual bool has_textures() const { return false; }

  /// Starts over from the first triangle; the same triangles follow in the same order.
  virtual void rewind() = 0;

  [[nodiscard]] virtual const SceneCounts& counts() const = 0;  ///< since the last rewind
  [[nodiscard]] virtual std::string name() const = 0;           ///< for messages: file names
  /// Returns the box of all triangles, if the scene tells it before the triangles are read. The box may be wrong, so
  /// callers must compare it with the triangles. The call may read a part of the scene.
  [[nodiscard]] virtual std::optional<Bounds3d> bounds() { return {}; }
  /// Returns the axis that points up, if the scene tells it, as our proxies do. Known from the first read() on.
  [[nodiscard]] virtual std::optional<UpAxis> up() const { return {}; }
};

}  // namespace bp
