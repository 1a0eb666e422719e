#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/grid/bit_box.h"
#include "lib/grid/brick.h"
#include "lib/grid/orientation_field.h"
#include "lib/grid/provenance.h"
#include "lib/grid/scale_field.h"

/// Streams and shelves of bricks, as the passes see them. io/ implements them with zstd, checksums and scratch files.
namespace bp {

/// The element of the dilation. That of the erosion is always the ball.
enum class StructuringElement : std::uint8_t { ball = 0, cube = 1 };

/// The voxels of the solid layer in addition to those that triangles touch. inside: the flood's inside *without* the
/// touched voxels, the ground of proxies that lie strictly inside the scene.
enum class FillMode : std::uint8_t { flood = 0, winding = 1, none = 2, inside = 3 };

/// The files that a stream was made from: enough to read the same triangles again, and to know that they are the same.
struct SceneFiles {
  struct File {
    std::string name;         ///< as given on the command line
    std::uint64_t bytes = 0;  ///< of the file itself; files that it refers to are not counted
    friend bool operator==(const File&, const File&) = default;
  };
  std::vector<File> files;      ///< in the order of reading; empty: unknown, as for a scene from a pipe
  std::string format;           ///< for names that do not tell it; empty: all names do
  std::uint64_t triangles = 0;  ///< of all files
  std::string hash;             ///< XXH3-128 of the coordinates of all triangles in their order, hex
  friend bool operator==(const SceneFiles&, const SceneFiles&) = default;
};

/// Everything a reader must know before the first brick.
struct StreamHeader {
  GridFrame frame;
  Bounds3d bounds;           ///< of the scene, scene units; a LENGTH in percent refers to their diagonal
  BrickBox bricks;           ///< every brick of the stream lies in it
  int slab_axis = 2;         ///< bricks come in slabs across this axis (the longest), see slab_order
  bool has_closing = false;  ///< the closing layer is present in addition to the solid layer
  bool has_field = false;    ///< there is no closing layer; `scale` is given for a closing to come
  FillMode fill = FillMode::flood;
  ScaleField scale;              ///< scale of the closing; meaningful if has_closing or has_field
  OrientationField orientation;  ///< of the closing's cubes, or of those to come; may be empty
  StructuringElement element = StructuringElement::cube;
  std::vector<Provenance> provenance;
  SceneFiles scene;
  friend bool operator==(const StreamHeader&, const StreamHeader&) = default;
};

/// Returns the longest axis of a box of bricks (the last one among equals).
[[nodiscard]] int longest_axis(const BrickBox& bricks);

/// Returns whether `a` comes before `b` in a stream: by slab (coordinate along slab_axis), then by the higher of the
/// two other axes, then by the lower, then by the layer.
[[nodiscard]] bool slab_order(int slab_axis, const Brick& a, const Brick& b);
[[nodiscard]] bool slab_order(int slab_axis, BrickCoord a, BrickCoord b);

/// A stream of bricks in slab order; non-empty bricks only.
class BrickSource {
 public:
  virtual ~BrickSource() = default;
  [[nodiscard]] virtual const StreamHeader& header() const = 0;
  /// Reads the next brick. Returns false at the end, after the end record was verified. Throws bad_input on a truncated
  /// or damaged stream.
  virtual bool read(Brick& out) = 0;
};

/// Calls take(brick) for all bricks of a stream, some of them at the same time, each on any thread. take() must be
/// thread-safe for distinct bricks, as BrickShelf::put() is. Bricks are read in their order, while others are taken.
void for_bricks(BrickSource& source, const std::function<void(const Brick&)>& take);
/// Calls take(brick) in this way for bricks that next() gives, one after the other, until it returns false.
void for_bricks(const std::function<bool(Brick&)>& next, const std::function<void(const Brick&)>& take);

class BrickSink {
 public:
  virtual ~BrickSink() = default;
  virtual void write(const Brick& brick) = 0;  ///< in slab order; empty bricks are dropped
  virtual void finish() = 0;                   ///< writes the end record; a stream without it is reported as truncated
};

/// Holds bricks by coordinate: compressed in memory, spilled to scratch beyond a budget. Thread-safe for distinct
/// bricks.
class BrickShelf {
 public:
  virtual ~BrickShelf() = default;
  virtual void put(BrickCoord coord, BrickFill fill, const BrickBits& bits) = 0;  ///< replaces; empty removes
  virtual BrickFill get(BrickCoord coord, BrickBits& out) const = 0;              ///< fills `out` in each case
  [[nodiscard]] virtual BrickFill fill(BrickCoord coord) const = 0;
  virtual void drop(BrickCoord coord) = 0;
  /// Coordinates of the non-empty bricks, sorted by x, y, z.
  [[nodiscard]] virtual std::vector<BrickCoord> coords() const = 0;
  /// Bytes held in memory by all shelves that share the budget.
  [[nodiscard]] virtual std::uint64_t memory_bytes() const = 0;
};
/// Makes an empty shelf. Passes get the factory from the tool, which knows --memory and --temp.
using ShelfFactory = std::function<std::unique_ptr<BrickShelf>()>;

/// Fills `box` with the voxels of the shelf.
void load_voxels(const BrickShelf& shelf, BitBox& box);
/// Stores the whole bricks that `box` covers; its box must be a box of bricks.
void store_voxels(const BitBox& box, BrickShelf& shelf);

}  // namespace bp
