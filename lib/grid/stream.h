#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/grid/bit_box.h"
#include "lib/grid/brick.h"
#include "lib/grid/orientation_field.h"
#include "lib/grid/scale_field.h"

/// Streams and shelves of bricks, as the passes see them. io/ implements them with zstd, checksums and scratch files.
namespace bp {

enum class StructuringElement : std::uint8_t {
  ball = 0,
  cube = 1
};  ///< of the dilation; the erosion is always the ball
/// What the solid layer holds beside the voxels that triangles touch. inside: the flood's inside *without* those
/// voxels, the ground of proxies that lie strictly inside the scene.
enum class FillMode : std::uint8_t { flood = 0, winding = 1, none = 2, inside = 3 };

/// One step of the chain that made a stream or a mesh: no paths, no time of day.
struct Provenance {
  std::string tool, version;
  std::string options;     ///< canonical text: those that change the result, defaults included, fixed order
  std::string input_hash;  ///< XXH3-128 of what it read, hex; empty if unknown
  friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// The files that a stream was made from: enough to read the same triangles again, and to know that they are the same.
struct SceneFiles {
  struct File {
    std::string name;         ///< as given on the command line
    std::uint64_t bytes = 0;  ///< of the file itself; files that it names are not counted
    friend bool operator==(const File&, const File&) = default;
  };
  std::vector<File> files;      ///< in the order of reading; empty: not known, as of a scene from a pipe
  std::string format;           ///< of names that do not tell it; empty: all names do
  std::uint64_t triangles = 0;  ///< of all files
  std::string hash;             ///< XXH3-128 of the coordinates of all triangles in their order, hex
  friend bool operator==(const SceneFiles&, const SceneFiles&) = default;
};

/// Everything a reader must know before the first brick.
struct StreamHeader {
  GridFrame frame;
  Bounds3d bounds;           ///< of the scene, scene units: what a LENGTH in percent refers to
  BrickBox bricks;           ///< every brick of the stream lies in it
  int slab_axis = 2;         ///< bricks come in slabs across this axis (the longest), see slab_order
  bool has_closing = false;  ///< the closing layer is present beside the solid layer
  bool has_field = false;    ///< it is not, and `scale` is given for the closing to come
  FillMode fill = FillMode::flood;
  ScaleField scale;              ///< of the closing; meaningful if has_closing or has_field
  OrientationField orientation;  ///< of the closing's cubes, or of those to come; may be empty
  StructuringElement element = StructuringElement::cube;
  std::vector<Provenance> provenance;
  SceneFiles scene;
  friend bool operator==(const StreamHeader&, const StreamHeader&) = default;
};

/// Longest axis of a box of bricks (the last one among equals).
[[nodiscard]] int longest_axis(const BrickBox& bricks);

/// Order of the stream: slab (coordinate along slab_axis), then the higher of the two other axes, then the lower, then
/// the layer.
[[nodiscard]] bool slab_order(int slab_axis, const Brick& a, const Brick& b);
[[nodiscard]] bool slab_order(int slab_axis, BrickCoord a, BrickCoord b);

/// Bricks in slab order; non-empty bricks only.
class BrickSource {
 public:
  virtual ~BrickSource() = default;
  [[nodiscard]] virtual const StreamHeader& header() const = 0;
  /// Next brick; false at the end, after the end record was verified. Throws bad_input on a truncated or damaged
  /// stream.
  virtual bool read(Brick& out) = 0;
};

class BrickSink {
 public:
  virtual ~BrickSink() = default;
  virtual void write(const Brick& brick) = 0;  ///< in slab order; empty bricks are dropped
  virtual void finish() = 0;                   ///< end record: a stream without it is reported as truncated
};

/// Bricks that wait, by coordinate: compressed in memory, spilled to scratch beyond a budget. Thread-safe for distinct
/// bricks.
class BrickShelf {
 public:
  virtual ~BrickShelf() = default;
  virtual void put(BrickCoord coord, BrickFill fill, const BrickBits& bits) = 0;  ///< replaces; empty removes
  virtual BrickFill get(BrickCoord coord, BrickBits& out) const = 0;              ///< fills `out` in each case
  [[nodiscard]] virtual BrickFill fill(BrickCoord coord) const = 0;
  virtual void drop(BrickCoord coord) = 0;
  [[nodiscard]] virtual std::vector<BrickCoord> coords() const = 0;  ///< of non-empty bricks, sorted x, y, z
  [[nodiscard]] virtual std::uint64_t memory_bytes() const = 0;      ///< held in memory, by all that share its budget
};
/// Makes an empty shelf; passes get one from the tool, which knows --memory and --temp.
using ShelfFactory = std::function<std::unique_ptr<BrickShelf>()>;

/// Fills `box` with the voxels of the shelf.
void load_voxels(const BrickShelf& shelf, BitBox& box);
/// Stores the whole bricks that `box` covers; its box must be a box of bricks.
void store_voxels(const BitBox& box, BrickShelf& shelf);

}  // namespace bp
